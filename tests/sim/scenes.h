// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "authoring/scene.h"
#include "base/motion_settings.h"
#include "sim/benchmarks/open_crowd.h"

/// Small scenes made by hand, so that the simulation is tested without reading layouts.
namespace throng::test {

using sim::addPerson;
using sim::emptyScene;

inline authoring::Scene uniformScene(std::uint32_t count, float spacing, std::uint32_t seed) {
    return sim::openCrowd(count, spacing, seed);
}

/// As a layout's `motion` does.
inline void setRule(authoring::Scene& scene, std::string_view rule, std::string_view name, double value) {
    const auto rows = motionParameters();
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const MotionParameter& parameter) {
        return parameter.rule == rule && parameter.name == name;
    });
    scene.settings.motion.set(static_cast<std::size_t>(row - rows.begin()), value);
}

/// A straight wall with tiles every 0.2 m.
inline void addWall(authoring::Scene& scene, glm::vec2 a, glm::vec2 b, float half_thickness = 0.0f) {
    const auto segment = static_cast<std::uint32_t>(scene.wall_segments.size());
    scene.wall_segments.push_back({a, b, half_thickness, segment});
    const float length = glm::distance(a, b);
    const int tiles = std::max(1, static_cast<int>(std::ceil(length / 0.2f)));
    for (int i = 0; i < tiles; ++i) {
        const float along = (static_cast<float>(i) + 0.5f) / static_cast<float>(tiles);
        scene.wall_tiles.push_back(
            {glm::mix(a, b, along), static_cast<float>(scene.settings.tile_radius), segment});
    }
}

}  // namespace throng::test
