// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "base/capsule.h"
#include "sim/simulation_parts.h"
#include "tests/sim/gpu_test.h"
#include "tests/sim/observe.h"
#include "tests/sim/scenes.h"

namespace throng::test {
namespace {

constexpr float kBreadth = 0.47f, kDepth = 0.25f;  // m

/// People with bodies that are no discs.
class BodiesTest : public GpuTest {
  protected:
    static gpu::Person& addBody(authoring::Scene& scene, glm::vec2 place, glm::vec2 goal, float heading) {
        gpu::Person& person = addPerson(scene, place, goal, 1.2f, 0.5f * kBreadth);
        person.half_axis = 0.5f * (kBreadth - kDepth);
        person.heading = heading;
        return person;
    }
    static Capsule bodyOf(sim::Simulation& simulation, const authoring::Scene& scene, std::size_t row) {
        sim::Buffers& buffers = simulation.parts().buffers;
        const auto state = buffers.states.download<gpu::AgentState>(scene.people.size())[row];
        const auto chest = buffers.chests.download<gpu::Chest>(scene.people.size())[row];
        return capsuleOf(state.position, {std::cos(chest.angle), std::sin(chest.angle)},
                         scene.people[row].radius, scene.people[row].half_axis);
    }
    /// Who wants to stay where it is, overlapping another: how much is free between them after some steps, m.
    double freeAfterwards(glm::vec2 offset, float heading, float its_heading) {
        authoring::Scene scene = emptyScene({-10, -10}, {10, 10});
        addBody(scene, {0, 0}, {0, 0}, heading);
        addBody(scene, offset, offset, its_heading);
        sim::Simulation simulation(scene, library);
        for (int step = 0; step < 24; ++step)
            simulation.step();
        return freeBetween(bodyOf(simulation, scene, 0), bodyOf(simulation, scene, 1));
    }
    /// Whether somebody comes through a door so wide, m.
    bool comesThrough(float door) {
        authoring::Scene scene = emptyScene({-10, -10}, {10, 10});
        addBody(scene, {-3, 0}, {3, 0}, 0.0f);
        addWall(scene, {0, 0.5f * door + 0.1f}, {0, 8}, 0.1f);
        addWall(scene, {0, -0.5f * door - 0.1f}, {0, -8}, 0.1f);
        sim::Simulation simulation(scene, library);
        for (int step = 0; step < 12 * 48; ++step)
            simulation.step();
        return bodyOf(simulation, scene, 0).middle.x > 1.0;
    }
    /// Two in a passage too narrow to pass each other, the second so far behind, m.
    static authoring::Scene oneBehindAnother(float distance) {
        authoring::Scene scene = emptyScene({-2, -2}, {22, 2});
        addBody(scene, {distance, 0}, {21, 0}, 0.0f);
        addBody(scene, {0, 0}, {21, 0}, 0.0f);
        for (const float side : {0.45f, -0.45f})
            addWall(scene, {-1, side}, {22, side}, 0.1f);
        return scene;
    }
    /// m: how far somebody at 1.2 m/s walks behind another at half a metre per second, whom it cannot pass.
    double follows(double walk_ratio) {
        authoring::Scene scene = oneBehindAnother(1.5f);
        scene.people[0].preferred_speed = 0.5f;
        setRule(scene, "room_to_stride", "walk_ratio", walk_ratio);
        setRule(scene, "room_to_stride", "drawing_away", 0.0);
        sim::Simulation simulation(scene, library);
        for (int step = 0; step < 20 * 48; ++step)
            simulation.step();
        const auto states = simulation.parts().buffers.states.download<gpu::AgentState>(2);
        return states[0].position.x - states[1].position.x;
    }
    double leftWhenTheyMeet(double to_the_right, std::uint64_t seed) {
        authoring::Scene scene = emptyScene({-10, -5}, {10, 5});
        scene.settings.seed = seed;
        setRule(scene, "passing_side", "to_the_right", to_the_right);
        addBody(scene, {-8, 0}, {8, 0}, 0.0f);
        addBody(scene, {8, 0}, {-8, 0}, std::numbers::pi_v<float>);
        return test::leftWhenTheyMeet(scene, library);
    }
    /// m: how far somebody comes in 1.5 s who stood right behind one who walks off.
    double wayBehindOneWhoWalksOff(double drawing_away) {
        authoring::Scene scene = oneBehindAnother(0.35f);
        setRule(scene, "room_to_stride", "drawing_away", drawing_away);
        sim::Simulation simulation(scene, library);
        for (int step = 0; step < 72; ++step)
            simulation.step();
        return simulation.parts().buffers.states.download<gpu::AgentState>(2)[1].position.x;
    }
};

TEST_F(BodiesTest, NobodyStaysInAnybodyHoweverTheyAreTurned) {
    const float quarter = 0.5f * std::numbers::pi_v<float>;
    EXPECT_GT(freeAfterwards({0.0f, 0.4f}, 0.0f, 0.0f), -0.005) << "end to end";
    EXPECT_GT(freeAfterwards({0.2f, 0.0f}, 0.0f, 0.0f), -0.005) << "chest to back";
    EXPECT_GT(freeAfterwards({0.2f, 0.1f}, 0.0f, quarter), -0.005) << "across";
    EXPECT_GT(freeAfterwards({0.05f, 0.02f}, 0.0f, quarter), -0.005) << "crossed";
}

TEST_F(BodiesTest, WhoIsChestToBackNeedsNoMoreRoomThanChestsAreDeep) {
    EXPECT_LT(freeAfterwards({kDepth + 0.01f, 0.0f}, 0.0f, 0.0f), 0.05);
}

TEST_F(BodiesTest, DoorsNarrowerThanShouldersArePassedSideways) {
    EXPECT_TRUE(comesThrough(0.36f));
}

TEST_F(BodiesTest, NobodyComesThroughADoorNarrowerThanItsChest) {
    EXPECT_FALSE(comesThrough(0.22f));
}

TEST_F(BodiesTest, WithoutTurningShouldersDoNotFitThroughNarrowDoors) {
    authoring::Scene scene = emptyScene({-10, -10}, {10, 10});
    addBody(scene, {-3, 0}, {3, 0}, 0.0f);
    addWall(scene, {0, 0.28f}, {0, 8}, 0.1f);
    addWall(scene, {0, -0.28f}, {0, -8}, 0.1f);
    setRule(scene, "shoulders", "enabled", 0.0);
    sim::Simulation simulation(scene, library);
    for (int step = 0; step < 6 * 48; ++step)
        simulation.step();
    EXPECT_LT(bodyOf(simulation, scene, 0).middle.x, 0.1);
}

TEST_F(BodiesTest, WhoFollowsLeavesRoomToStrideBehindAChest) {
    // A chest that is not straight behind the other's touches it some 2 cm later.
    EXPECT_NEAR(follows(0.39), kDepth + std::sqrt(0.39 * 0.5), 0.04);
    EXPECT_NEAR(follows(0.8), kDepth + std::sqrt(0.8 * 0.5), 0.04);
}

TEST_F(BodiesTest, WhoDrawsAwayIsFollowedSooner) {
    EXPECT_GT(wayBehindOneWhoWalksOff(5.0), wayBehindOneWhoWalksOff(0.0) + 0.2);
}

TEST_F(BodiesTest, MostWhoMeetHeadOnPassOnTheirSide) {
    // As most people do, not all (Moussaid and others 2009).
    int on_the_right = 0, on_the_left = 0;
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        on_the_right += leftWhenTheyMeet(0.25, seed) < -0.3;
        on_the_left += leftWhenTheyMeet(-0.25, seed) > 0.3;
    }
    EXPECT_GE(on_the_right, 6);
    EXPECT_GE(on_the_left, 6);
}

}  // namespace
}  // namespace throng::test
