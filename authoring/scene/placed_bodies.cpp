// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/placed_bodies.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace throng::authoring {
namespace {

constexpr float kSquare = 2.0f;  // m, the side of one: bodies have radii of up to one

std::uint64_t squareOf(glm::vec2 position, int dx, int dy) {
    const auto x = static_cast<std::int32_t>(std::floor(position.x / kSquare)) + dx;
    const auto y = static_cast<std::int32_t>(std::floor(position.y / kSquare)) + dy;
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32 | static_cast<std::uint32_t>(y);
}

Capsule shapeOf(glm::vec2 position, double heading, float radius, float half_axis) {
    return capsuleOf(position, {std::cos(heading), std::sin(heading)}, radius, half_axis);
}

}  // namespace

Capsule shapeOf(const gpu::Person& person) {
    return shapeOf(person.spawn_position, person.heading, person.radius, person.half_axis);
}

float thicknessOf(const gpu::Person& person) {
    return person.radius - std::abs(person.half_axis);
}

bool PlacedBodies::areInEachOther(const Body& a, const Body& b) {
    if (glm::distance(b.position, a.position) >= b.radius + a.radius) return false;
    if (a.half_axis == 0.0f && b.half_axis == 0.0f) return true;
    return freeBetween(shapeOf(a.position, a.heading, a.radius, a.half_axis),
                       shapeOf(b.position, b.heading, b.radius, b.half_axis)) < 0.0;
}

bool PlacedBodies::hasRoom(const gpu::Person& person) const {
    const Body body{person.spawn_position, person.radius, person.half_axis, person.heading, kNone};
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            const auto square = last_in_.find(squareOf(body.position, x, y));
            if (square == last_in_.end()) continue;
            for (std::uint32_t i = square->second; i != kNone; i = bodies_[i].same_square)
                if (areInEachOther(body, bodies_[i])) return false;
        }
    return true;
}

void PlacedBodies::add(const gpu::Person& person) {
    const auto [square, is_new] = last_in_.try_emplace(squareOf(person.spawn_position, 0, 0), kNone);
    bodies_.push_back(
        {person.spawn_position, person.radius, person.half_axis, person.heading, square->second});
    square->second = static_cast<std::uint32_t>(bodies_.size() - 1);
}

}  // namespace throng::authoring
