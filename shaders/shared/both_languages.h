// SPDX-License-Identifier: Apache-2.0
// Lets one header be read by C++ and by GLSL: in C++ the declarations live in throng::gpu with GLM's types.
#ifndef THRONG_SHARED_BOTH_LANGUAGES_H
#define THRONG_SHARED_BOTH_LANGUAGES_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#define THRONG_SHARED_BEGIN     \
    namespace throng::gpu {     \
    using uint = std::uint32_t; \
    using vec2 = glm::vec2;     \
    using vec4 = glm::vec4;     \
    using ivec2 = glm::ivec2;   \
    using uvec2 = glm::uvec2;
#define THRONG_SHARED_END }
#else
#define THRONG_SHARED_BEGIN
#define THRONG_SHARED_END
#endif

#endif
