// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstring>
#include <numbers>

#include "sim/simulation.h"
#include "tests/sim/gpu_test.h"
#include "tests/sim/observe.h"
#include "tests/sim/scenes.h"

namespace throng::test {
namespace {

class MotionTest : public GpuTest {
  protected:
    Observation run(const authoring::Scene& scene, float seconds, int stride = 1) {
        sim::Simulation simulation(scene, library);
        return observe(simulation, scene, seconds, stride);
    }
    std::vector<gpu::AgentState> statesAfter(const authoring::Scene& scene, int steps) {
        sim::Simulation simulation(scene, library);
        for (int step = 0; step < steps; ++step)
            simulation.step();
        return simulation.parts().buffers.states.download<gpu::AgentState>(scene.people.size());
    }
};

TEST_F(MotionTest, OnePersonWalksStraightToItsGoalAtItsSpeed) {
    authoring::Scene scene = emptyScene({-5, -5}, {25, 5});
    addPerson(scene, {0, 0}, {20, 0}, 1.33f);
    const Observation seen = run(scene, 30.0f);
    EXPECT_EQ(seen.arrived, 1u);
    EXPECT_NEAR(seen.seconds, 20.0f / 1.33f, 1.0f);
}

TEST_F(MotionTest, PeopleWalkAtTheirSpeedHoweverWideTheSite) {
    for (const float kilometres : {0.1f, 0.5f, 1.0f, 4.0f, 16.0f, 20.0f}) {
        const float edge = 500.0f * kilometres;
        authoring::Scene scene = emptyScene({-edge, -5.0f}, {edge, 5.0f});
        addPerson(scene, {4.3f - edge, 0.1f}, {edge, -0.3f}, 1.3f);
        addPerson(scene, {edge - 4.7f, 3.1f}, {-edge, 2.7f}, 1.3f);
        sim::Simulation simulation(scene, library);
        const auto after = [&](float seconds) {
            const auto steps = static_cast<int>(std::lround(seconds / simulation.parameters().step_seconds));
            for (int step = 0; step < steps; ++step)
                simulation.step();
            return simulation.parts().buffers.states.download<gpu::AgentState>(2);
        };
        const auto early = after(5.0f);
        const auto late = after(20.0f);
        const float bar = kilometres < 1.0f ? 0.007f : 0.001f;  // below 520 m, nothing is kept
        for (std::size_t row = 0; row < 2; ++row) {
            const float way = glm::distance(early[row].position, late[row].position);
            EXPECT_NEAR(way / 26.0f, 1.0f, bar) << kilometres << " km";
            EXPECT_NEAR((late[row].walked - early[row].walked) / 26.0f, 1.0f, bar) << kilometres << " km";
            EXPECT_NEAR(glm::length(late[row].velocity) / 1.3f, 1.0f, bar) << kilometres << " km";
        }
    }
}

TEST_F(MotionTest, PeoplePassAndWallsHoldFarFromTheOriginToo) {
    authoring::Scene scene = emptyScene({-10000.0f, -6.0f}, {10000.0f, 6.0f});
    for (int i = 0; i < 12; ++i) {
        const float side = i % 2 ? 1.0f : -1.0f;
        addPerson(scene,
                  {9950.0f + side * (8.0f + static_cast<float>(i)), 0.4f * static_cast<float>(i % 5) - 0.8f},
                  {9950.0f - 25.0f * side, 0.0f});
    }
    addWall(scene, {9900.0f, 2.0f}, {9999.0f, 2.0f}, 0.1f);
    addWall(scene, {9900.0f, -2.0f}, {9999.0f, -2.0f}, 0.1f);
    const Observation seen = run(scene, 60.0f);
    EXPECT_EQ(seen.arrived, 12u);
    EXPECT_EQ(seen.wall_crossings, 0u);
    EXPECT_LT(seen.deepest_percent, 6.0f);
    EXPECT_LT(seen.deepest_wall_percent, 2.0f);
}

TEST_F(MotionTest, HeadingFollowsTheVelocitySmoothly) {
    authoring::Scene scene = emptyScene({-10, -10}, {10, 10});
    addPerson(scene, {0, 0}, {8, 0}).heading = std::numbers::pi_v<float>;  // looks away from where it goes
    sim::Simulation simulation(scene, library);
    float before = std::numbers::pi_v<float>;
    float fastest = 0.0f;
    for (int step = 0; step < 240; ++step) {
        simulation.step();
        const float heading = simulation.parts().buffers.states.download<gpu::AgentState>(1)[0].heading;
        const float turn = std::abs(std::remainder(heading - before, 2.0f * std::numbers::pi_v<float>));
        fastest = std::max(fastest, turn * 48.0f);
        before = heading;
    }
    EXPECT_LT(fastest, std::numbers::pi_v<float>) << "rad/s";
    EXPECT_NEAR(std::remainder(before, 2.0f * std::numbers::pi_v<float>), 0.0f, 0.1f);
}

TEST_F(MotionTest, AccelerationStaysWithinTheLimit) {
    authoring::Scene scene = emptyScene({-5, -5}, {15, 5});
    scene.settings.maximum_acceleration = 2.0;
    addPerson(scene, {0, 0}, {10, 0});
    sim::Simulation simulation(scene, library);
    glm::vec2 before(0.0f);
    for (int step = 0; step < 96; ++step) {
        simulation.step();
        const glm::vec2 velocity = simulation.parts().buffers.states.download<gpu::AgentState>(1)[0].velocity;
        EXPECT_LE(glm::length(velocity - before) * 48.0f, 2.05f);
        before = velocity;
    }
}

TEST_F(MotionTest, TwoPeopleHeadOnPassEachOther) {
    authoring::Scene scene = emptyScene({-10, -5}, {10, 5});
    addPerson(scene, {-6, 0}, {6, 0});
    addPerson(scene, {6, 0}, {-6, 0});
    const Observation seen = run(scene, 20.0f);
    EXPECT_EQ(seen.arrived, 2u);
    EXPECT_LT(seen.deepest_percent, 1.0f);
}

TEST_F(MotionTest, TwoPeopleHeadOnSwerveWithoutSlowingDown) {
    authoring::Scene scene = emptyScene({-10, -5}, {10, 5});
    addPerson(scene, {-8, 0}, {8, 0}, 1.3f);
    addPerson(scene, {8, 0}, {-8, 0}, 1.3f);
    sim::Simulation simulation(scene, library);
    float slowest = 10.0f, furthest_aside = 0.0f;
    for (int step = 0; step < 360; ++step) {
        simulation.step();
        const auto states = simulation.parts().buffers.states.download<gpu::AgentState>(2);
        if (std::abs(states[0].position.x) > 4.0f) continue;  // setting off, or about to stop
        slowest = std::min(slowest, states[0].velocity.x);
        furthest_aside = std::max(furthest_aside, std::abs(states[0].position.y));
    }
    EXPECT_GT(slowest, 0.95f) << "m/s; 0.88 where people brake for oncoming people";
    EXPECT_GT(furthest_aside, 0.15f) << "they pass, so somebody has to give way";
}

TEST_F(MotionTest, TwoPeopleHeadOnPassOnTheirSideWhereTheyHaveOne) {
    for (const double to_the_right : {0.5, -0.5}) {
        for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
            authoring::Scene scene = emptyScene({-10, -5}, {10, 5});
            scene.settings.seed = seed;
            setRule(scene, "passing_side", "discs_to_the_right", to_the_right);
            addPerson(scene, {-8, 0}, {8, 0}, 1.3f);
            addPerson(scene, {8, 0}, {-8, 0}, 1.3f);
            EXPECT_LT(leftWhenTheyMeet(scene, library) * to_the_right, -0.1)
                << to_the_right << ", seed " << seed;
        }
    }
}

TEST_F(MotionTest, OpposingStreamsInACorridorFormLanesAndAllGetThrough) {
    authoring::Scene scene = emptyScene({-30, -4}, {30, 4});
    addWall(scene, {-30, -3.35f}, {30, -3.35f});
    addWall(scene, {-30, 3.35f}, {30, 3.35f});
    for (int column = 0; column < 8; ++column) {
        for (int rank = 0; rank < 7; ++rank) {
            const glm::vec2 place(4.0f + static_cast<float>(column), static_cast<float>(rank) - 3.0f);
            const glm::vec2 jitter(0.05f * static_cast<float>((column * 7 + rank * 3) % 5 - 2), 0.0f);
            for (const float side : {-1.0f, 1.0f}) {
                const glm::vec2 start = (place + jitter) * glm::vec2(side, 1.0f);
                addPerson(scene, start, {-25.0f * side, start.y}, 1.3f);
                scene.stages.back().dwell = 0.0f;
            }
        }
    }
    const Observation seen = run(scene, 90.0f, 4);
    EXPECT_EQ(seen.arrived, 112u);
    EXPECT_LT(seen.deepest_percent, 2.0f);
}

TEST_F(MotionTest, NervousnessGrowsWhileSomebodyIsHeldUpAndFadesOnAFreeWay) {
    authoring::Scene scene = emptyScene({-10, -10}, {10, 10});
    addWall(scene, {2, -8}, {2, 8});
    addPerson(scene, {1, 0}, {8, 0});    // the wall is in its way: hand-made people walk straight on
    addPerson(scene, {-9, 5}, {-2, 5});  // its way is free
    EXPECT_LT(statesAfter(scene, 10)[0].nervousness, 0.25f);
    const std::vector<gpu::AgentState> states = statesAfter(scene, 200);
    EXPECT_GT(states[0].nervousness, 0.6f);
    EXPECT_LT(states[1].nervousness, 0.1f) << "what is left of setting off";
}

TEST_F(MotionTest, WhoWasGivenNoHeadwayClosesUpWhereSomebodyComesAnotherWay) {
    const auto pace = [&](float headway, glm::vec2 goal_of_another) {
        authoring::Scene scene = emptyScene({-10, -10}, {40, 10});
        addPerson(scene, {0, 0}, {30, 0}, 1.3f).headway = headway;
        addPerson(scene, {0.58f, 0}, {30, 0});  // 8 cm ahead
        addPerson(scene, {2, 1}, goal_of_another);
        sim::Simulation simulation(scene, library);
        simulation.step();
        const sim::Buffers& buffers = simulation.parts().buffers;
        const auto bodies = buffers.bodies.download<gpu::Body>(3);
        const auto decisions = buffers.decisions.download<gpu::Decision>(3);
        for (std::size_t slot = 0; slot < 3; ++slot)
            if (bodies[slot].row == 0) return decisions[slot].pace;
        return -1.0f;
    };
    const glm::vec2 along(30, 1), across(2, -8), against(-8, 1);
    EXPECT_NEAR(pace(0.0f, along), 0.8f, 0.05f) << "m/s: 8 cm in a tenth of a second";
    EXPECT_FLOAT_EQ(pace(0.0f, across), 1.3f);
    EXPECT_FLOAT_EQ(pace(0.0f, against), 1.3f);
    EXPECT_NEAR(pace(0.2f, along), 0.4f, 0.05f) << "its own headway";
    EXPECT_NEAR(pace(0.2f, across), 0.4f, 0.05f) << "which it keeps in any case";
}

TEST_F(MotionTest, NobodyWhoWaitsForItsCompanyIsLedAwayByWhoComesUpBehind) {
    authoring::Scene scene = emptyScene({-20, -10}, {60, 10});
    for (const float x : {0.0f, -14.0f}) {
        gpu::Person& person = addPerson(scene, {x, 0}, {50, 0}, 1.3f);
        person.party_first = 0;
        person.party_size = 2;
    }
    for (int i = 0; i < 4; ++i)
        addPerson(scene, {-2.0f - 0.8f * static_cast<float>(i), 0.1f}, {50, 0}, 1.6f);
    const auto states = statesAfter(scene, 5 * 48);
    EXPECT_GT(states[5].position.x, 1.0f) << "m: all of them are past it";
    EXPECT_LT(states[0].position.x, 1.1f) << "m: it waits at 0.2 m/s; more than 2 m where it is led away";
}

TEST_F(MotionTest, WhoIsCarriedOffGivesLessInContact) {
    const auto pushes = [&](glm::vec2 goal) {
        authoring::Scene scene = emptyScene({-10, -10}, {10, 10});
        scene.settings.maximum_acceleration = 0.01;  // so that nothing but contact moves anybody
        addPerson(scene, {0, 0}, goal);
        addPerson(scene, {-0.4f, 0}, {8, 0});  // walks into the other from behind, 10 cm deep
        sim::Simulation simulation(scene, library);
        sim::Buffers& buffers = simulation.parts().buffers;
        auto states = buffers.states.download<gpu::AgentState>(2);
        for (gpu::AgentState& state : states)
            state.velocity = {1.2f, 0.0f};
        buffers.states.upload(states);
        simulation.step();
        const auto after = buffers.states.download<gpu::AgentState>(2);
        const float walked = 1.2f / 48.0f;
        return glm::vec2(after[0].position.x - states[0].position.x - walked,
                         states[1].position.x + walked - after[1].position.x);
    };
    const glm::vec2 along = pushes({8, 0});
    EXPECT_NEAR(along.x, along.y, 0.001f) << "both walk where they want to: both give half";
    const glm::vec2 across = pushes({0, 8});
    EXPECT_NEAR(across.y, 2.0f * across.x, 0.005f) << "m: the other gives twice as much";
    EXPECT_NEAR(across.x + across.y, 0.1f, 0.01f);
}

/// Of somebody who looks east and wants to go there, a step after a push gave it a velocity (m/s).
class PushTest : public MotionTest {
  protected:
    enum class Other { none, stands, goes_along, comes };  // 3 m away, and will not be met
    glm::vec2 velocityAfter(glm::vec2 push, Other other, float headway = 0.0f) {
        authoring::Scene scene = emptyScene({-10, -10}, {10, 10});
        scene.settings.decision_interval = 0.0;
        gpu::Person& person = addPerson(scene, {0, 0}, {8, 0});
        person.heading = 0.0f;
        person.headway = headway;
        if (other != Other::none)
            addPerson(scene, {2.5f, 2.0f},
                      {other == Other::stands       ? 2.5f
                       : other == Other::goes_along ? 9.0f
                                                    : -8.0f,
                       2.0f});
        sim::Simulation simulation(scene, library);
        sim::Buffers& buffers = simulation.parts().buffers;
        auto states = buffers.states.download<gpu::AgentState>(scene.people.size());
        states[0].velocity = push;
        buffers.states.upload(states);
        simulation.step();
        return buffers.states.download<gpu::AgentState>(scene.people.size())[0].velocity;
    }
    static constexpr float walked_off = 1.0f / 48.0f;  // m/s that legs take off a push in a step, at 1 m/s^2
};

TEST_F(PushTest, ASmallOneBackIsMetWithFeetInPlace) {
    EXPECT_NEAR(velocityAfter({-0.2f, 0.0f}, Other::comes).x, 0.0f, 0.001f);
    EXPECT_NEAR(velocityAfter({-0.2f, 0.0f}, Other::goes_along).x, 0.0f, 0.001f);
    EXPECT_NEAR(velocityAfter({-0.8f, 0.0f}, Other::comes).x, -0.8f + walked_off, 0.001f) << "too hard";
    EXPECT_NEAR(velocityAfter({0.2f, 0.0f}, Other::comes).x, 0.2f + walked_off, 0.001f) << "welcome";
}

TEST_F(PushTest, WhoHasOnlyPeopleWhoStandAroundStepsBack) {
    EXPECT_NEAR(velocityAfter({-0.2f, 0.0f}, Other::none).x, -0.2f + walked_off, 0.001f);
    EXPECT_NEAR(velocityAfter({-0.2f, 0.0f}, Other::stands).x, -0.2f + walked_off, 0.001f);
}

TEST_F(PushTest, WhoIsPushedBackSlipsToTheSideToWhichItMoves) {
    EXPECT_GT(velocityAfter({-0.2f, 0.05f}, Other::comes).y, 0.1f);
    EXPECT_LT(velocityAfter({-0.2f, -0.05f}, Other::comes).y, -0.1f);
    EXPECT_NEAR(velocityAfter({0.2f, 0.05f}, Other::comes).y, 0.05f, 0.005f)
        << "not where the push is on its way";
}

TEST_F(PushTest, WhoWaitsForItsTurnStandsLessFirmlyUnlessSomebodyComesAnotherWay) {
    const glm::vec2 waits = velocityAfter({-0.2f, 0.0f}, Other::goes_along, 0.1f);
    EXPECT_LT(waits.x, -0.05f);
    EXPECT_GT(waits.x, -0.15f);
    EXPECT_NEAR(waits.y, 0.0f, 0.001f) << "and slips past nobody";
    EXPECT_NEAR(velocityAfter({-0.08f, 0.0f}, Other::goes_along, 0.1f).x, 0.0f, 0.001f);
    EXPECT_NEAR(velocityAfter({-0.2f, 0.0f}, Other::comes, 0.1f).x, 0.0f, 0.001f);
}

TEST_F(MotionTest, WhoWantsToGoBackAmongOthersTurnsInsteadOfWalkingBackwards) {
    authoring::Scene scene = emptyScene({-10, -10}, {10, 10});
    addPerson(scene, {0, 0}, {-8, 0.5f}).heading = 0.0f;
    addPerson(scene, {2.5f, 2.0f}, {-8, 2});
    sim::Simulation simulation(scene, library);
    float most_back = 0.0f;  // m/s
    for (int step = 0; step < 480; ++step) {
        simulation.step();
        const gpu::AgentState state = simulation.parts().buffers.states.download<gpu::AgentState>(2)[0];
        const glm::vec2 facing(std::cos(state.heading), std::sin(state.heading));
        most_back = std::max(most_back, -glm::dot(glm::vec2(state.velocity), facing));
    }
    EXPECT_LT(most_back, 0.15f) << "m/s; 0.2 without rule 11";
    EXPECT_EQ(simulation.parts().buffers.states.download<gpu::AgentState>(2)[0].status, gpu::STATUS_ARRIVED);
}

TEST_F(MotionTest, WhoStandsInAPlaceStepsBackToIt) {
    authoring::Scene scene = emptyScene({-10, -10}, {10, 10});
    gpu::Person& person = addPerson(scene, {0.4f, 0}, {0, 0});  // its place is behind it
    person.heading = 0.0f;
    person.headway = 0.2f;
    scene.stages.back().dwell = 60.0f;
    scene.stages.back().facing = {5, 0};
    sim::Simulation simulation(scene, library);
    auto states = simulation.parts().buffers.states.download<gpu::AgentState>(1);
    states[0].leave_step = 10'000;  // has stopped, and was pushed off its place
    simulation.parts().buffers.states.upload(states);
    for (int step = 0; step < 240; ++step)
        simulation.step();
    states = simulation.parts().buffers.states.download<gpu::AgentState>(1);
    EXPECT_LT(std::abs(states[0].position.x), 0.15f);
    EXPECT_LT(std::abs(states[0].heading), 0.1f) << "and looks at what there is to see";
}

TEST_F(MotionTest, WhoStandsAmongOthersAtPlacesOfTheirOwnStandsStill) {
    authoring::Scene scene = emptyScene({-10, -10}, {10, 10});
    for (int i = 0; i < 9; ++i) {
        const glm::vec2 place = 0.52f * glm::vec2(i % 3, i / 3);  // 2 cm between bodies
        addPerson(scene, place, place);
        scene.stages.back().dwell = 60.0f;
    }
    sim::Simulation simulation(scene, library);
    float moved = 0.0f;
    for (int step = 0; step < 480; ++step) {
        simulation.step();
        for (const auto& state : simulation.parts().buffers.states.download<gpu::AgentState>(9))
            moved += glm::length(state.velocity) / 48.0f / 9.0f;
    }
    EXPECT_LT(moved, 0.05f) << "m each, in 10 s";
}

TEST_F(MotionTest, WhoDoesNotGetOnTurnsOnTheSpot) {
    authoring::Scene scene = emptyScene({-10, -10}, {10, 10});
    scene.settings.maximum_acceleration = 0.01;  // so that it does not get on
    addPerson(scene, {0, 0}, {8, 0}).heading = 3.0f;
    EXPECT_GT(std::abs(statesAfter(scene, 2)[0].heading), 2.5f) << "it takes time";
    EXPECT_LT(std::abs(statesAfter(scene, 96)[0].heading), 0.1f);
}

TEST_F(MotionTest, FourPeopleMeetingAtACrossingAllArrive) {
    authoring::Scene scene = emptyScene({-10, -10}, {10, 10});
    addPerson(scene, {-6, 0}, {6, 0});
    addPerson(scene, {6, 0}, {-6, 0});
    addPerson(scene, {0, -6}, {0, 6});
    addPerson(scene, {0, 6}, {0, -6});
    const Observation seen = run(scene, 30.0f);
    EXPECT_EQ(seen.arrived, 4u);
    EXPECT_LT(seen.deepest_percent, 1.0f);
}

TEST_F(MotionTest, ACircleOfPeopleReachesTheOppositeSide) {
    authoring::Scene scene = emptyScene({-14, -14}, {14, 14});
    for (int i = 0; i < 63; ++i) {
        const float angle = 2.0f * std::numbers::pi_v<float> * static_cast<float>(i) / 63.0f;
        const glm::vec2 place(10.08f * std::cos(angle), 10.08f * std::sin(angle));
        addPerson(scene, place, -place, 1.3f, 0.3f);
    }
    const Observation seen = run(scene, 60.0f);
    EXPECT_EQ(seen.arrived, 63u);
    EXPECT_LT(seen.deepest_percent, 5.0f);
}

TEST_F(MotionTest, BodiesThatStartInsideEachOtherPartWithoutFlying) {
    authoring::Scene scene = emptyScene({-5, -5}, {5, 5});
    for (int i = 0; i < 9; ++i)
        addPerson(scene, {0.0f, 0.0f}, {0.0f, 0.0f});  // all in the very same place
    sim::Simulation simulation(scene, library);
    for (int step = 0; step < 240; ++step)
        simulation.step();
    const auto states = simulation.parts().buffers.states.download<gpu::AgentState>(9);
    EXPECT_LT(overlapsOf(states, scene.people).deepest_percent, 5.0f);
    for (const gpu::AgentState& state : states)
        EXPECT_LT(glm::length(state.position), 2.0f);
}

TEST_F(MotionTest, ACrushBeyondTheTouchListsStillKeepsBodiesApart) {
    authoring::Scene scene = emptyScene({-6, -6}, {6, 6});
    // 400 children on four square metres: far more within touch than a touch list holds.
    for (int i = 0; i < 400; ++i)
        addPerson(scene, {static_cast<float>(i % 20) * 0.1f - 1.0f, static_cast<float>(i / 20) * 0.1f - 1.0f},
                  {0.0f, 0.0f}, 1.0f, 0.1f);
    scene.settings.contact_iterations = 8;
    sim::Simulation simulation(scene, library);
    simulation.step();
    const auto words = simulation.parts().buffers.touch_words.download<std::uint32_t>(400);
    std::uint32_t longest = 0;
    for (const std::uint32_t word : words)
        longest = std::max(longest, word & gpu::TOUCH_COUNT_MASK);
    EXPECT_GT(longest, gpu::TOUCH_CAPACITY);
    for (int step = 0; step < 480; ++step)
        simulation.step();
    const auto states = simulation.parts().buffers.states.download<gpu::AgentState>(400);
    EXPECT_LT(overlapsOf(states, scene.people).deepest_percent, 12.0f);
}

TEST_F(MotionTest, NobodyPassesThroughAWallHoweverFast) {
    for (const float speed : {1.3f, 3.0f, 10.0f})
        for (const float half_thickness : {0.0f, 0.1f}) {
            authoring::Scene scene = emptyScene({-12, -6}, {12, 6});
            scene.settings.substeps = 1;
            addWall(scene, {0, -5}, {0, 5}, half_thickness);
            for (int i = 0; i < 9; ++i)
                addPerson(scene,
                          {-6.0f - 0.6f * static_cast<float>(i % 3), -2.0f + static_cast<float>(i) * 0.5f},
                          {6, 0}, speed);
            const Observation seen = run(scene, 10.0f);
            EXPECT_EQ(seen.wall_crossings, 0u) << speed << " m/s";
            EXPECT_LT(seen.deepest_wall_percent, 1.0f) << speed << " m/s";
        }
}

TEST_F(MotionTest, ACrowdPressedIntoACornerStaysOnItsSideOfTheWalls) {
    authoring::Scene scene = emptyScene({-6, -6}, {6, 6});
    addWall(scene, {-4, 3}, {3, 3});
    addWall(scene, {3, 3}, {3, -4});
    for (int i = 0; i < 49; ++i)
        addPerson(scene, {-3.0f + 0.7f * static_cast<float>(i % 7), -3.0f + 0.7f * static_cast<float>(i / 7)},
                  {5, 5});
    const Observation seen = run(scene, 15.0f);
    EXPECT_EQ(seen.wall_crossings, 0u);
    EXPECT_LT(seen.deepest_wall_percent, 2.0f);
}

TEST_F(MotionTest, RepeatsToTheLastBit) {
    authoring::Scene scene = uniformScene(1234, 1.2f, 3);
    addWall(scene, {5, 5}, {30, 22});
    const auto bits = [](const std::vector<gpu::AgentState>& states) {
        std::string bytes(states.size() * sizeof(gpu::AgentState), '\0');
        std::memcpy(bytes.data(), states.data(), bytes.size());
        return bytes;
    };
    const std::string first = bits(statesAfter(scene, 120));
    for (int again = 0; again < 3; ++again)
        EXPECT_TRUE(bits(statesAfter(scene, 120)) == first) << "run " << again;
}

TEST_F(MotionTest, ASceneWithoutPeopleOrWallsRuns) {
    const authoring::Scene scene = emptyScene({0, 0}, {5, 5});
    sim::Simulation simulation(scene, library);
    for (int step = 0; step < 4; ++step)
        simulation.step();
    EXPECT_TRUE(simulation.account().agents.empty());
}

TEST_F(MotionTest, ALayoutTooLargeForOneBakeSaysWhatWouldFit) {
    authoring::Scene scene = emptyScene({0, 0}, {20000, 20000});
    addPerson(scene, {5, 5}, {9, 9});
    try {
        sim::Simulation simulation(scene, library);
        FAIL() << "accepted";
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("square kilometres"), std::string::npos) << error.what();
    }
    scene = emptyScene({0, 0}, {2000, 2000});
    addPerson(scene, {5, 5}, {9, 9});
    scene.settings.pixels_per_metre = 100.0;
    try {
        sim::Simulation simulation(scene, library);
        FAIL() << "accepted";
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("pixels_per_metre"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace throng::test
