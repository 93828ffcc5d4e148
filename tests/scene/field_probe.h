// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/packing.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <queue>
#include <vector>

#include "authoring/scene.h"
#include "authoring/scene/walls.h"

namespace throng::authoring {

/// What shaders/routes/route.glsl makes of a field.
struct Probe {
    glm::vec2 direction{0.0f};
    float remaining = 0.0f;
    bool straight = false;
};

inline Probe probe(const Scene& scene, std::uint32_t field, glm::vec2 at) {
    const FieldStore& store = scene.fields;
    std::size_t first = 0, row = 0;
    glm::vec2 fraction(0.0f);
    if (store.blocks_across > 0) {
        const glm::vec2 cells = (at - scene.grid.minimum) / store.block_cell;
        const auto x = static_cast<std::uint32_t>(cells.x) / 8, y = static_cast<std::uint32_t>(cells.y) / 8;
        const auto cells_of_block = std::bit_cast<std::uint32_t>(
            store.block_table[std::size_t{y} * store.blocks_across + x].distance);
        const glm::vec2 local = cells - glm::vec2(8 * x, 8 * y);
        const bool is_fine = cells_of_block > 0;
        first = is_fine ? cells_of_block : std::size_t{y} * (store.blocks_across + 1) + x;
        row = is_fine ? 10 : store.blocks_across + 1;
        fraction = is_fine ? local + 0.5f : local / 8.0f;
    } else {
        fraction = (at - scene.grid.minimum) / scene.grid.cell_size - 0.5f;
        row = scene.grid.width;
    }
    const glm::vec2 cell = glm::floor(fraction);
    fraction -= cell;
    first += static_cast<std::size_t>(cell.y) * row + static_cast<std::size_t>(cell.x);
    Probe result;
    float straight = 0.0f;
    for (std::size_t i = 0; i < 4; ++i) {
        const gpu::FieldCell& corner = (*store.fields[field])[first + i / 2 * row + i % 2];
        const float weight =
            (i % 2 ? fraction.x : 1.0f - fraction.x) * (i / 2 ? fraction.y : 1.0f - fraction.y);
        result.direction += weight * glm::unpackSnorm2x16(corner.direction);
        result.remaining += weight * std::abs(corner.distance);
        if (corner.distance < 0.0f) straight += weight;
    }
    result.straight = straight > 0.5f;
    return result;
}

/// How somebody alone walks to the point of its last stage. Infinite where it does not come to it.
inline float walkedWay(const Scene& scene, const gpu::Person& person) {
    constexpr float kStep = 0.05f;  // m
    const gpu::Stage& stage = scene.stages[person.first_stage + person.stage_count - 1];
    WalkGeometry geometry;
    geometry.walls = scene.wall_segments;
    glm::vec2 at = person.spawn_position;
    for (float walked = 0.0f; walked < 5000.0f; walked += kStep) {
        const glm::vec2 way = stage.point - at;
        if (wallDepth(geometry, at, 0.5f * person.radius) > 0.0f) break;  // its body stops it
        if (glm::length(way) <= stage.tolerance) return walked + glm::length(way);
        glm::vec2 direction = way;
        if (stage.field != gpu::NO_INDEX) {
            const Probe ahead = probe(scene, stage.field & ~gpu::FIELD_THEN_POINT, at);
            if (!ahead.straight) direction = ahead.direction;
        }
        at += kStep * direction / std::max(glm::length(direction), 1.0e-6f);
    }
    return std::numeric_limits<float>::infinity();
}

/// Metres that a field tells of somebody's way from its start.
inline float toldWay(const Scene& scene, const gpu::Person& person) {
    const gpu::Stage& stage = scene.stages[person.first_stage + person.stage_count - 1];
    const float straight = glm::distance(person.spawn_position, stage.point);
    if (stage.field == gpu::NO_INDEX) return straight;
    const Probe ahead = probe(scene, stage.field & ~gpu::FIELD_THEN_POINT, person.spawn_position);
    return ahead.straight ? straight : std::max(ahead.remaining, straight);
}

/// The shortest way of a body round walls, by a graph of what sees what: its nodes are points on circles of
/// the body's radius round the ends of all walls.
inline float shortestWay(const Scene& scene, const gpu::Person& person) {
    constexpr int kOnCircle = 24;
    constexpr float kOutside = 1.01f;  // chords of the circle, too, keep clear of the end
    WalkGeometry geometry;
    geometry.walls = scene.wall_segments;
    const float radius = 0.98f * person.radius;
    std::vector<glm::vec2> nodes = {person.spawn_position,
                                    scene.stages[person.first_stage + person.stage_count - 1].point};
    for (const gpu::WallSegment& wall : scene.wall_segments)
        for (const glm::vec2 end : {wall.a, wall.b})
            for (int i = 0; i < kOnCircle; ++i) {
                const float angle = 6.2831853f * static_cast<float>(i) / kOnCircle;
                const glm::vec2 node = end + kOutside * (person.radius + wall.half_thickness) *
                                                 glm::vec2(std::cos(angle), std::sin(angle));
                if (wallDepth(geometry, node, radius) <= 0.0f) nodes.push_back(node);
            }
    std::vector<float> way(nodes.size(), std::numeric_limits<float>::infinity());
    std::vector<bool> done(nodes.size(), false);
    way[0] = 0.0f;
    for (std::size_t round = 0; round < nodes.size(); ++round) {
        std::size_t next = nodes.size();
        for (std::size_t i = 0; i < nodes.size(); ++i)
            if (!done[i] && (next == nodes.size() || way[i] < way[next])) next = i;
        if (next == 1 || way[next] == std::numeric_limits<float>::infinity()) break;
        done[next] = true;
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            const float found = way[next] + glm::distance(nodes[next], nodes[i]);
            if (!done[i] && found < way[i] && straightIsClear(geometry, nodes[next], nodes[i], radius))
                way[i] = found;
        }
    }
    return way[1];
}

}  // namespace throng::authoring
