// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "authoring/diagnostics.h"
#include "authoring/layout.h"
#include "authoring/terrain/terrain_mesh.h"

namespace throng::authoring {

/// Tells blocks of seats how high the terrain is under them; where one cannot stand there, or people cannot
/// walk to its seats, that is an error.
void layOnTerrain(Layout& layout, const TerrainMesh& mesh, Diagnostics& diagnostics);

/// Whether all blocks are on ground that they can be on: on a terrain that is cut into storeys there are only
/// those that nobody walks to, and that stand level.
bool haveGround(const Layout& layout, bool has_storeys, Diagnostics& diagnostics);

}  // namespace throng::authoring
