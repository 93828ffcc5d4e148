// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "authoring/scene.h"
#include "authoring/scene/fields.h"
#include "authoring/scene/rebase.h"

namespace throng::authoring {

/// The segments of all walls, and the outlines of the solid ones, in the scene frame.
void buildWalls(const Layout& layout, const Rebase& rebase, WalkGeometry& geometry);

/// Sites of the diagram along the walls' perimeter, `spacing` apart or less (m): at most a body's radius, so
/// that no body fits between two of them.
/// @param on_charts whether tiles are to lie the same in every part of the plane (shaders/shared/snap.glsl)
std::vector<gpu::WallTile> wallTiles(const std::vector<gpu::WallSegment>& segments, float spacing,
                                     float tile_radius, bool on_charts = false);

/// About as many as one segment needs.
double tilesNeeded(const gpu::WallSegment& segment, float spacing);

/// Prepares the two below for very many walls, whose answers stay what they are. Afterwards, no wall changes.
void sortWalls(WalkGeometry& geometry);

/// How deep a body of this radius at this place is in a wall or a solid polygon, m; negative when it is
/// clear.
float wallDepth(const WalkGeometry& geometry, glm::vec2 position, float radius);

/// Whether a body can walk straight from a to b without touching a wall.
bool straightIsClear(const WalkGeometry& geometry, glm::vec2 a, glm::vec2 b, float radius);

}  // namespace throng::authoring
