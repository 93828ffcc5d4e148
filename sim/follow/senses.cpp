// SPDX-License-Identifier: Apache-2.0
#include "sim/follow/senses.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "base/capsule.h"
#include "sim/wall_index.h"

namespace throng::sim {
namespace {

Capsule bodyIn(const BodiesThere& there, std::uint32_t slot) {
    const gpu::Body& body = there.bodies[slot];
    const double radius = double{body.radius};
    if (there.chests.empty()) return {body.position, glm::dvec2(0.0), radius};
    const gpu::Chest& chest = there.chests[body.row];
    const glm::dvec2 facing(std::cos(double{chest.angle}), std::sin(double{chest.angle}));
    return capsuleOf(body.position, facing, radius, double{chest.half_axis});
}

Capsule asBody(const gpu::WallSegment& wall) {
    const glm::dvec2 a = wall.a, b = wall.b;
    return {0.5 * (a + b), 0.5 * (b - a), static_cast<double>(wall.half_thickness)};
}

/// How long one body has to move at a velocity, without turning, to touch another that stands; below zero: it
/// passes by. No body comes nearer to another than by as much as it moves, so it may always go on by what is
/// free.
double untilTouch(Capsule self, const Capsule& other, glm::dvec2 velocity) {
    constexpr int kRounds = 200;
    constexpr double kTouch = 1.0e-4;  // m
    const double speed = glm::length(velocity);
    double time = 0.0;
    for (int round = 0; round < kRounds; ++round) {
        const glm::dvec2 gap = segmentsGap(self.middle - other.middle, self.axis, other.axis);
        const double free = glm::length(gap) - self.thickness - other.thickness;
        if (free <= kTouch) return time;
        if (glm::dot(gap, velocity) >= 0.0) return -1.0;
        self.middle += velocity * (free / speed);
        time += free / speed;
    }
    return -1.0;  // it touches nothing, or hardly
}

/// Segments of the cell that a place is in: those near by.
std::vector<std::uint32_t> wallsNear(const Simulation::Parts& parts, glm::vec2 place) {
    const gpu::Parameters& p = parts.parameters;
    const glm::ivec2 cell = glm::clamp(glm::ivec2((place - p.cells_minimum) / p.cell_size), glm::ivec2(0),
                                       glm::ivec2(p.cells_width, p.cells_height) - 1);
    const auto index = static_cast<std::size_t>(cell.y) * p.cells_width + static_cast<std::size_t>(cell.x);
    const gl::Buffer& starts = parts.buffers.wall_starts;
    const glm::uvec2 run = sim::wallsNear(starts.download<std::uint32_t>(starts.bytes() / gl::kWord), index);
    return parts.buffers.wall_items.download<std::uint32_t>(run.y - run.x, run.x);
}

}  // namespace

void tellSenses(const Simulation::Parts& parts, const authoring::Scene& scene, const BodiesThere& there,
                std::uint32_t slot, FollowedStep& step) {
    const Buffers& buffers = parts.buffers;
    const gpu::Body& self = there.bodies[slot];
    const Capsule body = bodyIn(there, slot);
    const std::uint32_t count = buffers.neighbour_counts.download<std::uint32_t>(1, slot).front();
    const std::uint32_t touch = buffers.touch_words.download<std::uint32_t>(1, slot).front();
    step.touching = touch & gpu::TOUCH_COUNT_MASK;
    step.in_narrows = (touch & gpu::TOUCH_IN_NARROWS) != 0;
    std::vector<std::uint32_t> walls = wallsNear(parts, self.position);
    step.sensed.clear();
    for (std::uint32_t nth = 0; nth < count; ++nth) {
        const std::size_t at = std::size_t{nth} * buffers.slotCapacity() + slot;
        const std::uint32_t key = buffers.neighbours.download<std::uint32_t>(1, at).front();
        if (key & gpu::NEIGHBOUR_IS_WALL) {
            walls.push_back(key & ~gpu::NEIGHBOUR_IS_WALL);
        } else if (key < there.bodies.size()) {
            const gpu::Body& other = there.bodies[key];
            const Capsule its = bodyIn(there, key);
            const glm::dvec2 relative = self.velocity - other.velocity;
            step.sensed.push_back({other.row, other.position, other.radius, its.axis,
                                   static_cast<float>(freeBetween(body, its)),
                                   static_cast<float>(untilTouch(body, its, relative))});
        }
    }
    step.wall_gap = -1.0f;
    double nearest = std::numeric_limits<double>::infinity();
    for (const std::uint32_t wall : walls)
        nearest = std::min(nearest, freeBetween(body, asBody(scene.wall_segments[wall])));
    if (std::isfinite(nearest)) step.wall_gap = static_cast<float>(std::max(nearest, 0.0));
}

float freeAhead(const FollowedStep& step) {
    const glm::dvec2 wish = step.wish;
    const double speed = glm::length(wish);
    if (speed <= static_cast<double>(gpu::STANDING_SPEED)) return -1.0f;
    const glm::dvec2 way = wish / speed;
    const Capsule self = bodyBefore(step);
    double free = -1.0;
    for (const SensedPerson& other : step.sensed) {
        if (glm::dot(glm::dvec2(other.place) - self.middle, way) <= 0.0) continue;
        const double gap = untilTouch(self, bodyOf(other), way);
        if (gap >= 0.0) free = free < 0.0 ? gap : std::min(free, gap);
    }
    return static_cast<float>(free);
}

}  // namespace throng::sim
