// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/route_flow.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "authoring/layout/plan.h"
#include "authoring/scene/boarding.h"
#include "authoring/scene/traffic.h"
#include "authoring/scene/walls.h"

namespace throng::authoring {
namespace {

constexpr std::uint32_t kEntryPoints = 1024;
constexpr float kEntryClearance = 0.02f;  // m beyond the body

/// Who gets on waits until then, and looks at the tracks.
std::vector<BehaviourState> waitsOnTheWay(const Layout& layout, const Behaviour& plan, const Flow& flow) {
    std::vector<BehaviourState> way = wayFrom(plan, plan.start);
    if (!flow.boards) return way;
    way.back().lasts = {Distribution::Kind::constant, double{gpu::DWELL_WHILE}, 0.0, 0.0, 0.0};
    way.back().facing = sightAt(layout, *flow.boards);
    return way;
}

/// Points clear of walls and with a way to the goal.
gpu::Entry findEntryPoints(const Placing& with, const Flow& flow, std::size_t index, std::uint32_t field) {
    float largest = 0.0f;
    forEachRow(with.scene, index,
               [&](const gpu::Person& person) { largest = std::max(largest, person.radius); });
    const LocalPolygon outline = with.routes.outline(flow.from, Routes::kEntryDepth);
    const auto first = static_cast<std::uint32_t>(with.scene.entry_points.size());
    Itineraries::Spread spread(outline, with.geometry, largest + kEntryClearance);
    for (std::uint32_t i = 0; i < 16 * kEntryPoints && with.scene.entry_points.size() - first < kEntryPoints;
         ++i) {
        const std::optional<glm::vec2> point = spread.next();
        if (!point) break;
        if (field == gpu::NO_INDEX || with.routes.reachable(field, *point) < kUnreachable)
            with.scene.entry_points.push_back(*point);
    }
    const auto found = static_cast<std::uint32_t>(with.scene.entry_points.size()) - first;
    if (found == 0) {
        with.diagnostics.error(
            flow.from.where.line ? flow.from.where : flow.where,
            fmt::format("flow `{}`: there is no room to enter in `{}`", flow.id, with.routes.name(flow.from)),
            "its area is inside a wall, too small for a body, or cut off from the goal");
        with.scene.entry_points.push_back(outline.front());
    }
    return {first, std::max(found, 1u)};
}

}  // namespace

void routeFlow(const Placing& with, const Flow& flow, std::size_t index) {
    const Behaviour plan = planOf(with.layout, flow);
    Journey journey{fmt::format("flow `{}`", flow.id), flow.where, keepsToRoads(with.layout)};
    const LocalPolygon start = with.routes.outline(flow.from, Routes::kEntryDepth);
    const std::string from = fmt::format("`{}`", with.routes.name(flow.from));
    std::uint32_t state = 0, first_field = 0;
    if (flow.behaviour) {
        state = with.behaviours.add(with.layout.behaviours[*flow.behaviour],
                                    {journey.traveller, index, journey.keep_to_roads, from, {start}});
        first_field = with.behaviours.fieldOf(state);
    } else {
        journey.stops = waitsOnTheWay(with.layout, plan, flow);
        with.itineraries.check(journey, from, {start});
        first_field = with.itineraries.fieldTo(journey.stops.front().to, journey.keep_to_roads);
    }
    const auto entry = static_cast<std::uint32_t>(with.scene.entries.size());
    with.scene.entries.push_back(findEntryPoints(with, flow, index, first_field));
    const GroupRandom random(with.layout.simulation.seed, flow.id);
    std::uint64_t i = 0;
    gpu::Person before{};
    forEachRow(with.scene, index, [&](gpu::Person& person) {
        person.entry = entry;
        if (flow.behaviour) {
            with.behaviours.begin(person, rowOf(with.scene, person), state);
        } else if (i > 0 && Itineraries::isShared(journey)) {
            person.first_stage = before.first_stage;
            person.stage_count = before.stage_count;
        } else {
            person.first_stage = static_cast<std::uint32_t>(with.scene.stages.size());
            person.stage_count =
                with.itineraries.appendStages(journey, random, travellerOf(with.scene, person, index, i));
            if (flow.boards) with.scene.stages.back().board = boardWord(with.layout, *flow.boards);
        }
        const glm::vec2 goal = with.scene.stages[person.first_stage + person.stage_count - 1].point;
        const glm::vec2 ahead =
            wayBetween(with.scene, with.scene.entry_points[with.scene.entries[entry].first_point], goal);
        person.heading = std::atan2(ahead.y, ahead.x);
        with.scene.goals.push_back(goal);
        addPlanChanges(with, plan, flow.people, {start}, random, i, index, person);
        before = person;
        ++i;
    });
}

}  // namespace throng::authoring
