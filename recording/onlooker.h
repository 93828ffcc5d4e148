// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

namespace throng::recording {

/// Somebody who is there in a frame.
struct Onlooker {
    std::uint32_t row = 0;
    std::uint32_t party = 0;  ///< who has the same walks together
    glm::dvec2 place{0.0};    ///< m
    double height = 0.0;      ///< m, of the ground
    glm::dvec2 heading{1.0, 0.0};
    double speed = 0.0;  ///< m/s
};

}  // namespace throng::recording
