// SPDX-License-Identifier: Apache-2.0
// Following people: the crowd goes on as if nobody looked, and what is told of the rules adds up to what was
// done.
#include <glm/geometric.hpp>
#include <map>
#include <set>

#include "sim/follow/follower.h"
#include "sim/follow/rungs.h"
#include "tests/sim/gpu_test.h"
#include "tests/sim/scenes.h"

namespace throng::test {
namespace {

using Steps = std::map<std::uint32_t, std::vector<FollowedStep>>;  // by row

constexpr float kNoise = 4.0e-3f;  // m/s: rounding of places, over a few rules

class FollowTest : public GpuTest {
  protected:
    Steps follow(const authoring::Scene& scene, const std::vector<std::uint32_t>& rows, int steps) {
        sim::Simulation simulation(scene, library);
        sim::Follower follower(simulation, scene, rows);
        Steps told;
        for (int i = 0; i < steps; ++i)
            for (const FollowedStep& step : follower.step())
                told[step.row].push_back(step);
        return told;
    }

    static authoring::Scene denseCrowd() {
        authoring::Scene scene = uniformScene(120, 0.62f, 5);
        addWall(scene, {-3.0f, -3.0f}, {3.0f, 3.0f}, 0.1f);
        return scene;
    }
    /// The same with bodies that are no discs, but for some; some are deeper than broad.
    static authoring::Scene denseBodies() {
        authoring::Scene scene = denseCrowd();
        for (std::size_t row = 0; row < scene.people.size(); ++row) {
            gpu::Person& person = scene.people[row];
            person.half_axis = row % 8 == 0 ? 0.0f : (row % 8 == 7 ? -0.3f : 0.45f) * person.radius;
        }
        return scene;
    }
    void expectThatLookingChangesNothing(const authoring::Scene& scene) {
        sim::Simulation alone(scene, library), watched(scene, library);
        sim::Follower follower(watched, scene, {3, 40, 77});
        for (int i = 0; i < 61; ++i) {
            alone.step();
            follower.step();
        }
        const sim::Simulation::State expected = alone.save(), found = watched.save();
        EXPECT_EQ(found.steps_done, expected.steps_done);
        ASSERT_EQ(found.parts.size(), expected.parts.size());
        for (std::size_t i = 0; i < expected.parts.size(); ++i)
            EXPECT_TRUE(found.parts[i] == expected.parts[i]) << expected.parts[i].first;
    }
    /// How much is free along the way of somebody who makes for a body 3 m ahead, m; below zero: it is not in
    /// the way.
    float freeBefore(float aside, float heading) {
        authoring::Scene scene = emptyScene({-10, -10}, {10, 10});
        for (const glm::vec2 place : {glm::vec2(-3.0f, 0.0f), glm::vec2(0.0f, aside)}) {
            gpu::Person& person = addPerson(scene, place, place, 1.3f, 0.235f);
            person.half_axis = 0.11f;
            person.heading = heading;
        }
        scene.people[0].heading = 0.0f;
        scene.stages[0].point = {8.0f, 0.0f};
        return follow(scene, {0}, 1).at(0).front().free_ahead;
    }
};

/// m/s along the wish that a rule added in all.
std::map<std::string, float> added(const std::vector<FollowedStep>& steps) {
    std::map<std::string, float> sums;
    for (const FollowedStep& step : steps)
        for (const Influence& each : step.influences)
            if (each.changed == Changed::velocity && glm::length(step.wish) > 0.1f)
                sums[each.rule] += glm::dot(each.after - each.before, glm::normalize(step.wish));
    return sums;
}

std::set<std::string> rulesIn(const std::vector<FollowedStep>& steps, Changed changed) {
    std::set<std::string> rules;
    for (const FollowedStep& step : steps)
        for (const Influence& each : step.influences)
            if (each.changed == changed) rules.insert(each.rule);
    return rules;
}

/// Each influence begins where the last one of its kind ended, and the last ends where the step does.
void expectNoGaps(const FollowedStep& step, Changed changed, glm::vec2 from, glm::vec2 to) {
    for (const Influence& each : step.influences) {
        if (each.changed != changed) continue;
        EXPECT_LT(glm::distance(each.before, from), kNoise) << step.step << " " << each.rule;
        from = each.after;
    }
    EXPECT_LT(glm::distance(from, to), kNoise) << "at the end of step " << step.step;
}

TEST_F(FollowTest, TheCrowdGoesOnAsIfNobodyLooked) {
    expectThatLookingChangesNothing(denseCrowd());
}

TEST_F(FollowTest, ACrowdOfBodiesGoesOnAsIfNobodyLooked) {
    expectThatLookingChangesNothing(denseBodies());
}

TEST_F(FollowTest, WhatTurnsAChestAddsUpInACrushOfBodies) {
    // A disc, two people, and two who are deeper than broad.
    Steps told = follow(denseBodies(), {40, 3, 61, 47, 79}, 90);
    ASSERT_EQ(told.size(), 5u);
    EXPECT_TRUE(rulesIn(told.at(40), Changed::chest).empty());
    for (const auto& [row, steps] : told)
        for (const FollowedStep& step : steps) {
            expectNoGaps(step, Changed::velocity, step.velocity_before, step.velocity);
            if (row != 40) expectNoGaps(step, Changed::chest, step.chest_before, step.chest);
            EXPECT_EQ(bodyAfter(step).thickness < static_cast<double>(step.radius) - 0.01, row != 40);
        }
    std::set<std::string> rules;
    for (const auto& [row, steps] : told)
        rules.merge(rulesIn(steps, Changed::chest));
    for (const char* rule : {"shoulders", "contact"})
        EXPECT_TRUE(rules.contains(rule)) << rule;
    EXPECT_FALSE(rules.contains("rounding"));
}

TEST_F(FollowTest, WhatIsFreeAheadGoesByTheShapesOfBodies) {
    constexpr float kQuarter = 1.5707963f;
    EXPECT_NEAR(freeBefore(0.0f, 0.0f), 3.0f - 0.25f, 1.0e-3f);      // chest to back
    EXPECT_NEAR(freeBefore(0.0f, kQuarter), 3.0f - 0.36f, 1.0e-3f);  // chest to shoulder
    EXPECT_NEAR(freeBefore(0.2f, 0.0f), 3.0f - 0.25f, 1.0e-3f);      // half of it in the way
    EXPECT_GT(freeBefore(0.4f, 0.0f), 3.0f - 0.25f);                 // a round shoulder
    EXPECT_LT(freeBefore(0.4f, kQuarter), 0.0f);                     // past a back: discs would touch
    EXPECT_LT(freeBefore(0.55f, 0.0f), 0.0f);
}

TEST_F(FollowTest, WhatRulesDidAddsUpInACrush) {
    Steps told = follow(denseCrowd(), {3, 40, 77}, 90);
    ASSERT_EQ(told.size(), 3u);
    std::set<std::string> rules;
    for (const auto& [row, steps] : told) {
        ASSERT_EQ(steps.size(), 90u);
        for (const FollowedStep& step : steps) {
            expectNoGaps(step, Changed::velocity, step.velocity_before, step.velocity);
            expectNoGaps(step, Changed::heading, step.facing_before, step.facing);
            if (step.decides) expectNoGaps(step, Changed::wish, glm::vec2(0.0f), step.wish);
        }
        rules.merge(rulesIn(steps, Changed::velocity));
        // Nothing is left for what no rule answers for.
        EXPECT_FALSE(rules.contains("rounding"));
    }
    for (const char* rule : {"drive", "room_by_time_to_collision", "contact", "cushion"})
        EXPECT_TRUE(rules.contains(rule)) << rule;
}

TEST_F(FollowTest, WhoIsAloneWalksAsItWishes) {
    authoring::Scene scene = emptyScene({-10, -10}, {10, 10});
    addPerson(scene, {-8, 0}, {8, 0});
    const Steps told = follow(scene, {0}, 200);
    const std::vector<FollowedStep>& steps = told.at(0);
    EXPECT_EQ(rulesIn(steps, Changed::velocity), std::set<std::string>{"drive"});
    EXPECT_NEAR(glm::length(steps.back().wish), 1.3f, 1.0e-3f);
    EXPECT_NEAR(glm::length(steps.back().velocity), 1.3f, 0.01f);
    EXPECT_TRUE(steps.back().sensed.empty());
    EXPECT_LT(steps.back().wall_gap, 0.0f);
    for (const FollowedStep& step : steps)
        EXPECT_EQ(step.doing, Doing::walking);
}

TEST_F(FollowTest, WhoIsStoppedByAWallIsToldSo) {
    authoring::Scene scene = emptyScene({-10, -10}, {10, 10});
    addPerson(scene, {-3, 0}, {8, 0});
    addWall(scene, {0, -4}, {0, 4}, 0.1f);
    const Steps told = follow(scene, {0}, 300);
    const FollowedStep& last = told.at(0).back();
    EXPECT_LT(glm::length(last.velocity), 0.3f);
    EXPECT_LT(last.wall_gap, 0.1f);
    EXPECT_GE(last.wall_gap, 0.0f);
    const std::map<std::string, float> sums = added(told.at(0));
    ASSERT_TRUE(sums.contains("walls_ahead"));
    for (const auto& [rule, sum] : sums)
        EXPECT_LE(sums.at("walls_ahead"), sum) << rule;
}

TEST_F(FollowTest, WhoWalksUpToSomebodyIsHeldBackByRoomForThem) {
    authoring::Scene scene = emptyScene({-10, -10}, {10, 10});
    addPerson(scene, {-6, 0}, {8, 0});
    addPerson(scene, {-3, 0.1f}, {8, 0}, 0.4f);  // walks the same way, slowly
    const Steps told = follow(scene, {0}, 250);
    const std::map<std::string, float> sums = added(told.at(0));
    ASSERT_TRUE(sums.contains("room_by_time_to_collision"));
    EXPECT_LT(sums.at("room_by_time_to_collision"), -0.05f);
    float nearest = 100.0f;
    for (const FollowedStep& step : told.at(0))
        for (const SensedPerson& other : step.sensed) {
            EXPECT_EQ(other.row, 1u);
            nearest = std::min(nearest, other.gap);
        }
    EXPECT_LT(nearest, 1.0f);
}

TEST_F(FollowTest, RulesThatAreOffAreNotNamed) {
    authoring::Scene scene = denseCrowd();
    setRule(scene, "room_by_time_to_collision", "enabled", 0);
    setRule(scene, "cushion", "enabled", 0);
    for (const auto& [row, steps] : follow(scene, {3, 40}, 60))
        for (const char* rule : {"room_by_time_to_collision", "cushion"})
            EXPECT_FALSE(rulesIn(steps, Changed::velocity).contains(rule)) << rule;
}

TEST(Rungs, EndWithTheRulesAsTheyWereTold) {
    const gl::ShaderLibrary library;
    authoring::Scene scene = emptyScene({-1, -1}, {1, 1});
    setRule(scene, "passing_side", "enabled", 0);
    const MotionSettings& told = scene.settings.motion;
    const auto rungs = sim::rungsOf(library, "shaders/motion/avoid.comp", told, "drive");
    EXPECT_EQ(rungs.front().rule, "drive");
    EXPECT_FALSE(rungs.front().rules.isOn("walls_ahead"));
    std::set<std::string> names;
    for (const sim::Rung& rung : rungs)
        EXPECT_TRUE(names.insert(rung.rule).second) << rung.rule;
    EXPECT_TRUE(names.contains("walls_ahead"));
    EXPECT_FALSE(names.contains("standing_fast"));  // is contact's
    EXPECT_FALSE(names.contains("passing_side"));   // is off
    EXPECT_EQ(rungs.back().rules.definitions(), told.definitions());
}

}  // namespace
}  // namespace throng::test
