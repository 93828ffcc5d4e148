// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace throng {

/// Whether people at two heights (m) can touch each other, or one is above the other. On stairs, neighbours
/// are half a metre apart.
inline bool areOnOneGround(double height, double other) {
    constexpr double kStorey = 1.1;
    return std::abs(height - other) < kStorey;
}

}  // namespace throng
