// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "authoring/diagnostics.h"
#include "authoring/layout.h"
#include "authoring/scene/rebase.h"
#include "authoring/scene_traffic.h"

namespace throng::authoring {

/// How many people a flow brings that gets off vehicles.
std::uint64_t alightingPeople(const Layout& layout, const Flow& flow);

/// What the stages say of people who wait there to get on (gpu::Stage::board).
std::uint32_t boardWord(const Layout& layout, const AtPlatform& at);

/// What those who wait at a platform look at: the middle of where vehicles stand.
glm::dvec2 sightAt(const Layout& layout, const AtPlatform& at);

/// The number of a stop's platform among all of them.
std::uint32_t platformNumber(const Layout& layout, std::size_t lane, std::size_t stop);

/// Platforms, and what each vehicle does there. Once all vehicles are in order. Tells of doors that open
/// where there is no platform, and of stops and lines that are of no use.
void addBoarding(const Layout& layout, const Rebase& rebase, SceneTraffic& traffic, Diagnostics& diagnostics);

/// Who gets off which vehicle. @param queues the rows of each flow
void addCalls(const Layout& layout, const std::vector<gpu::SpawnQueue>& queues, SceneTraffic& traffic);

}  // namespace throng::authoring
