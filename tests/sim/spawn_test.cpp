// SPDX-License-Identifier: Apache-2.0
#include "sim/simulation.h"
#include "tests/sim/gpu_test.h"
#include "tests/sim/observe.h"
#include "tests/sim/scenes.h"

namespace throng::test {
namespace {

/// `count` people who want to enter at `points` at the same moment and walk off to the right.
authoring::Scene entryScene(std::uint32_t count, const std::vector<glm::vec2>& points, float time) {
    authoring::Scene scene = emptyScene({-4, -10}, {40, 10});
    for (std::uint32_t i = 0; i < count; ++i) {
        gpu::Person& person =
            addPerson(scene, {0, 0},
                      {30, -8.0f + 16.0f * static_cast<float>(i * 37 % count) / static_cast<float>(count)});
        person.flags = 0;
        scene.stages.back().dwell = 0.0f;  // leaves at its goal
        person.entry = 0;
        person.spawn_time = time;
    }
    scene.entries = {{0, static_cast<gpu::uint>(points.size())}};
    scene.entry_points = points;
    return scene;
}

class SpawnTest : public GpuTest {};

TEST_F(SpawnTest, WaitsForRoomAndNeverPutsPeopleOnTopOfEachOther) {
    for (const std::uint32_t count : {1u, 63u, 200u}) {
        std::vector<glm::vec2> points;
        for (int i = 0; i < 40; ++i)
            points.push_back({0.1f * static_cast<float>(i % 5), -1.0f + 0.25f * static_cast<float>(i / 5)});
        const authoring::Scene scene = entryScene(count, points, 0.0f);
        sim::Simulation simulation(scene, library);
        const Observation seen = observe(simulation, scene, 4.0f, 1);
        EXPECT_LT(seen.deepest_percent, 2.0f) << count;
        const Account account = simulation.account();
        EXPECT_EQ(account.agents.size(), count);
        EXPECT_EQ(account.walking + account.arrived + account.refused, count);
        EXPECT_GT(account.spawned, 0u);
        if (count == 200) {
            EXPECT_GT(account.refused, 0u) << "there cannot have been room for 200 in four seconds";
            for (const AgentOutcome& agent : account.agents) {
                if (agent.status == AgentStatus::refused) {
                    EXPECT_NE(agent.reason.find("no free room"), std::string::npos);
                }
            }
        }
    }
}

TEST_F(SpawnTest, NobodyEntersBeforeItsTime) {
    const authoring::Scene scene = entryScene(3, {{0, 0}, {0, 2}, {0, 4}}, 1.0f);
    sim::Simulation simulation(scene, library);
    for (int step = 0; step < 47; ++step)
        simulation.step();
    EXPECT_EQ(simulation.account().spawned, 0u);
    for (int step = 0; step < 24; ++step)
        simulation.step();
    const Account account = simulation.account();
    EXPECT_EQ(account.spawned, 3u);
    for (const AgentOutcome& agent : account.agents)
        EXPECT_GE(agent.spawn_frame, 24u);
}

TEST_F(SpawnTest, ThoseWhoseTimeNeverComesAreRefusedForThatReason) {
    const authoring::Scene scene = entryScene(2, {{0, 0}}, 100.0f);
    sim::Simulation simulation(scene, library);
    for (int step = 0; step < 10; ++step)
        simulation.step();
    const Account account = simulation.account();
    EXPECT_EQ(account.refused, 2u);
    EXPECT_NE(account.agents[0].reason.find("before its time"), std::string::npos)
        << account.agents[0].reason;
    EXPECT_EQ(account.agents[0].spawn_frame, kNone);
}

TEST_F(SpawnTest, AllOfALongQueueEnterInTheEnd) {
    std::vector<glm::vec2> points;
    for (int i = 0; i < 64; ++i)
        points.push_back({0.0f, -8.0f + 0.25f * static_cast<float>(i)});
    const authoring::Scene scene = entryScene(300, points, 0.0f);
    sim::Simulation simulation(scene, library);
    for (int step = 0; step < 48 * 60; ++step)
        simulation.step();
    const Account account = simulation.account();
    EXPECT_EQ(account.refused, 0u);
    EXPECT_EQ(account.spawned, 300u);
    EXPECT_GT(account.arrived, 200u);
}

}  // namespace
}  // namespace throng::test
