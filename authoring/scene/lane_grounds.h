// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "authoring/diagnostics.h"
#include "authoring/scene/terrain_places.h"
#include "authoring/storeys/charts.h"

namespace throng::authoring {

/// Puts lanes and crossings on the grounds of a terrain: each lies on one. What leads from one to another, or
/// has no ground at all, is told.
/// @param placed whose lanes and crossings get their charts
/// @param charts that are to have room for their lanes in the plane, however far these lead
void layLanes(Layout& placed, const TerrainPlaces& places, std::vector<Chart>& charts,
              Diagnostics& diagnostics);

/// Tells of lanes that come to where their ground goes on as another: neither drivers nor people would know
/// of each other there.
void checkLanes(const Layout& placed, const Charts& charts, Diagnostics& diagnostics);

}  // namespace throng::authoring
