// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "authoring/scene.h"
#include "authoring/scene/distance_solver.h"
#include "authoring/storeys/charts.h"

namespace throng::authoring {

/// The raster over all of a scene's plane.
/// @param minimum, maximum the scene's bounds; @param origin the scene's
ChartMap makeChartMap(const Charts& charts, glm::vec2 minimum, glm::vec2 maximum, glm::dvec2 origin);

/// How many metres on the flat take as long as one metre, in plan, of a link that rises so much over its run:
/// the mean of up and down, as people walk there (shaders/motion/slope_pace.glsl).
float costOfLink(const MotionSettings& motion, bool stairs, double slope);
/// The same of ground that moves at `speed` (m/s, in plan), one way only: for those who walk on it. Who
/// stands could walk, and takes the ride for the rest that it gives.
float costOfBelt(const MotionSettings& motion, bool stairs, double slope, double speed);

/// @param grid whose cells are as large as those of the map or a power of two smaller or larger, and which
/// begins where the map does
SeamCells seamCellsOf(const ChartMap& map, const FieldGrid& grid);

}  // namespace throng::authoring
