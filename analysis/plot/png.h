// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cairo.h>

#include <filesystem>

namespace throng::analysis {

/// Writes a picture, whole or not at all. @throws OutputError
void writePng(cairo_surface_t* surface, const std::filesystem::path& path);

}  // namespace throng::analysis
