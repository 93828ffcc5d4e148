// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "authoring/diagnostics.h"
#include "authoring/layout.h"
#include "authoring/scene.h"
#include "authoring/scene/ground.h"

namespace throng::authoring {

/// Turns a layout into what the simulation needs. Deterministic: the same layout gives the same scene, bit
/// for bit.
/// @returns nothing when `diagnostics` has errors: people inside walls, goals that cannot be reached, entries
/// without room
/// @param cache of ground, for whoever makes several scenes; null: for this one only
/// @param solver of distance fields; null: fast marching on all processors
std::optional<Scene> buildScene(const Layout& layout, Diagnostics& diagnostics, GroundCache* cache = nullptr,
                                const TerrainMesh* terrain = nullptr, DistanceSolver* solver = nullptr);

}  // namespace throng::authoring
