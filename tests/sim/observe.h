// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <unordered_map>
#include <vector>

#include "authoring/scene.h"
#include "sim/simulation_parts.h"

/// What an onlooker measures, from positions alone.
namespace throng::test {

struct Overlaps {
    std::size_t pairs = 0;         ///< deeper than 1 % of the sum of radii
    float deepest_percent = 0.0f;  ///< of the sum of radii
};

inline bool isPresent(const gpu::AgentState& state) {
    return state.status == gpu::STATUS_WALKING || state.status == gpu::STATUS_ARRIVED;
}

/// All pairs that overlap, found through a hash of 1 m cells.
inline Overlaps overlapsOf(const std::vector<gpu::AgentState>& states,
                           const std::vector<gpu::Person>& people) {
    std::unordered_map<std::int64_t, std::vector<std::uint32_t>> cells;
    const auto key = [](int x, int y) {
        return (static_cast<std::int64_t>(x) << 32) ^ static_cast<std::uint32_t>(y);
    };
    for (std::uint32_t row = 0; row < states.size(); ++row)
        if (isPresent(states[row]))
            cells[key(static_cast<int>(std::floor(states[row].position.x)),
                      static_cast<int>(std::floor(states[row].position.y)))]
                .push_back(row);
    Overlaps result;
    for (std::uint32_t row = 0; row < states.size(); ++row) {
        if (!isPresent(states[row])) continue;
        const int x = static_cast<int>(std::floor(states[row].position.x));
        const int y = static_cast<int>(std::floor(states[row].position.y));
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx) {
                const auto cell = cells.find(key(x + dx, y + dy));
                if (cell == cells.end()) continue;
                for (const std::uint32_t other : cell->second) {
                    if (other <= row) continue;
                    const float reach = people[row].radius + people[other].radius;
                    const float depth =
                        100.0f * (1.0f - glm::distance(states[row].position, states[other].position) / reach);
                    if (depth > 1.0f) ++result.pairs;
                    result.deepest_percent = std::max(result.deepest_percent, depth);
                }
            }
    }
    return result;
}

struct Observation {
    std::size_t arrived = 0;
    float deepest_percent = 0.0f;
    double mean_pairs = 0.0;
    float deepest_wall_percent = 0.0f;  ///< of the radius
    std::size_t wall_crossings = 0;
    float seconds = 0.0f;  ///< until all had arrived, or all that was given
};

inline float crossProduct(glm::vec2 a, glm::vec2 b) {
    return a.x * b.y - a.y * b.x;
}

inline bool crosses(glm::vec2 p, glm::vec2 q, const gpu::WallSegment& wall) {
    const glm::vec2 axis = wall.b - wall.a;
    const glm::vec2 path = q - p;
    const float turn = crossProduct(path, axis);
    if (std::abs(turn) < 1.0e-12f) return false;
    const float on_path = crossProduct(wall.a - p, axis) / turn;
    const float on_wall = crossProduct(wall.a - p, path) / turn;
    return on_path >= 0.0f && on_path <= 1.0f && on_wall >= 0.0f && on_wall <= 1.0f;
}

inline float wallDistance(glm::vec2 point, const gpu::WallSegment& wall) {
    const glm::vec2 axis = wall.b - wall.a;
    const float squared = glm::dot(axis, axis);
    const float along =
        squared > 0.0f ? std::clamp(glm::dot(point - wall.a, axis) / squared, 0.0f, 1.0f) : 0.0f;
    return glm::distance(point, wall.a + along * axis) - wall.half_thickness;
}

/// Runs until everybody has arrived or `seconds` have passed, looking after every `stride` steps.
inline Observation observe(sim::Simulation& simulation, const authoring::Scene& scene, float seconds,
                           int stride = 2) {
    Observation result;
    const float dt = simulation.parameters().step_seconds;
    const auto steps = static_cast<int>(seconds / dt);
    std::vector<gpu::AgentState> before;
    int looks = 0;
    for (int step = 0; step < steps; ++step) {
        simulation.step();
        if (step % stride) continue;
        const auto states = simulation.parts().buffers.states.download<gpu::AgentState>(scene.people.size());
        const Overlaps overlaps = overlapsOf(states, scene.people);
        result.deepest_percent = std::max(result.deepest_percent, overlaps.deepest_percent);
        result.mean_pairs += static_cast<double>(overlaps.pairs);
        ++looks;
        result.arrived = 0;
        for (std::size_t row = 0; row < states.size(); ++row) {
            result.arrived += states[row].status >= gpu::STATUS_ARRIVED;
            for (const gpu::WallSegment& wall : scene.wall_segments) {
                const float depth =
                    1.0f - wallDistance(states[row].position, wall) / scene.people[row].radius;
                if (isPresent(states[row]))
                    result.deepest_wall_percent = std::max(result.deepest_wall_percent, 100.0f * depth);
                if (!before.empty() && isPresent(before[row]))
                    result.wall_crossings += crosses(before[row].position, states[row].position, wall);
            }
        }
        before = states;
        result.seconds = static_cast<float>(step + 1) * dt;
        if (result.arrived == scene.people.size()) break;
    }
    result.mean_pairs /= std::max(looks, 1);
    return result;
}

/// m: how far on its left the first of two, who walks along x, is when it has come to the second; 0 where it
/// never does.
inline float leftWhenTheyMeet(const authoring::Scene& scene, const gl::ShaderLibrary& library) {
    sim::Simulation simulation(scene, library);
    for (int step = 0; step < 360; ++step) {
        simulation.step();
        const auto states = simulation.parts().buffers.states.download<gpu::AgentState>(2);
        if (states[0].position.x >= states[1].position.x) return states[0].position.y - states[1].position.y;
    }
    return 0.0f;
}

}  // namespace throng::test
