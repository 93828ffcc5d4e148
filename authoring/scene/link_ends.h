// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "authoring/diagnostics.h"
#include "authoring/layout.h"
#include "authoring/scene/terrain_places.h"

namespace throng::authoring {

/// Finds how high the ground of a terrain is where links begin and end and before the doors of lifts.
/// @param ground, places of the terrain without links: each end has to be on the ground that its level names,
/// on foot
/// @returns the layout with heights of all links, lifts and landings; nothing where there are mistakes, which
/// are told
std::optional<Layout> withLinkEnds(const Layout& layout, const Walkable& ground, const TerrainPlaces& places,
                                   Diagnostics& diagnostics);

}  // namespace throng::authoring
