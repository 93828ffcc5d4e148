// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "authoring/layout.h"
#include "authoring/scene/random.h"
#include "shaders/shared/scene_types.h"

namespace throng::authoring {

/// How many characters the cast has: Person::variation is below this.
inline constexpr std::uint32_t kVariations = 8;

/// Draws what makes one person of a group differ from the next: body, speed, gait, looks. Place and route are
/// left open.
gpu::Person drawPerson(const People& people, const GroupRandom& random, std::uint64_t index,
                       std::uint32_t group);

/// When the people of a flow want to enter, s, in order: evenly spread with some jitter (count) or as a
/// Poisson process (rate).
std::vector<double> entryTimes(const Flow& flow, const GroupRandom& random, double warmup);

}  // namespace throng::authoring
