// SPDX-License-Identifier: Apache-2.0
#include "sim/benchmarks/open_crowd.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace throng::sim {

authoring::Scene emptyScene(glm::vec2 minimum, glm::vec2 maximum) {
    authoring::Scene scene;
    scene.minimum = minimum;
    scene.maximum = maximum;
    scene.groups.push_back({"people", false});
    scene.smallest_radius = 0.25f;
    scene.largest_radius = 0.25f;
    return scene;
}

gpu::Person& addPerson(authoring::Scene& scene, glm::vec2 position, glm::vec2 goal, float speed,
                       float radius) {
    gpu::Person person{};
    person.spawn_position = position;
    person.radius = person.own_radius = radius;
    person.preferred_speed = speed;
    person.maximum_speed = 1.5f * speed;
    person.heading = std::atan2(goal.y - position.y, goal.x - position.x);
    person.entry = gpu::NO_INDEX;
    person.flags = gpu::PERSON_PRESENT_AT_START | gpu::PERSON_FIXED_SPAWN;
    person.first_stage = static_cast<std::uint32_t>(scene.stages.size());
    person.stage_count = 1;
    scene.stages.push_back({goal, goal, 0.3f, gpu::NO_INDEX, gpu::DWELL_FOR_GOOD, gpu::NO_INDEX,
                            gpu::ACTIVITY_STAND, 0, 0.0f, 0});
    scene.goals.push_back(goal);
    person.party_first = static_cast<std::uint32_t>(scene.people.size());
    person.party_size = 1;
    scene.people.push_back(person);
    const auto rows = static_cast<std::uint32_t>(scene.people.size());
    scene.queues = {{0, rows}};
    scene.smallest_radius = rows == 1 ? radius : std::min(scene.smallest_radius, radius);
    scene.largest_radius = rows == 1 ? radius : std::max(scene.largest_radius, radius);
    return scene.people.back();
}

authoring::Scene openCrowd(std::uint32_t count, float spacing, std::uint32_t seed) {
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
        const std::uint32_t line = places[i] / side;
        const glm::vec2 cell(static_cast<float>(places[i] % side), static_cast<float>(line));
        const float aside = jitter(random);  // in this order, whatever a compiler makes of arguments
        const glm::vec2 position = (cell + 0.5f) * spacing + glm::vec2(jitter(random), aside);
        addPerson(scene, position, {anywhere(random), anywhere(random)});
    }
    return scene;
}

}  // namespace throng::sim
