// SPDX-License-Identifier: Apache-2.0
// Where people are led, and how long that way is.
#include "authoring/scene/routes.h"

#include <gtest/gtest.h>

#include <random>

#include "authoring/scene/scene_builder.h"
#include "tests/scene/field_probe.h"

namespace throng::authoring {
namespace {

Wall block(double x0, double y0, double x1, double y1) {
    return {"", {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, true, 0.2, 3.0, {}};
}

Wall wall(glm::dvec2 a, glm::dvec2 b) {
    return {"", {a, b}, false, 0.2, 3.0, {}};
}

Formation walkers(std::vector<ListedAgent> agents) {
    Formation formation;
    formation.id = "walkers";
    for (ListedAgent& agent : agents)
        if (!agent.radius) agent.radius = 0.2;
    formation.shape = ListFormation{std::move(agents)};
    return formation;
}

ListedAgent walker(glm::dvec2 from, glm::dvec2 to) {
    return {from, to, {}, {}, {}, {}};
}

Scene sceneWith(const Layout& layout) {
    Diagnostics diagnostics;
    std::optional<Scene> scene = buildScene(layout, diagnostics);
    for (const Diagnostic& entry : diagnostics.entries)
        ADD_FAILURE() << entry.message;
    return scene.value_or(Scene{});
}

std::vector<Diagnostic> complaintsOf(const Layout& layout) {
    Diagnostics diagnostics;
    buildScene(layout, diagnostics);
    return diagnostics.entries;
}

void expectShortestWays(const Scene& scene, float within) {
    for (const gpu::Person& person : scene.people) {
        const float shortest = shortestWay(scene, person);
        EXPECT_NEAR(walkedWay(scene, person) / shortest, 1.0f, within) << person.first_stage;
        EXPECT_NEAR(toldWay(scene, person) / shortest, 1.0f, within) << person.first_stage;
    }
}

TEST(Routes, LeadBetweenBlocksByTheShortestWayAndTellItsLength) {
    Layout layout;
    for (const double x : {1.333, -5.333})
        for (const double y : {1.333, -5.333})
            layout.walls.push_back(block(x, y, x + 4.0, y + 4.0));
    layout.formations.push_back(walkers({walker({-7.2807, -7.32749}, {7.2807, 7.32749})}));
    const Scene scene = sceneWith(layout);
    EXPECT_NEAR(shortestWay(scene, scene.people[0]), 22.58f, 0.05f);
    expectShortestWays(scene, 0.02f);
}

/// Blocks that do not touch, and people who walk between corners of the site.
Layout scattered(std::uint64_t seed, double extent, int across) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> draw(0.0, 1.0);
    Layout layout;
    const double field = extent / across;
    for (int y = 0; y < across; ++y)
        for (int x = 0; x < across; ++x) {
            const glm::dvec2 corner(field * (x + 0.1 + 0.3 * draw(random)),
                                    field * (y + 0.1 + 0.3 * draw(random)));
            layout.walls.push_back(block(corner.x, corner.y, corner.x + field * (0.2 + 0.2 * draw(random)),
                                         corner.y + field * (0.2 + 0.2 * draw(random))));
        }
    layout.formations.push_back(
        walkers({walker({-1, -1}, {extent + 1, extent + 1}), walker({extent + 1, -1}, {-1, extent + 1}),
                 walker({-1, 0.5 * extent}, {extent + 1, 0.4 * extent})}));
    return layout;
}

TEST(Routes, LeadThroughScatteredBlocksByTheShortestWay) {
    for (const std::uint64_t seed : {1u, 2u, 3u})
        expectShortestWays(sceneWith(scattered(seed, 30.0, 4)), 0.02f);
}

TEST(Routes, LeadOverLargeSitesByTheShortestWay) {
    for (const std::uint64_t seed : {4u, 5u}) {
        const Scene scene = sceneWith(scattered(seed, 600.0, 4));
        EXPECT_GT(scene.fields.blocks_across, 0u);
        expectShortestWays(scene, 0.02f);
    }
}

/// A square of walls with a door in the middle of its south side.
void addHouse(Layout& layout, glm::dvec2 corner, double side, double door) {
    const auto at = [&](double x, double y) { return corner + glm::dvec2(x, y); };
    const double left = 0.5 * (side - door) - 0.1,
                 right = 0.5 * (side + door) + 0.1;  // walls have round ends
    layout.walls.push_back(wall(at(0, 0), at(left, 0)));
    layout.walls.push_back(wall(at(right, 0), at(side, 0)));
    layout.walls.push_back(wall(at(side, 0), at(side, side)));
    layout.walls.push_back(wall(at(side, side), at(0, side)));
    layout.walls.push_back(wall(at(0, side), at(0, 0)));
}

TEST(Routes, DoorsOf80CentimetresAreOpenOnASiteOfOneKilometre) {
    Layout layout;
    std::vector<ListedAgent> agents;
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 3; ++x) {
            const glm::dvec2 corner(490.0 * x + 3.37 * y, 490.0 * y + 1.91 * x);
            addHouse(layout, corner, 12.0, 0.8);
            agents.push_back(walker({500.0 + 7.0 * x, 250.0 + 7.0 * y}, corner + glm::dvec2(6.0, 8.0)));
        }
    layout.formations.push_back(walkers(agents));
    const Scene scene = sceneWith(layout);
    for (const gpu::Person& person : scene.people)
        EXPECT_NEAR(walkedWay(scene, person) / shortestWay(scene, person), 1.0f, 0.02f);
    EXPECT_LT(scene.fields.cells_per_field, 4'000'000u);
}

TEST(Routes, ManyGoalsInRoomsOfTheirOwnNeedBoundedMemory) {
    Layout layout;
    std::vector<ListedAgent> agents;
    for (int y = 0; y < 14; ++y)
        for (int x = 0; x < 14; ++x) {
            addHouse(layout, {6.0 * x, 6.0 * y}, 4.0, 0.8);
            agents.push_back(walker({-2.0 - 0.6 * x, 2.0 + 0.6 * y}, {6.0 * x + 2.0, 6.0 * y + 2.0}));
        }
    layout.formations.push_back(walkers(agents));
    const Scene scene = sceneWith(layout);
    EXPECT_EQ(scene.field_count, 196u);
    EXPECT_LT(scene.fields.cells_per_field * scene.field_count * sizeof(gpu::FieldCell), 210u << 20);
    for (std::size_t i = 0; i < scene.people.size(); i += 13)
        EXPECT_LT(walkedWay(scene, scene.people[i]),
                  1.5f * glm::distance(scene.people[i].spawn_position, scene.goals[i]) + 15.0f);
}

TEST(Routes, CrowdsShareFieldsAndStillComeToTheirOwnGoals) {
    Layout layout;
    layout.walls = {block(24, -20, 28, 8)};
    GridFormation grid;
    grid.rows = grid.columns = 30;
    grid.spacing = 0.6;
    grid.origin = {0.0, -9.0};
    grid.goal = glm::dvec2(60.0, 0.0);
    layout.formations.push_back({"crowd", grid, 0.0, {}, {}, Arrival::stay, 0.3, 0, {}});
    const Scene scene = sceneWith(layout);
    EXPECT_LT(scene.field_count, 100u);
    for (std::size_t i = 0; i < scene.people.size(); i += 37)
        EXPECT_NEAR(walkedWay(scene, scene.people[i]) / shortestWay(scene, scene.people[i]), 1.0f, 0.05f)
            << i;
}

TEST(Routes, OneCauseGivesOneError) {
    Layout layout;
    layout.walls.push_back({"ring", {{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}}, false, 0.2, 3.0, {}});
    std::vector<ListedAgent> agents;
    for (int i = 0; i < 20; ++i)
        agents.push_back(walker({20.0 + i, 5.0}, {4.0 + 0.1 * i, 5.0}));
    layout.formations.push_back(walkers(agents));
    const std::vector<Diagnostic> complaints = complaintsOf(layout);
    ASSERT_EQ(complaints.size(), 1u);
    EXPECT_NE(complaints[0].message.find("person 0 cannot reach its goal, and 19 more"), std::string::npos)
        << complaints[0].message;
}

TEST(Routes, AGoalNearerToAWallThanABodyIsReachedWithinItsTolerance) {
    Layout layout;
    layout.walls = {wall({10, -5}, {10, 5})};
    layout.formations.push_back(walkers({walker({0, 0}, {9.8, 0})}));  // 0.1 m from the wall
    layout.formations[0].goal_tolerance = 0.15;
    EXPECT_TRUE(complaintsOf(layout).empty());
    const Scene scene = sceneWith(layout);
    EXPECT_LT(walkedWay(scene, scene.people[0]), 10.0f);
    layout.formations[0].goal_tolerance = 0.05;
    ASSERT_EQ(complaintsOf(layout).size(), 1u);
    EXPECT_NE(complaintsOf(layout)[0].message.find("0.10 m from it"), std::string::npos)
        << complaintsOf(layout)[0].message;
    layout.formations[0].shape = ListFormation{{walker({0, 0}, {10.0, 0})}};
    layout.formations[0].goal_tolerance = 0.5;
    ASSERT_EQ(complaintsOf(layout).size(), 1u);
    EXPECT_TRUE(complaintsOf(layout)[0].message.ends_with("has its goal in a wall"));
    EXPECT_EQ(complaintsOf(layout)[0].hint, "move the goal, or the wall") << "no tolerance helps there";
}

TEST(Routes, StartsThatWillHaveNoRoomAreTold) {
    Layout layout;
    layout.formations.push_back(walkers({walker({0, 0}, {9, 0}), walker({0.1, 0}, {9, 1})}));
    ASSERT_EQ(complaintsOf(layout).size(), 1u);
    EXPECT_EQ(complaintsOf(layout)[0].severity, Severity::warning);
    EXPECT_NE(complaintsOf(layout)[0].message.find("person 1 starts where somebody else stands"),
              std::string::npos);
    layout.formations = {walkers({walker({0, 0}, {9, 0})})};
    layout.walls = {wall({0, -3}, {0, 3})};
    layout.walls[0].id = "gate";
    layout.walls[0].toggles = {5.0};
    ASSERT_EQ(complaintsOf(layout).size(), 1u);
    EXPECT_NE(complaintsOf(layout)[0].message.find("stands in the closed gate `gate`"), std::string::npos);
    layout.walls[0].open_at_start = true;
    EXPECT_TRUE(complaintsOf(layout).empty());
}

}  // namespace
}  // namespace throng::authoring
