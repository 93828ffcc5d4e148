// SPDX-License-Identifier: Apache-2.0
#include "analysis/preview/preview.h"

#include <fmt/format.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

#include "analysis/preview/plate.h"

namespace throng::analysis {
namespace {

std::string quoted(const std::string& text) {
    std::string result;
    for (const char letter : text) {
        if (letter == '\'')
            result.append("'\\''");
        else
            result.push_back(letter);
    }
    return fmt::format("'{}'", result);
}

/// Other file than the final one until it is complete, so that a failure leaves nothing that looks like a
/// picture.
std::filesystem::path unfinished(const std::filesystem::path& path) {
    std::filesystem::path result = path;
    result.replace_filename(fmt::format(".{}.unfinished{}", path.stem().string(), path.extension().string()));
    return result;
}

void publish(const std::filesystem::path& from, const std::filesystem::path& to) {
    std::error_code error;
    std::filesystem::rename(from, to, error);
    if (!error) return;
    std::filesystem::remove(from);
    throw OutputError(to, "write", error.value());
}

/// A pipe to ffmpeg that takes raw frames.
class Encoder {
  public:
    Encoder(const Plate& plate, const std::filesystem::path& path) : path_(path) {
        if (std::system("ffmpeg -version >/dev/null 2>&1") != 0)
            throw OutputError(path,
                              "films need the program ffmpeg, which is not here: apt-get install ffmpeg");
        old_handler_ =
            std::signal(SIGPIPE, SIG_IGN);  // a dying encoder is an error of ours to tell, not our death
        const std::string command = fmt::format(
            "ffmpeg -loglevel error -nostdin -y -f rawvideo -pix_fmt bgr0 -s {}x{} -r {} -i - -c:v libx264 "
            "-pix_fmt yuv420p -crf 20 -f mp4 {}",
            plate.width(), plate.height(), plate.fps(), quoted(path.string()));
        pipe_ = popen(command.c_str(), "w");
        if (!pipe_) throw OutputError(path, "start ffmpeg for", errno);
    }
    ~Encoder() {
        if (pipe_) pclose(pipe_);
        std::signal(SIGPIPE, old_handler_);
    }
    Encoder(const Encoder&) = delete;
    Encoder& operator=(const Encoder&) = delete;

    void add(cairo_surface_t* surface, int height) {
        const auto bytes = static_cast<std::size_t>(cairo_image_surface_get_stride(surface)) *
                           static_cast<std::size_t>(height);
        if (std::fwrite(cairo_image_surface_get_data(surface), 1, bytes, pipe_) != bytes)
            throw OutputError(path_, "write the film", errno);
    }
    void finish() {
        const int status = pclose(pipe_);
        pipe_ = nullptr;
        if (status != 0)
            throw OutputError(path_, fmt::format("ffmpeg could not make the film (status {})", status));
    }

  private:
    std::filesystem::path path_;
    FILE* pipe_ = nullptr;
    void (*old_handler_)(int) = nullptr;
};

}  // namespace

std::uint32_t drawPreview(const std::filesystem::path& bake, const std::filesystem::path& png,
                          const PreviewOptions& options) {
    Plate plate(bake, options);
    const std::uint32_t frame = options.frame.value_or(plate.busiestFrame());
    if (frame >= plate.frames())
        throw InputError(bake, fmt::format("there is no frame {}: the bake has {}, counted from 0", frame,
                                           plate.frames()));
    const std::filesystem::path temporary = unfinished(png);
    const cairo_status_t status = cairo_surface_write_to_png(plate.draw(frame), temporary.c_str());
    if (status != CAIRO_STATUS_SUCCESS) {
        std::error_code ignored;
        std::filesystem::remove(temporary, ignored);
        throw OutputError(png,
                          fmt::format("the picture cannot be written: {}", cairo_status_to_string(status)));
    }
    publish(temporary, png);
    return frame;
}

void writePreviewVideo(const std::filesystem::path& bake, const std::filesystem::path& mp4,
                       const PreviewOptions& options, const std::function<void(double)>& progress) {
    Plate plate(bake, options);
    const std::filesystem::path temporary = unfinished(mp4);
    try {
        Encoder encoder(plate, temporary);
        for (std::uint32_t frame = 0; frame < plate.frames(); ++frame) {
            encoder.add(plate.draw(frame), plate.height());
            progress(static_cast<double>(frame + 1) / plate.frames());
        }
        encoder.finish();
    } catch (...) {
        std::error_code ignored;
        std::filesystem::remove(temporary, ignored);
        throw;
    }
    publish(temporary, mp4);
}

}  // namespace throng::analysis
