// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/diagram/diagram.h"

namespace throng::sim {

/// What the level of detail is chosen by.
struct DiagramLoad {
    double sites = 0.0;   ///< that move
    double radius = 1.0;  ///< px, the largest tile
    double pixels = 0.0;  ///< of the window, or as many as are brought up to date
    double fixed_sites = 0.0;
    double looked_at = 0.0;  ///< px, of the window, that somebody looks at; 0: as many as there may be

    /// What is left of it where only what people look at is built.
    /// @param look px: how far they do
    DiagramLoad nearPeople(double look) const;
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

/// One of the ways to build a diagram that CostModel knows, and how much of it.
struct DiagramPlan {
    const MethodCost* cost = nullptr;
    Extent extent = Extent::everywhere;
    bool operator==(const DiagramPlan&) const = default;
};

/// Whether only what people look at is to be built, by a method that can do so.
bool isWorthListing(const DiagramLoad& load, double look);

/// The paper's level of detail, by measurement: which exact method is fastest for a load on this device.
struct CostModel {
    std::string device;  ///< GL_RENDERER and GL_VERSION, or "built in"
    std::vector<MethodCost> costs;

    /// @param present keeps to this one unless another is at least a tenth faster: changing costs, too
    const MethodCost& choose(const DiagramLoad& load, const MethodCost* present = nullptr) const;
    /// The same where building what people look at, `look` px around them, is enough.
    DiagramPlan plan(const DiagramLoad& load, double look, const DiagramPlan& present = {}) const;

    /// The same without all other methods.
    CostModel only(DiagramMethod method) const;

    /// Measured on Mesa llvmpipe, two cores: what is used where nobody has calibrated.
    static CostModel builtIn();
    /// The same of one GPU: the gather is ahead of all else there, whatever the crowd.
    static CostModel builtInOfGpu();
};

}  // namespace throng::sim
