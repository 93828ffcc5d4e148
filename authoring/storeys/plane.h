// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "authoring/storeys/charts.h"

/// How charts come to lie in the plane, whether they are floors or cut from a terrain.
namespace throng::authoring {

inline constexpr std::size_t kMostCharts = gpu::NO_CHART;

/// m: as far as people sense, and the tiles of those whom they sense there.
double reachOf(const Layout& layout);

void movePoints(std::vector<glm::dvec2>& points, glm::dvec2 by);

/// Everything of the layout to where its chart lies.
/// @param layout whose levels are charts
/// @param given the charts of given ways, as Charts::given
Layout moved(const Layout& layout, const std::vector<Chart>& charts, const GivenCharts& given);

/// Gives the charts their shifts and makes their rasters.
void layInPlane(Charts& charts);

struct StandingWall {
    std::size_t wall, chart;  ///< index into Charts::walls; whose ground it stands on
};

/// In each chart's margin, what stands there of others' walls.
void copyWallsIntoMargins(Charts& charts, const std::vector<StandingWall>& standing);

}  // namespace throng::authoring
