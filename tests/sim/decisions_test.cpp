// SPDX-License-Identifier: Apache-2.0
// People look round and decide once in several steps; bodies move and touch in each.
#include <cstring>

#include "sim/simulation_parts.h"
#include "tests/sim/gpu_test.h"
#include "tests/sim/scenes.h"

namespace throng::test {
namespace {

TEST(StepsPerDecision, AreAsManyOfAFramesStepsAsFitTheInterval) {
    const auto steps = [](double fps, int substeps, double interval = 0.05) {
        authoring::SimulationSettings settings;
        settings.fps = fps;
        settings.substeps = substeps;
        settings.decision_interval = interval;
        return settings.stepsPerDecision();
    };
    EXPECT_EQ(steps(24, 2), 2);
    EXPECT_EQ(steps(24, 1), 1);
    EXPECT_EQ(steps(24, 4), 4);
    EXPECT_EQ(steps(10, 4), 2) << "a decision every 0.05 s, two a frame";
    EXPECT_EQ(steps(10, 5), 1) << "neither two nor three are a share of five";
    EXPECT_EQ(steps(20, 3), 3) << "as long as the interval";
    EXPECT_EQ(steps(24, 2, 0.0), 1);
    EXPECT_EQ(steps(1, 64, 0.25), 16);
}

class DecisionsTest : public GpuTest {
  protected:
    using States = std::vector<gpu::AgentState>;

    static authoring::Scene twoWhoMeet() {
        authoring::Scene scene = emptyScene({-10, -10}, {10, 10});
        addPerson(scene, {-4, 0.1f}, {8, 0});
        addPerson(scene, {4, 0}, {-8, 0.1f});
        return scene;
    }
    static std::vector<gpu::Decision> decisions(sim::Simulation& simulation) {
        return simulation.parts().buffers.decisions.download<gpu::Decision>(2);
    }
    static States states(sim::Simulation& simulation) {
        return simulation.parts().buffers.states.download<gpu::AgentState>(2);
    }
    static bool same(const std::vector<gpu::Decision>& one, const std::vector<gpu::Decision>& other) {
        return std::memcmp(one.data(), other.data(), sizeof(gpu::Decision) * one.size()) == 0;
    }
};

TEST_F(DecisionsTest, AreMadeInTheFirstStepOfAFrameAndKeptUntilTheNext) {
    sim::Simulation simulation(twoWhoMeet(), library);
    for (int frame = 0; frame < 20; ++frame) {
        simulation.step();
        const auto first = decisions(simulation);
        const States between = states(simulation);
        simulation.step();
        EXPECT_TRUE(same(decisions(simulation), first)) << frame;
        for (std::size_t row = 0; row < 2; ++row)
            EXPECT_GT(glm::distance(states(simulation)[row].position, between[row].position), 1.0e-4f);
    }
    const auto before = decisions(simulation);
    simulation.step();
    EXPECT_FALSE(same(decisions(simulation), before));
}

TEST_F(DecisionsTest, LegsReachInAFrameWhatWasDecided) {
    authoring::Scene once = twoWhoMeet(), always = twoWhoMeet();
    always.settings.decision_interval = 0.0;
    sim::Simulation seldom(once, library), often(always, library);
    for (int step = 0; step < 48 * 5; ++step) {
        seldom.step();
        often.step();
    }
    for (std::size_t row = 0; row < 2; ++row)
        EXPECT_LT(glm::distance(states(seldom)[row].position, states(often)[row].position), 0.05f)
            << "m, after 5 s";
}

TEST_F(DecisionsTest, BodiesThatMeetBetweenThemArePartedAtOnce) {
    authoring::Scene scene = emptyScene({-10, -10}, {10, 10});
    addPerson(scene, {0, 0}, {8, 0});
    addPerson(scene, {0.7f, 0}, {8.7f, 0});
    sim::Simulation simulation(scene, library);
    simulation.step();
    States near = states(simulation);
    const float touch = scene.people[0].radius + scene.people[1].radius;
    near[1].position = near[0].position + glm::vec2(touch - 0.03f, 0.0f);
    simulation.parts().buffers.states.upload(near);
    simulation.step();
    const States after = states(simulation);
    EXPECT_GT(glm::distance(after[0].position, after[1].position), touch - 0.003f);
}

TEST_F(DecisionsTest, WhoLeavesBetweenThemIsLeftAlone) {
    int odd = 0;
    for (int place = 0; place < 4; ++place) {
        authoring::Scene scene = emptyScene({-10, -10}, {10, 10});
        addPerson(scene, {-2.0f - 0.013f * static_cast<float>(place), 0}, {0, 0});
        addPerson(scene, {-2.0f, 3}, {9, 3});
        for (gpu::Stage& stage : scene.stages)
            stage.dwell = 0.0f;
        sim::Simulation simulation(scene, library);
        States before = states(simulation);
        for (int step = 1; step < 48 * 6; ++step) {
            simulation.step();
            const States now = states(simulation);
            if (before[0].status == gpu::STATUS_GONE)
                ASSERT_EQ(std::memcmp(&now[0], &before[0], sizeof now[0]), 0) << step;
            else if (now[0].status == gpu::STATUS_GONE)
                odd += step % 2;
            before = now;
        }
        EXPECT_EQ(before[0].status, gpu::STATUS_GONE);
        EXPECT_EQ(before[1].status, gpu::STATUS_WALKING);
    }
    EXPECT_GT(odd, 0) << "somebody left in the first step of a frame";
}

}  // namespace
}  // namespace throng::test
