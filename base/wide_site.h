// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>

namespace throng {

/// Whether single precision is too coarse for the steps of people somewhere between these corners, given in
/// metres from the frame's origin. A step is some centimetres, and places are rounded to 0.03 mm at 260 m and
/// to 1 mm at 10 km, where somebody who sets out never gets anywhere. On such sites, simulation and recording
/// keep what rounding drops.
inline bool isWideSite(glm::dvec2 minimum, glm::dvec2 maximum) {
    constexpr double kNear = 260.0;
    return std::max({std::abs(minimum.x), std::abs(minimum.y), std::abs(maximum.x), std::abs(maximum.y)}) >
           kNear;
}

}  // namespace throng
