// SPDX-License-Identifier: Apache-2.0
#include "analysis/preview/preview.h"

#include <fmt/format.h>
#include <unistd.h>

#include <system_error>

#include "analysis/plot/png.h"
#include "analysis/preview/film_encoder.h"
#include "analysis/preview/plate.h"
#include "base/files/output_file.h"

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

}  // namespace

std::uint32_t drawPreview(const std::filesystem::path& bake, const std::filesystem::path& png,
                          const PreviewOptions& options) {
    Plate plate(bake, options);
    const std::uint32_t frame = options.frame.value_or(plate.busiestFrame());
    if (frame >= plate.frames())
        throw InputError(bake, fmt::format("there is no frame {}: the bake has {}, counted from 0", frame,
                                           plate.frames()));
    const Surface canvas = plate.makeCanvas();
    plate.draw(frame, canvas.get());
    writePng(canvas.get(), png);
    return frame;
}

void writePreviewVideo(const std::filesystem::path& bake, const std::filesystem::path& mp4,
                       const PreviewOptions& options, const std::function<void(double)>& progress) {
    Plate plate(bake, options);
    const std::filesystem::path temporary = unfinished(mp4);
    try {
        FilmEncoder encoder(plate, temporary);
        for (std::uint32_t frame = 0; frame < plate.frames(); ++frame) {
            cairo_surface_t* canvas = encoder.freeCanvas();
            plate.draw(frame, canvas);
            encoder.add(canvas);
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
