// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "shaders/shared/scene_types.h"

/// The same as shaders/gait.glsl, for those who begin and for those who render.
namespace throng::authoring {

/// m per gait cycle (two steps).
inline double strideOf(std::uint32_t gait) {
    return gpu::GAIT_NORMAL_STRIDE *
           std::pow(double{gpu::GAIT_RATIO}, static_cast<double>(gait) - double{gpu::GAIT_NORMAL});
}

/// The gait of somebody who walks steadily at this speed, m/s.
inline std::uint32_t gaitFor(double speed) {
    const double stride = double{gpu::GAIT_STRIDE_AT_ONE} * std::sqrt(std::max(speed, 1.0e-3));
    const double scale = double{gpu::GAIT_NORMAL} +
                         std::log(stride / gpu::GAIT_NORMAL_STRIDE) / std::log(double{gpu::GAIT_RATIO});
    return static_cast<std::uint32_t>(std::clamp(std::round(scale), 0.0, double{gpu::GAIT_COUNT - 1u}));
}

inline std::vector<double> allStrides() {
    std::vector<double> strides;
    for (std::uint32_t gait = 0; gait < gpu::GAIT_COUNT; ++gait)
        strides.push_back(strideOf(gait));
    return strides;
}

}  // namespace throng::authoring
