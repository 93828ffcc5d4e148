// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "authoring/layout.h"
#include "authoring/scene/random.h"
#include "shaders/shared/scene_types.h"

namespace throng::authoring {

/// To draw or turn so many takes some milliseconds.
inline constexpr std::size_t kPeopleWorthAThread = 20'000;

/// How many characters the cast has: Person::variation is below this.
inline constexpr std::uint32_t kVariations = 12;

/// Which kind of people somebody is, as an index.
std::uint32_t kindOf(const People& people, const GroupRandom& random, std::uint64_t index);
/// Draws what makes one person of a group differ from the next: body, speed, gait, looks. Place and route are
/// left open.
gpu::Person drawPerson(const People& people, const GroupRandom& random, std::uint64_t index,
                       std::uint32_t group);

/// People of one group, next to each other in its order, who walk together.
struct Party {
    std::uint64_t first = 0;
    std::uint32_t size = 1;
};
/// Splits the people of a group into parties.
std::vector<Party> drawParties(const People& people, const GroupRandom& random, std::uint64_t count);
/// The same for people who stand somewhere: only neighbours walk together.
std::vector<Party> drawParties(const People& people, const GroupRandom& random,
                               const std::vector<glm::dvec2>& positions);
/// Parties that end where a person begins another one. @param begins asked of nobody's first
std::vector<Party> splitWhere(const std::vector<Party>& parties,
                              const std::function<bool(std::uint64_t)>& begins);
/// Walks together: everybody as fast as the party, which is slower the larger it is.
void walkTogether(std::span<gpu::Person> party);

/// Changes of a flow's rate.
struct RateChange {
    double time = 0.0;  ///< s
    double rate = 0.0;  ///< persons/s
};

/// When the people of a flow want to enter, s, in order: evenly spread with some jitter (count) or as a
/// Poisson process (rate).
/// @param end s: nobody enters from here on, whatever the flow says
std::vector<double> entryTimes(const Flow& flow, const std::vector<RateChange>& changes,
                               const GroupRandom& random, double warmup, double end);

}  // namespace throng::authoring
