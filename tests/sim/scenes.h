// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "authoring/scene.h"

/// Small scenes made by hand, so that the simulation is tested without reading layouts.
namespace throng::test {

/// A scene without people or walls over [minimum, maximum] metres.
inline authoring::Scene emptyScene(glm::vec2 minimum, glm::vec2 maximum) {
    authoring::Scene scene;
    scene.minimum = minimum;
    scene.maximum = maximum;
    scene.groups.push_back({"people", false});
    scene.smallest_radius = 0.25f;
    scene.largest_radius = 0.25f;
    return scene;
}

/// Somebody who is there from the start and walks straight to `goal`.
inline gpu::Person& addPerson(authoring::Scene& scene, glm::vec2 position, glm::vec2 goal, float speed = 1.3f,
                              float radius = 0.25f) {
    gpu::Person person{};
    person.spawn_position = position;
    person.radius = radius;
    person.preferred_speed = speed;
    person.maximum_speed = 1.5f * speed;
    person.heading = std::atan2(goal.y - position.y, goal.x - position.x);
    person.stride_length = 1.4f;
    person.entry = gpu::NO_INDEX;
    person.flags = gpu::PERSON_PRESENT_AT_START | gpu::PERSON_FIXED_SPAWN | gpu::PERSON_STAYS;
    person.first_stage = static_cast<std::uint32_t>(scene.stages.size());
    person.stage_count = 1;
    scene.stages.push_back({goal, 0.3f, gpu::NO_INDEX});
    scene.goals.push_back(goal);
    scene.people.push_back(person);
    const auto rows = static_cast<std::uint32_t>(scene.people.size());
    scene.queues = {{0, rows}};
    scene.smallest_radius = rows == 1 ? radius : std::min(scene.smallest_radius, radius);
    scene.largest_radius = rows == 1 ? radius : std::max(scene.largest_radius, radius);
    return scene.people.back();
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

/// `count` people, one per (spacing)^2 square metres, in random order, walking to random places.
inline authoring::Scene uniformScene(std::uint32_t count, float spacing, std::uint32_t seed) {
    const auto side = static_cast<std::uint32_t>(std::ceil(std::sqrt(static_cast<double>(count))));
    const float extent = static_cast<float>(side) * spacing;
    authoring::Scene scene = emptyScene({-2.0f, -2.0f}, {extent + 2.0f, extent + 2.0f});
    std::mt19937 random(seed);
    std::vector<std::uint32_t> places(side * side);
    for (std::uint32_t i = 0; i < places.size(); ++i)
        places[i] = i;
    std::shuffle(places.begin(), places.end(), random);
    std::uniform_real_distribution<float> jitter(-0.2f * spacing, 0.2f * spacing);
    std::uniform_real_distribution<float> anywhere(0.0f, extent);
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::vec2 cell(static_cast<float>(places[i] % side), static_cast<float>(places[i] / side));
        const glm::vec2 position = (cell + 0.5f) * spacing + glm::vec2(jitter(random), jitter(random));
        addPerson(scene, position, {anywhere(random), anywhere(random)});
    }
    return scene;
}

}  // namespace throng::test
