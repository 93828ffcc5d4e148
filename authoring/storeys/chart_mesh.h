// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "authoring/storeys/chart.h"
#include "authoring/terrain/terrain_mesh.h"

namespace throng::authoring {

/// How many treads a link has; a ramp has none.
std::size_t treadsOf(const Chart& chart, const Layout& layout);

/// Floors as slabs with their openings, stairs with treads and risers, ramps, in home coordinates.
TerrainMesh homeMesh(const std::vector<Chart>& charts, const Layout& layout);

/// What people stand on, each chart where it lies in the plane, and in its margin what goes on beyond its
/// seams.
/// @param reach m, of the margin
TerrainMesh planeMesh(const std::vector<Chart>& charts, const Layout& layout, double reach);

}  // namespace throng::authoring
