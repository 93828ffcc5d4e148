// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "authoring/diagnostics.h"
#include "authoring/scene/fields.h"
#include "authoring/scene/rebase.h"
#include "authoring/terrain/terrain.h"

namespace throng::authoring {

/// Tells where people would have no ground to stand on (an error), and of ground that is not what a crowd
/// with one storey can walk on: bridges, cliffs, holes (warnings).
void checkTerrain(const Layout& layout, const Rebase& rebase, const WalkGeometry& geometry,
                  const TerrainMesh& mesh, const Terrain& terrain, Diagnostics& diagnostics);

/// That levels have a floor each where there is no terrain, and name grounds of it where there is one.
bool areLevelsComplete(const Layout& layout, Diagnostics& diagnostics);

/// The lowest and the highest ground along a wall, m.
glm::dvec2 groundAlong(const Wall& wall, const Rebase& rebase, const Terrain& terrain);

}  // namespace throng::authoring
