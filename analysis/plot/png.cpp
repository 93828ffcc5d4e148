// SPDX-License-Identifier: Apache-2.0
#include "analysis/plot/png.h"

#include <fmt/format.h>

#include <string>

#include "base/files/output_file.h"

namespace throng::analysis {

void writePng(cairo_surface_t* surface, const std::filesystem::path& path) {
    const auto append = [](void* to, const unsigned char* bytes, unsigned int count) {
        static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(bytes), count);
        return CAIRO_STATUS_SUCCESS;
    };
    std::string png;
    cairo_surface_flush(surface);
    const cairo_status_t status = cairo_surface_write_to_png_stream(surface, append, &png);
    if (status != CAIRO_STATUS_SUCCESS)
        throw OutputError(path,
                          fmt::format("the picture cannot be made: {}", cairo_status_to_string(status)));
    replaceFile(path, png);
}

}  // namespace throng::analysis
