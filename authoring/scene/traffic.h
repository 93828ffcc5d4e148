// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "authoring/diagnostics.h"
#include "authoring/layout.h"
#include "authoring/scene/rebase.h"
#include "authoring/scene_traffic.h"

namespace throng::authoring {

/// Whether people walk over streets only where there are crossings: there are some, or platforms.
bool keepsOffStreets(const Layout& layout);

/// Whether flows keep to roads, areas and crossings.
bool keepsToRoads(const Layout& layout);

/// Tells of lanes and crossings in a layout that can have none.
bool isWithoutTraffic(const Layout& layout, Diagnostics& diagnostics);

/// When vehicles of a flow come, s, in order.
std::vector<double> vehicleTimes(const Layout& layout, const VehicleFlow& flow);

/// When something is green by a signal; nothing where the signal does not have it.
std::optional<LightPlan> lightPlan(const Signal& signal, const Lit& what);

/// Lanes, stops, crossings and everybody who drives. Tells of more vehicles than a bake can hold.
SceneTraffic buildTraffic(const Layout& layout, const Rebase& rebase, Diagnostics& diagnostics);

}  // namespace throng::authoring
