// SPDX-License-Identifier: Apache-2.0
// Whose starts are looked at closely, against looking at every pair and every wall.
#include "authoring/scene/close_starts.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <tuple>

#include "authoring/layout/layout_reader.h"
#include "authoring/scene/people.h"
#include "authoring/scene/scene_builder.h"
#include "authoring/scene/walls.h"
#include "base/random.h"

namespace throng::authoring {
namespace {

float fraction(std::size_t i, std::uint64_t purpose) {
    return static_cast<float>(fractionOf(scramble(i * 8 + purpose)));
}

/// One in seven stands up to so many times as far out as the others, one in ten is broader than deep.
Scene crowdOf(std::size_t count, float extent, float furthest = 1.0f) {
    Scene scene;
    for (std::size_t i = 0; i < count; ++i) {
        gpu::Person person{};
        const float reach = i % 7 == 0 ? furthest * extent : extent;
        person.spawn_position = reach * glm::vec2(fraction(i, 0) - 0.5f, fraction(i, 1) - 0.5f);
        person.radius = 0.15f + 0.2f * fraction(i, 2);
        if (i % 10 == 0) person.half_axis = 0.08f;
        scene.people.push_back(person);
    }
    scene.queues = {{0, static_cast<gpu::uint>(count)}};
    return scene;
}

/// How many, and how far out some are: in one crowd squares are small, and neighbours stand in others.
class CloseStartsOf : public ::testing::TestWithParam<std::tuple<std::size_t, float>> {};

TEST_P(CloseStartsOf, AreThoseWhoReachOthersOrWalls) {
    const auto [count, furthest] = GetParam();
    Scene scene = crowdOf(count, 0.7f * std::sqrt(static_cast<float>(count)), furthest);
    WalkGeometry geometry;
    geometry.minimum = glm::vec2(-500.0f);
    geometry.maximum = glm::vec2(500.0f);
    gpu::WallSegment wall{};
    wall.a = {-3.0f, -2.0f};
    wall.b = {3.0f, 2.0f};
    geometry.walls = {wall};
    const CloseStarts close = closeStarts(scene, geometry, 0, 1);
    std::size_t to_bodies = 0, to_walls = 0;
    for (std::size_t i = 0; i < scene.people.size(); ++i) {
        const gpu::Person& person = scene.people[i];
        bool near = false;
        for (std::size_t j = 0; j < scene.people.size(); ++j)
            near = near || (i != j && glm::distance(person.spawn_position, scene.people[j].spawn_position) <
                                          person.radius + scene.people[j].radius);
        EXPECT_EQ(close.toBody(i), near) << i;
        const float apart = segmentDistance(person.spawn_position, wall.a, wall.b) - person.radius;
        if (std::abs(apart) > 0.002f) {
            EXPECT_EQ(close.toWall(i), apart < 0.0f) << i;
        }
        to_bodies += near;
        to_walls += apart < 0.0f;
    }
    if (count < 100) return;
    EXPECT_GT(to_bodies, 50u);
    EXPECT_LT(to_bodies, count - 50);
    EXPECT_GT(to_walls, 5u);
}

INSTANTIATE_TEST_SUITE_P(AwkwardSizes, CloseStartsOf,
                         ::testing::Combine(::testing::Values(1, 2, 63, 1234),
                                            ::testing::Values(1.0f, 40.0f)));

TEST(CloseStarts, OfBodiesBesideSolidsAreAlwaysLookedAt) {
    Scene scene = crowdOf(20, 2.0f);
    WalkGeometry geometry;
    geometry.solids = {{{90.0f, 90.0f}, {91.0f, 90.0f}, {91.0f, 91.0f}}};
    const CloseStarts close = closeStarts(scene, geometry, 0, 1);
    for (std::size_t i = 0; i < scene.people.size(); ++i)
        EXPECT_EQ(close.toWall(i), scene.people[i].half_axis != 0.0f) << i;
}

TEST(CloseStarts, OfFormationsAlone) {
    Scene scene = crowdOf(30, 0.3f);
    scene.queues = {{0, 10}, {10, 10}, {20, 10}};
    const CloseStarts close = closeStarts(scene, {}, 1, 1);
    for (std::size_t i = 0; i < scene.people.size(); ++i)
        if (i < 10 || i >= 20) {
            EXPECT_EQ(close.of_row[i], 0) << i;
        }
}

// People of a crowd that takes several threads are drawn as each alone would be, and those who go where
// others go walk their stages, or after a pause of their own the same.
TEST(CloseStarts, OfManyAreThoseOfEach) {
    std::optional<Layout> layout;
    const auto sceneOf = [&](const std::string& wait) {
        Diagnostics diagnostics;
        layout = readLayout(
            R"({"throng": 1, "simulation": {"duration": 10},
 "areas": [{"id": "a", "polygon": [[300,0],[304,0],[304,30],[300,30]]}],
 "formations": [{"id": "f", "type": "grid", "origin": [0, 0], "rows": 220, "columns": 220, "spacing": 0.9,
                 "jitter": 0.4, "goal": "a", "arrival": "leave", "people": {"radius": {"uniform": [0.2, 0.3]}})" +
                wait + "}]}",
            {}, diagnostics);
        std::optional<Scene> scene;
        if (layout) scene = buildScene(*layout, diagnostics);
        for (const Diagnostic& entry : diagnostics.entries)
            EXPECT_EQ(entry.severity, Severity::warning) << entry.message;
        return scene.value_or(Scene{});
    };
    const Scene scene = sceneOf(""), waits = sceneOf(R"(, "wait": {"uniform": [1, 5]})");
    ASSERT_EQ(scene.people.size(), 48'400u);
    EXPECT_EQ(scene.stages.size(), 1u);
    ASSERT_EQ(waits.people.size(), scene.people.size());
    EXPECT_EQ(waits.stages.size(), 2 * waits.people.size());
    const GroupRandom random(layout->simulation.seed, "f");
    std::size_t present = 0;
    for (std::size_t i = 0; i < scene.people.size(); ++i) {
        const gpu::Person &one = scene.people[i], &other = waits.people[i];
        const gpu::Person alone = drawPerson(layout->formations.front().people, random, i, 0);
        ASSERT_EQ(one.radius, alone.radius);
        ASSERT_EQ(one.own_radius, alone.radius);
        ASSERT_EQ(one.preferred_speed, alone.preferred_speed);
        ASSERT_EQ(one.spawn_position, other.spawn_position);
        const gpu::Stage& goal = scene.stages[one.first_stage];
        const gpu::Stage& same = waits.stages[other.first_stage + 1];
        ASSERT_EQ(goal.point, same.point);
        ASSERT_EQ(goal.field, same.field);
        present += (one.flags & gpu::PERSON_PRESENT_AT_START) != 0;
    }
    EXPECT_GT(present, 30'000u);
    EXPECT_LT(present, 48'000u);
}

}  // namespace
}  // namespace throng::authoring
