// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "authoring/diagnostics.h"
#include "authoring/layout.h"
#include "authoring/scene.h"
#include "authoring/scene/behaviours.h"
#include "authoring/scene/itineraries.h"
#include "authoring/scene/rebase.h"
#include "authoring/scene/routes.h"

namespace throng::authoring {

/// With which people are given a place and a way.
struct Placing {
    const Layout& layout;
    const Rebase& rebase;
    const WalkGeometry& geometry;
    Routes& routes;
    Itineraries& itineraries;
    BehaviourTables& behaviours;
    Diagnostics& diagnostics;
    Scene& scene;
};

/// Those of a group, in its order.
template <class SomeScene>
auto rowsOf(SomeScene& scene, std::size_t group_index) {
    const gpu::SpawnQueue& queue = scene.queues[group_index];
    return std::span(scene.people).subspan(queue.first_row, queue.row_count);
}

/// Calls visit(person) for those of a group, in its order.
template <class SomeScene, class Visit>
void forEachRow(SomeScene& scene, std::size_t group_index, Visit visit) {
    for (auto& person : rowsOf(scene, group_index))
        visit(person);
}

std::size_t rowOf(const Scene& scene, const gpu::Person& person);
/// @param i which of its group
Traveller travellerOf(const Scene& scene, const gpu::Person& person, std::size_t group_index,
                      std::uint64_t i);
/// m, from one place in the plane to another as they lie at home.
glm::vec2 wayBetween(const Scene& scene, glm::vec2 from, glm::vec2 to);

/// Whether somebody goes from one place to another in a straight line, and no other way is shorter in time.
bool isStraight(const WalkGeometry& geometry, glm::vec2 from, glm::vec2 to, float radius);

/// The turns that somebody's plan takes at times of the shot.
/// @param from where its group begins
void addPlanChanges(const Placing& with, const Behaviour& plan, const People& people,
                    const std::vector<LocalPolygon>& from, const GroupRandom& random, std::uint64_t i,
                    std::size_t group_index, gpu::Person& person);

}  // namespace throng::authoring
