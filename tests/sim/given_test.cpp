// SPDX-License-Identifier: Apache-2.0
#include <random>

#include "sim/simulation_parts.h"
#include "tests/sim/gpu_test.h"
#include "tests/sim/scenes.h"

namespace throng::test {
namespace {

struct Way {
    std::vector<gpu::GivenPlace> places;

    float begin() const { return places.front().time; }
    float end() const { return places.back().time; }
    glm::vec2 at(float time) const {
        if (time <= begin()) return places.front().position;
        for (std::size_t i = 1; i < places.size(); ++i)
            if (time < places[i].time)
                return glm::mix(places[i - 1].position, places[i].position,
                                (time - places[i - 1].time) / (places[i].time - places[i - 1].time));
        return places.back().position;
    }
};

/// Of 2 to 9 places each, at random times and everywhere, also over each other.
std::vector<Way> randomWays(std::uint32_t count) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> at(-8.0f, 8.0f), gap(0.02f, 0.3f);
    std::vector<Way> ways(count);
    for (Way& way : ways) {
        float time = 2.0f * gap(random) - 0.2f;
        for (std::uint32_t i = 0; i < 2 + random() % 8; ++i, time += gap(random))
            way.places.push_back({{at(random), at(random)}, time, 0});
    }
    return ways;
}

/// Somebody who walks, and then those whose ways are given.
authoring::Scene sceneOf(const std::vector<Way>& ways) {
    authoring::Scene scene = uniformScene(1, 1.0f, 3);
    scene.given.first_row = 1;
    for (const Way& way : ways) {
        gpu::Person person = scene.people.front();
        person.flags = gpu::PERSON_FIXED_SPAWN | gpu::PERSON_IS_GIVEN;
        person.spawn_time = way.begin();
        person.spawn_position = way.at(0.0f);
        if (way.begin() <= 0.0f && way.end() > 0.0f) person.flags |= gpu::PERSON_PRESENT_AT_START;
        scene.people.push_back(person);
        scene.goals.push_back(way.places.back().position);
        scene.given.ways.push_back({static_cast<gpu::uint>(scene.given.places.size()),
                                    static_cast<gpu::uint>(way.places.size()), glm::vec2(0.0f)});
        scene.given.places.insert(scene.given.places.end(), way.places.begin(), way.places.end());
    }
    return scene;
}

class GivenTest : public GpuTest, public ::testing::WithParamInterface<std::uint32_t> {};

TEST_P(GivenTest, AreWhereTheirWaysSayInEveryStep) {
    const std::vector<Way> ways = randomWays(GetParam());
    const authoring::Scene scene = sceneOf(ways);
    sim::Simulation simulation(scene, library);
    const auto step = static_cast<float>(1.0 / (scene.settings.fps * scene.settings.substeps));
    for (std::uint32_t steps = 1; steps <= 40; ++steps) {
        simulation.step();
        const float now = simulation.parts().now();
        const auto states = simulation.parts().buffers.states.download<gpu::AgentState>(scene.people.size());
        for (std::size_t i = 0; i < ways.size(); ++i) {
            const gpu::AgentState& state = states[i + 1];
            const bool is_there = now >= ways[i].begin() && now <= ways[i].end();
            ASSERT_EQ(state.status == gpu::STATUS_WALKING, is_there) << "way " << i << ", " << now << " s";
            ASSERT_EQ(state.arrival_step != gpu::NO_INDEX, state.status == gpu::STATUS_GONE);
            if (!is_there) continue;
            EXPECT_LT(glm::distance(state.position, ways[i].at(now)), 1.0e-4f);
            const glm::vec2 velocity = (ways[i].at(now) - ways[i].at(now - step)) / step;
            EXPECT_LT(glm::distance(state.velocity, velocity), 0.02f + 1.0e-3f * glm::length(velocity));
        }
    }
}

TEST_P(GivenTest, WishForWhatTheyWillDoAndAreHeldThere) {
    const std::vector<Way> ways = randomWays(GetParam());
    const authoring::Scene scene = sceneOf(ways);
    sim::Simulation simulation(scene, library);
    sim::Simulation::Parts& parts = simulation.parts();
    const auto decision = static_cast<std::uint32_t>(scene.settings.stepsPerDecision());
    std::size_t seen = 0;
    for (std::uint32_t steps = 0; steps < 24; ++steps) {
        const float now = parts.now(), until = parts.timeAfter(steps + decision);
        const float end = parts.timeAfter(steps + 1);
        const auto before = parts.buffers.states.download<gpu::AgentState>(scene.people.size());
        simulation.step();
        if (steps % decision != 0) continue;
        const auto bodies = parts.buffers.bodies.download<gpu::Body>(scene.people.size());
        const auto wishes = parts.buffers.preferred_velocities.download<glm::vec2>(scene.people.size());
        const auto places = parts.contacts.result().download<glm::vec2>(scene.people.size());
        const auto there = static_cast<std::size_t>(std::ranges::count_if(before, [](const auto& state) {
            return state.status == gpu::STATUS_WALKING || state.status == gpu::STATUS_ARRIVED;
        }));
        for (std::size_t slot = 0; slot < there; ++slot) {
            if (bodies[slot].row == 0) continue;
            const Way& way = ways[bodies[slot].row - 1];
            const glm::vec2 wish = (way.at(until) - way.at(now)) / (until - now);
            ASSERT_LT(glm::distance(wishes[slot], wish), 0.02f + 1.0e-3f * glm::length(wish));
            ASSERT_LT(glm::distance(places[slot], way.at(end)), 1.0e-4f);
            ++seen;
        }
    }
    EXPECT_GT(seen, 5 * ways.size() / 2);
}

INSTANTIATE_TEST_SUITE_P(Sizes, GivenTest, ::testing::Values(1u, 63u, 1234u));

}  // namespace
}  // namespace throng::test
