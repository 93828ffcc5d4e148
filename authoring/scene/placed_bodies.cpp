// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/placed_bodies.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace throng::authoring {
namespace {

constexpr float kBodyCell = 2.0f;  // m: bodies have radii of up to one

bool areInEachOther(const gpu::Person& a, const gpu::Person& b) {
    if (glm::distance(b.spawn_position, a.spawn_position) >= b.radius + a.radius) return false;
    return (a.half_axis == 0.0f && b.half_axis == 0.0f) || freeBetween(shapeOf(a), shapeOf(b)) < 0.0;
}

std::uint64_t cellKey(glm::vec2 position, int dx, int dy) {
    const auto x = static_cast<std::int32_t>(std::floor(position.x / kBodyCell)) + dx;
    const auto y = static_cast<std::int32_t>(std::floor(position.y / kBodyCell)) + dy;
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32 | static_cast<std::uint32_t>(y);
}

}  // namespace

Capsule shapeOf(const gpu::Person& person) {
    const double heading = person.heading;
    return capsuleOf(person.spawn_position, {std::cos(heading), std::sin(heading)}, person.radius,
                     person.half_axis);
}

float thicknessOf(const gpu::Person& person) {
    return person.radius - std::abs(person.half_axis);
}

bool PlacedBodies::hasRoom(const gpu::Person& person) const {
    const glm::vec2 position = person.spawn_position;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            const auto cell = cells_.find(cellKey(position, x, y));
            if (cell == cells_.end()) continue;
            for (const gpu::Person& other : cell->second)
                if (areInEachOther(person, other)) return false;
        }
    return true;
}

void PlacedBodies::add(const gpu::Person& person) {
    cells_[cellKey(person.spawn_position, 0, 0)].push_back(person);
}

}  // namespace throng::authoring
