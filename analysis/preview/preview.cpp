// SPDX-License-Identifier: Apache-2.0
#include "analysis/preview/preview.h"

#include <fmt/format.h>
#include <unistd.h>

#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "analysis/plot/png.h"
#include "analysis/preview/film_planes.h"
#include "analysis/preview/plate.h"
#include "base/files/output_file.h"
#include "base/process.h"

namespace throng::analysis {
namespace {

/// Where a film is made until it is complete, so that a failure leaves nothing that looks like one.
std::filesystem::path unfinished(const std::filesystem::path& path) {
    std::filesystem::path result = path;
    result.replace_filename(
        fmt::format(".{}.unfinished-{}{}", path.stem().string(), ::getpid(), path.extension().string()));
    return result;
}

void publish(const std::filesystem::path& from, const std::filesystem::path& to) {
    syncFile(from);
    std::error_code error;
    std::filesystem::rename(from, to, error);
    if (error) throw OutputError(to, "write", error.value());
}

/// ffmpeg, which takes raw frames.
class Encoder {
  public:
    Encoder(const Plate& plate, const std::filesystem::path& path)
        : path_(path), planes_(plate.width(), plate.height()) {
        // Without -xerror it ends well where the last of the film found no room on the disk.
        std::vector<std::string> words = {"ffmpeg", "-loglevel", "error", "-nostdin", "-xerror", "-y"};
        const auto add = [&](std::initializer_list<std::string> more) { words.insert(words.end(), more); };
        add({"-f", "rawvideo", "-pix_fmt", "yuv420p", "-s",
             fmt::format("{}x{}", plate.width(), plate.height())});
        add({"-r", fmt::format("{}", plate.fps()), "-i", "-"});
        // Looking ahead would make files a fifth smaller and cost as much as a third of the encoding.
        add({"-c:v", "libx264", "-preset", "superfast", "-x264-params", "rc-lookahead=0:mbtree=0:bframes=0"});
        add({"-pix_fmt", "yuv420p", "-crf", "22", "-f", "mp4", path.string()});
        try {
            process_.emplace(words, ProcessOptions{.input = StandardStream::pipe});
        } catch (const std::system_error& error) {
            if (error.code() != std::errc::no_such_file_or_directory)
                throw OutputError(path, "start ffmpeg for", error.code().value());
            throw OutputError(path,
                              "films need the program ffmpeg, which is not here: apt-get install ffmpeg");
        }
    }

    void add(cairo_surface_t* surface) {
        const auto* pixels = reinterpret_cast<const std::uint32_t*>(cairo_image_surface_get_data(surface));
        const auto stride =
            static_cast<std::size_t>(cairo_image_surface_get_stride(surface)) / sizeof *pixels;
        const std::vector<std::uint8_t>& planes = planes_.of(pixels, stride);
        if (const std::error_code error =
                process_->write({reinterpret_cast<const char*>(planes.data()), planes.size()}))
            throw OutputError(path_, "write the film", error.value());
    }
    void finish() {
        const ProgramEnd end = process_->wait();
        if (!end.isGood()) throw OutputError(path_, "ffmpeg could not make the film: it " + end.text());
    }

  private:
    std::filesystem::path path_;
    FilmPlanes planes_;
    std::optional<Process> process_;
};

}  // namespace

std::uint32_t drawPreview(const std::filesystem::path& bake, const std::filesystem::path& png,
                          const PreviewOptions& options) {
    Plate plate(bake, options);
    const std::uint32_t frame = options.frame.value_or(plate.busiestFrame());
    if (frame >= plate.frames())
        throw InputError(bake, fmt::format("there is no frame {}: the bake has {}, counted from 0", frame,
                                           plate.frames()));
    writePng(plate.draw(frame), png);
    return frame;
}

void writePreviewVideo(const std::filesystem::path& bake, const std::filesystem::path& mp4,
                       const PreviewOptions& options, const std::function<void(double)>& progress) {
    Plate plate(bake, options);
    const std::filesystem::path temporary = unfinished(mp4);
    try {
        Encoder encoder(plate, temporary);
        for (std::uint32_t frame = 0; frame < plate.frames(); ++frame) {
            encoder.add(plate.draw(frame));
            progress(static_cast<double>(frame + 1) / plate.frames());
        }
        encoder.finish();
        publish(temporary, mp4);
    } catch (...) {
        std::error_code ignored;
        std::filesystem::remove(temporary, ignored);
        throw;
    }
}

}  // namespace throng::analysis
