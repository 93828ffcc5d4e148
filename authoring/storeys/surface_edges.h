// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "authoring/storeys/surface.h"

namespace throng::authoring {

/// Where the ground of a surface ends and nobody gets on: at a drop, a step, an upright face, or where there
/// is no headroom.
struct SurfaceEdge {
    std::size_t surface = 0;
    std::vector<glm::dvec2> points;  ///< home; the ground is on their left
    double low = 0.0, high = 0.0;    ///< m, of the ground along it
    /// Of links that are built onto a terrain: whether its ground is beside one, or has an opening over one.
    enum class Beside { nothing, railing, opening };
    Beside beside = Beside::nothing;
};

/// Of all surfaces; what goes on from one to another over a seam ends there on the one and begins on the
/// other.
std::vector<SurfaceEdge> edgesOf(const std::vector<Surface>& surfaces);

/// The outer outline of a surface, seams included.
std::vector<glm::dvec2> outlineOf(const Surface& surface);

}  // namespace throng::authoring
