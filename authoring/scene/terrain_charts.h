// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "authoring/diagnostics.h"
#include "authoring/scene.h"
#include "authoring/storeys/charts.h"

namespace throng::authoring {

/// Cuts a terrain with faces above each other into charts, with the layout on them.
/// @returns null where the terrain has one storey, or the layout asks for one; and where there are mistakes,
/// which are told
std::shared_ptr<const Charts> layOutTerrain(const Layout& layout, const TerrainMesh& mesh,
                                            Diagnostics& diagnostics);

/// Which faces of the terrain people stand on, all over a scene's plane.
PlaneGround planeGroundOf(const Charts& charts, const ChartMap& map, glm::dvec2 origin);

/// What walking costs on the slopes and stairs of a terrain, by cell of the map.
std::vector<float> slopeCosts(const Terrain& terrain, const ChartMap& map, const MotionSettings& motion);

}  // namespace throng::authoring
