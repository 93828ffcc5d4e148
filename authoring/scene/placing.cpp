// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/placing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "authoring/layout/plan.h"
#include "authoring/scene/people.h"
#include "authoring/scene/slope_costs.h"
#include "authoring/scene/walls.h"

namespace throng::authoring {
namespace {

/// How many steps are done at a time of the shot.
std::uint32_t stepAt(const SimulationSettings& settings, double time) {
    return static_cast<std::uint32_t>(std::ceil((time + settings.warmup) * settings.fps * settings.substeps));
}

}  // namespace

std::size_t rowOf(const Scene& scene, const gpu::Person& person) {
    return static_cast<std::size_t>(&person - scene.people.data());
}

Traveller travellerOf(const Scene& scene, const gpu::Person& person, std::size_t group_index,
                      std::uint64_t i) {
    const std::uint32_t first_row = scene.queues[group_index].first_row;
    const std::uint64_t leader = person.party_first - first_row;
    return {leader, static_cast<std::uint32_t>(i - leader), person.party_size, person.radius};
}

glm::vec2 wayBetween(const Scene& scene, glm::vec2 from, glm::vec2 to) {
    return scene.chart_map.home(to) - scene.chart_map.home(from);
}

bool isStraight(const WalkGeometry& geometry, glm::vec2 from, glm::vec2 to, float radius) {
    return straightIsClear(geometry, from, to, radius) &&
           !(geometry.slopes && geometry.slopes->meets(from, to)) &&
           std::ranges::none_of(geometry.costly,
                                [&](const CostlyGround& ground) { return ground.meets(from, to); });
}

void addPlanChanges(const Placing& with, const Behaviour& plan, const People& people,
                    const std::vector<LocalPolygon>& from, const GroupRandom& random, std::uint64_t i,
                    std::size_t group_index, gpu::Person& person) {
    person.first_change = static_cast<std::uint32_t>(with.scene.plan_changes.size());
    std::uint64_t nth = 0;
    for (const Turn& turn : turnsOf(plan)) {
        Journey journey{fmt::format("`{}`", plan.id), plan.states[turn.then].where,
                        (person.flags & gpu::PERSON_KEEPS_TO_ROADS) != 0, wayFrom(plan, turn.then)};
        journey.first_draw = 1000 + nth;
        if (i == 0) with.itineraries.check(journey, "where they start", from);
        const Traveller traveller = travellerOf(with.scene, person, group_index, i);
        const PeopleShare& kind = people.kinds[kindOf(people, random, traveller.leader)];
        const double reaction =
            random.draw(kind.settings.reaction, traveller.leader, Purpose::reaction, nth++);
        gpu::PlanChange change{};
        change.start_step = stepAt(with.layout.simulation, turn.at + reaction);
        change.first_stage = static_cast<std::uint32_t>(with.scene.stages.size());
        change.stage_count = with.itineraries.appendStages(journey, random, traveller);
        with.scene.plan_changes.push_back(change);
        ++person.change_count;
    }
}

}  // namespace throng::authoring
