// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/close_starts.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "authoring/scene/walls.h"
#include "base/plane_grid.h"

namespace throng::authoring {
namespace {

/// visit(i, j) for all pairs that are less than their radii apart.
template <class Visit>
void visitPairs(std::span<const gpu::Person> people, Visit visit) {
    std::vector<glm::dvec2> places;
    std::vector<glm::vec3> discs;  // where, and how large: all that is looked at often
    places.reserve(people.size());
    discs.reserve(people.size());
    glm::vec3 lower(people.front().spawn_position, people.front().radius), upper = lower;
    for (const gpu::Person& person : people) {
        places.emplace_back(person.spawn_position);
        discs.emplace_back(person.spawn_position, person.radius);
        lower = glm::min(lower, discs.back());
        upper = glm::max(upper, discs.back());
    }
    PlaneGrid grid(lower, upper, 2.0 * double{upper.z}, cellsFor(people.size()));
    grid.sort(places);
    for (std::uint32_t i = 0; i < people.size(); ++i) {
        const glm::vec3 disc = discs[i];
        grid.near(places[i], double{disc.z} + double{upper.z}, [&](std::uint32_t j) {
            if (j > i && glm::distance(glm::vec2(discs[j]), glm::vec2(disc)) < discs[j].z + disc.z)
                visit(i, j);
        });
    }
}

bool mayBeInWall(const gpu::Person& person, const WalkGeometry& geometry) {
    constexpr float kHair = 1.0e-3f;  // m
    // The ends of a body may be in a solid that its middle is not in.
    if (person.half_axis != 0.0f && !geometry.solids.empty()) return true;
    return wallDepth(geometry, person.spawn_position, person.radius + kHair) > 0.0f;
}

}  // namespace

CloseStarts closeStarts(const Scene& scene, const WalkGeometry& geometry, std::size_t first_group,
                        std::size_t groups) {
    CloseStarts close;
    close.of_row.assign(scene.people.size(), 0);
    if (groups == 0) return close;
    const std::size_t first = scene.queues[first_group].first_row;
    const gpu::SpawnQueue& last = scene.queues[first_group + groups - 1];
    const std::span people = std::span(scene.people).subspan(first, last.first_row + last.row_count - first);
    if (people.empty()) return close;
    const std::span flags = std::span(close.of_row).subspan(first, people.size());
    visitPairs(people, [&](std::uint32_t i, std::uint32_t j) {
        flags[i] |= CloseStarts::kToBody;
        flags[j] |= CloseStarts::kToBody;
    });
    for (std::size_t i = 0; i < people.size(); ++i)
        if (mayBeInWall(people[i], geometry)) flags[i] |= CloseStarts::kToWall;
    return close;
}

}  // namespace throng::authoring
