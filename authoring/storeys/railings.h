// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "authoring/storeys/charts.h"

namespace throng::authoring {

/// Where a chart's ground ends and no other's begins.
std::vector<Railing> railingsOf(const std::vector<Chart>& charts, std::size_t chart);

/// The parts of a line, in home coordinates, that stand within the margin of a chart on somebody else's
/// ground: not those that stand above or below the chart's own.
/// @param owner whose; only those count
std::vector<std::vector<glm::dvec2>> partsInMargin(const Chart& chart, const ChartRaster& raster,
                                                   std::size_t owner, const std::vector<glm::dvec2>& line,
                                                   double half_thickness);

}  // namespace throng::authoring
