// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

namespace throng::gl {

struct EmbeddedShader {
    std::string_view path;  ///< e.g. "shaders/sensing/sense.comp"
    std::string_view text;
};

/// Every file of shaders/, put into the binary by the build (sim/embed_shaders.cmake).
std::span<const EmbeddedShader> embeddedShaders();

}  // namespace throng::gl
