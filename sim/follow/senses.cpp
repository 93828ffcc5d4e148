// SPDX-License-Identifier: Apache-2.0
#include "sim/follow/senses.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "sim/wall_index.h"

namespace throng::sim {
namespace {

float distanceToWall(glm::vec2 place, const gpu::WallSegment& wall) {
    const glm::vec2 axis = wall.b - wall.a;
    const float along = glm::dot(place - wall.a, axis) / std::max(glm::dot(axis, axis), 1.0e-12f);
    const glm::vec2 nearest = wall.a + axis * std::clamp(along, 0.0f, 1.0f);
    return glm::distance(place, nearest) - wall.half_thickness;
}

/// s until two bodies touch as they move; -1: they do not.
float secondsToTouch(const gpu::Body& self, const gpu::Body& other) {
    const glm::vec2 offset = self.position - other.position;
    const glm::vec2 relative = self.velocity - other.velocity;
    const float reach = self.radius + other.radius;
    const float beyond = glm::dot(offset, offset) - reach * reach;
    const float closing = -glm::dot(offset, relative);
    const float speed_squared = glm::dot(relative, relative);
    if (beyond <= 0.0f) return 0.0f;
    const float inside = closing * closing - speed_squared * beyond;
    if (closing <= 0.0f || inside <= 0.0f || speed_squared < 1.0e-6f) return -1.0f;
    return (closing - std::sqrt(inside)) / speed_squared;
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

void tellSenses(const Simulation::Parts& parts, const authoring::Scene& scene,
                const std::vector<gpu::Body>& bodies, std::uint32_t slot, FollowedStep& step) {
    const Buffers& buffers = parts.buffers;
    const gpu::Body& self = bodies[slot];
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
        } else if (key < bodies.size()) {
            const gpu::Body& other = bodies[key];
            step.sensed.push_back({other.row, other.position, other.radius,
                                   glm::distance(self.position, other.position) - self.radius - other.radius,
                                   secondsToTouch(self, other)});
        }
    }
    step.wall_gap = -1.0f;
    float nearest = std::numeric_limits<float>::infinity();
    for (const std::uint32_t wall : walls)
        nearest = std::min(nearest, distanceToWall(self.position, scene.wall_segments[wall]));
    if (std::isfinite(nearest)) step.wall_gap = std::max(nearest - self.radius, 0.0f);
}

float freeAhead(const FollowedStep& step) {
    const float speed = glm::length(step.wish);
    if (speed <= gpu::STANDING_SPEED) return -1.0f;
    const glm::vec2 way = step.wish / speed;
    float free = -1.0f;
    for (const SensedPerson& other : step.sensed) {
        const glm::vec2 offset = other.place - step.place_before;
        const float ahead = glm::dot(offset, way);
        const float reach = step.radius + other.radius;
        const float aside_squared = std::max(glm::dot(offset, offset) - ahead * ahead, 0.0f);
        if (ahead <= 0.0f || aside_squared >= reach * reach) continue;
        const float gap = std::max(ahead - std::sqrt(reach * reach - aside_squared), 0.0f);
        free = free < 0.0f ? gap : std::min(free, gap);
    }
    return free;
}

}  // namespace throng::sim
