// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/diagram/diagram.h"

namespace throng::sim {

/// What the level of detail is chosen by.
struct DiagramLoad {
    double sites = 0.0;
    double radius = 1.0;  ///< px, the largest tile
    double pixels = 0.0;  ///< of the window
};

/// What one method takes on one device: a sum over what it has to do, each term measured.
struct MethodCost {
    DiagramMethod method = DiagramMethod::binned;
    GatherShape gather;       ///< binned only
    double base_ms = 0.0;     ///< however little there is to do
    double pixel_ns = 0.0;    ///< per pixel of the window
    double site_ns = 0.0;     ///< per site
    double covered_ns = 0.0;  ///< per site and squared pixel of radius: pixels under tiles

    double milliseconds(const DiagramLoad& load) const;
};

/// The paper's level of detail, by measurement: which exact method is fastest for a load on this device.
struct CostModel {
    std::string device;  ///< GL_RENDERER and GL_VERSION, or "built in"
    std::vector<MethodCost> costs;

    /// @param present keeps to this one unless another is at least a tenth faster: changing costs, too
    const MethodCost& choose(const DiagramLoad& load, const MethodCost* present = nullptr) const;

    /// Measured on Mesa llvmpipe, two cores: what is used where nobody has calibrated.
    static CostModel builtIn();
};

}  // namespace throng::sim
