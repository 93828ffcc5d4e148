// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "authoring/scene.h"
#include "sim/benchmarks/open_crowd.h"

/// Small scenes made by hand, so that the simulation is tested without reading layouts.
namespace throng::test {

using sim::addPerson;
using sim::emptyScene;

inline authoring::Scene uniformScene(std::uint32_t count, float spacing, std::uint32_t seed) {
    return sim::openCrowd(count, spacing, seed);
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
