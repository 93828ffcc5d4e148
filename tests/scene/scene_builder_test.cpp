// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/scene_builder.h"

#include <gtest/gtest.h>

#include <cstring>
#include <glm/geometric.hpp>

namespace throng::authoring {
namespace {

Place area(std::size_t index) {
    return {Place::Kind::area, index, {}};
}

/// Two areas, a wall between them that can be walked round, and a flow from one to the other.
Layout simpleLayout() {
    Layout layout;
    layout.areas.push_back({"left", {{0, 0}, {4, 0}, {4, 10}, {0, 10}}, {}});
    layout.areas.push_back({"right", {{26, 0}, {30, 0}, {30, 10}, {26, 10}}, {}});
    layout.walls.push_back({"screen", {{15, 2}, {15, 8}}, false, 0.2, 3.0, {}});
    Flow flow;
    flow.id = "across";
    flow.from = area(0);
    flow.to = {Destination::Kind::one, {area(1)}, {}, {}};
    flow.count = 63;
    flow.end = 10.0;
    layout.flows.push_back(flow);
    return layout;
}

Layout moved(Layout layout, glm::dvec2 by) {
    for (Area& item : layout.areas)
        for (glm::dvec2& point : item.polygon)
            point += by;
    for (Wall& item : layout.walls)
        for (glm::dvec2& point : item.points)
            point += by;
    for (Road& item : layout.roads)
        for (glm::dvec2& point : item.centreline)
            point += by;
    for (Formation& item : layout.formations) {
        if (auto* circle = std::get_if<CircleFormation>(&item.shape)) circle->centre += by;
        if (auto* grid = std::get_if<GridFormation>(&item.shape)) grid->origin += by;
    }
    return layout;
}

Scene built(const Layout& layout) {
    Diagnostics diagnostics;
    std::optional<Scene> scene = buildScene(layout, diagnostics);
    for (const Diagnostic& entry : diagnostics.entries)
        if (entry.severity == Severity::error) ADD_FAILURE() << entry.message;
    return scene.value_or(Scene{});
}

std::string errorOf(const Layout& layout) {
    Diagnostics diagnostics;
    EXPECT_FALSE(buildScene(layout, diagnostics).has_value());
    std::string all;
    for (const Diagnostic& entry : diagnostics.entries)
        all += entry.message + "\n";
    return all;
}

template <class T>
bool sameBytes(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

TEST(SceneBuilder, ALayoutFarFromTheOriginGivesTheVerySameScene) {
    Layout layout = simpleLayout();
    layout.roads.push_back({"road", {{0.1, 5.3}, {29.7, 4.9}}, 4.3, false, {}});
    Formation ring;
    ring.id = "ring";
    ring.shape = CircleFormation{{7.3, 5.1}, 1.7, 7};
    layout.formations.push_back(ring);
    const Scene near = built(layout);
    const Scene far = built(moved(layout, {395131.0, 5268347.0}));
    EXPECT_TRUE(sameBytes(near.people, far.people));
    EXPECT_TRUE(sameBytes(near.goals, far.goals));
    EXPECT_TRUE(sameBytes(near.wall_segments, far.wall_segments));
    EXPECT_TRUE(sameBytes(near.wall_tiles, far.wall_tiles));
    EXPECT_TRUE(sameBytes(near.entry_points, far.entry_points));
    EXPECT_TRUE(sameBytes(*near.fields.fields.at(0), *far.fields.fields.at(0)));
    EXPECT_TRUE(sameBytes(near.road_distance, far.road_distance));
    EXPECT_EQ(far.origin - near.origin, glm::dvec2(395131.0, 5268347.0));
    EXPECT_EQ(near.output_origin, glm::dvec2(0.0));
    EXPECT_EQ(far.output_origin, far.origin);
}

TEST(SceneBuilder, SpreadsACountEvenlyOverItsTimeInOrder) {
    const Scene scene = built(simpleLayout());
    ASSERT_EQ(scene.people.size(), 63u);
    ASSERT_EQ(scene.queues.size(), 1u);
    for (std::size_t row = 1; row < 63; ++row)
        EXPECT_LE(scene.people[row - 1].spawn_time, scene.people[row].spawn_time);
    EXPECT_GE(scene.people.front().spawn_time, 0.0f);
    EXPECT_LT(scene.people.back().spawn_time, 10.0f);
    EXPECT_GT(scene.people.back().spawn_time, 9.5f);
    for (const gpu::Person& person : scene.people) {
        EXPECT_GE(person.radius, 0.22f);
        EXPECT_LE(person.radius, 0.28f);
        EXPECT_LT(person.variation, 12u);
    }
}

TEST(SceneBuilder, ARateGivesAboutThatManyPeople) {
    Layout layout = simpleLayout();
    layout.flows[0].count.reset();
    layout.flows[0].rate = 20.0;
    layout.flows[0].end = 100.0;
    EXPECT_NEAR(static_cast<double>(built(layout).people.size()), 2000.0, 150.0);
}

TEST(SceneBuilder, AddingAFlowChangesNobodyInTheOthers) {
    Layout layout = simpleLayout();
    const Scene before = built(layout);
    Flow other = layout.flows[0];
    other.id = "back";
    std::swap(other.from, other.to.places[0]);
    layout.flows.push_back(other);
    const Scene after = built(layout);
    ASSERT_EQ(after.people.size(), 126u);
    for (std::size_t row = 0; row < 63; ++row)
        EXPECT_EQ(std::memcmp(&before.people[row], &after.people[row], sizeof(gpu::Person)), 0) << row;
    EXPECT_NE(after.people[0].radius, after.people[63].radius);
}

TEST(SceneBuilder, AnotherSeedGivesOtherPeople) {
    Layout layout = simpleLayout();
    const Scene one = built(layout);
    EXPECT_TRUE(sameBytes(one.people, built(layout).people));
    layout.simulation.seed = 2;
    EXPECT_FALSE(sameBytes(one.people, built(layout).people));
}

TEST(SceneBuilder, PutsWallTilesSoThatNoBodyFitsBetweenThem) {
    Layout layout = simpleLayout();
    layout.walls.push_back({"block", {{8, 2}, {8, 6}, {11, 6}, {11, 2}}, true, 0.2, 3.0, {}});
    layout.walls.push_back({"thick", {{18, 1}, {22, 1}, {22, 5}}, false, 1.0, 3.0, {}});
    const Scene scene = built(layout);
    for (const gpu::WallSegment& segment : scene.wall_segments) {
        const float length = glm::distance(segment.a, segment.b);
        for (float along = 0.0f; along <= length; along += 0.05f) {
            const glm::vec2 point = segment.a + (segment.b - segment.a) * (along / length);
            float nearest = 1.0e9f;
            for (const gpu::WallTile& tile : scene.wall_tiles)
                nearest = std::min(nearest, glm::distance(tile.position, point) - segment.half_thickness);
            EXPECT_LE(nearest, scene.smallest_radius);
        }
    }
    for (std::size_t i = 0; i < scene.wall_tiles.size(); ++i)
        for (std::size_t j = i + 1; j < scene.wall_tiles.size(); ++j)
            EXPECT_GT(glm::distance(scene.wall_tiles[i].position, scene.wall_tiles[j].position), 1.0e-4f);
}

TEST(SceneBuilder, EntryPointsAreClearOfWalls) {
    Layout layout = simpleLayout();
    layout.walls.push_back({"in the entry", {{2, 0}, {2, 10}}, false, 0.4, 3.0, {}});
    const Scene scene = built(layout);
    ASSERT_GT(scene.entry_points.size(), 100u);
    for (const glm::vec2 point : scene.entry_points)
        for (const gpu::WallSegment& wall : scene.wall_segments) {
            const float along = std::clamp(
                glm::dot(point - wall.a, wall.b - wall.a) / glm::dot(wall.b - wall.a, wall.b - wall.a), 0.0f,
                1.0f);
            EXPECT_GT(glm::distance(point, wall.a + along * (wall.b - wall.a)) - wall.half_thickness,
                      scene.largest_radius);
        }
}

TEST(SceneBuilder, ComplainsAboutGoalsThatCannotBeReached) {
    Layout layout = simpleLayout();
    layout.walls[0].points = {{15, -40}, {15, 50}};
    layout.walls.push_back(
        {"seal", {{-10, -40}, {40, -40}, {40, 50}, {-10, 50}, {-10, -40}}, false, 0.2, 3.0, {}});
    EXPECT_NE(errorOf(layout).find("nobody can walk from `left` to `right`"), std::string::npos)
        << errorOf(layout);
}

TEST(SceneBuilder, ComplainsAboutEntriesWithoutRoom) {
    Layout layout = simpleLayout();
    layout.walls.push_back({"on the entry", {{-1, -1}, {5, -1}, {5, 11}, {-1, 11}}, true, 0.2, 3.0, {}});
    EXPECT_NE(errorOf(layout).find("no room to enter in `left`"), std::string::npos) << errorOf(layout);
}

TEST(SceneBuilder, ComplainsAboutPeopleAndGoalsInWalls) {
    Layout layout = simpleLayout();
    Formation list;
    list.id = "extras";
    list.shape =
        ListFormation{{{{15.1, 5.0}, {20, 5}, {}, {}, {}, {7, 3, SourcePath("/formations/0/agents/0")}},
                       {{10, 5}, {15, 5}, {}, {}, {}, {8, 3, {}}}}};
    layout.formations.push_back(list);
    const std::string errors = errorOf(layout);
    EXPECT_NE(errors.find("person 0 stands in a wall"), std::string::npos) << errors;
    EXPECT_NE(errors.find("person 1 has its goal in a wall"), std::string::npos) << errors;
}

TEST(SceneBuilder, LeadsFormationsRoundWallsAndThenStraightToTheirOwnGoals) {
    Layout layout = simpleLayout();
    layout.flows.clear();
    Formation list;
    list.id = "extras";
    list.shape =
        ListFormation{{{{10, 5}, {20, 5}, {}, {}, {}, {}}, {{10, 9.5}, {20.5, 5.5}, {}, {}, {}, {}}}};
    layout.formations.push_back(list);
    const Scene scene = built(layout);
    const gpu::Stage& first = scene.stages[scene.people[0].first_stage];
    const gpu::Stage& second = scene.stages[scene.people[1].first_stage];
    EXPECT_NE(first.field, second.field);
    EXPECT_NE(first.field, gpu::NO_INDEX);
    EXPECT_NE(first.field & gpu::FIELD_THEN_POINT, 0u);
    EXPECT_NE(first.point, second.point);
    // Without walls there is nothing to be led round.
    layout.walls.clear();
    EXPECT_EQ(built(layout).stages.back().field, gpu::NO_INDEX);
}

TEST(SceneBuilder, PeopleDrawnOnTopOfEachOtherWaitForRoom) {
    Layout layout;
    Formation list;
    list.id = "pair";
    list.shape = ListFormation{{{{0, 0}, {9, 0}, {}, {}, {}, {}}, {{0.1, 0}, {9, 1}, {}, {}, {}, {}}}};
    layout.formations.push_back(list);
    const Scene scene = built(layout);
    EXPECT_TRUE(scene.people[0].flags & gpu::PERSON_PRESENT_AT_START);
    EXPECT_FALSE(scene.people[1].flags & gpu::PERSON_PRESENT_AT_START);
}

TEST(SceneBuilder, DrawsPeopleOfSeveralProfilesByTheirWeights) {
    Layout layout = simpleLayout();
    layout.flows[0].count = 1234;
    PeopleShare child, runner;
    child.weight = 3.0;
    child.settings.radius = {Distribution::Kind::constant, 0.18, 0.0, 0.18, 0.18};
    runner.weight = 1.0;
    runner.settings.speed = {Distribution::Kind::constant, 3.0, 0.0, 3.0, 3.0};
    runner.settings.headway = 0.2;
    layout.flows[0].people.kinds = {child, runner};
    const Scene scene = built(layout);
    std::size_t children = 0, runners = 0;
    for (const gpu::Person& person : scene.people) {
        children += person.radius == 0.18f ? 1 : 0;
        runners += person.preferred_speed == 3.0f && person.headway == 0.2f ? 1 : 0;
    }
    EXPECT_EQ(children + runners, 1234u);
    EXPECT_NEAR(static_cast<double>(children), 1234.0 * 0.75, 45.0);  // three deviations
}

TEST(SceneBuilder, ScattersGoalsOverABox) {
    Layout layout;
    GridFormation grid;
    grid.rows = 40;
    grid.columns = 40;
    grid.spacing = 1.0;
    grid.goal = Extent{{10, 50}, {-10, 20}};
    layout.formations.push_back({"scattered", grid, 0.0, {}, {}, Arrival::stay, 0.3, 0, {}});
    const Scene scene = built(layout);
    glm::dvec2 mean(0.0);
    for (const glm::vec2 goal : scene.goals) {
        const glm::dvec2 world = scene.origin + glm::dvec2(goal);
        ASSERT_TRUE(world.x >= -10 && world.x <= 10 && world.y >= 20 && world.y <= 50);
        mean += world / 1600.0;
    }
    EXPECT_NEAR(mean.x, 0.0, 0.5);
    EXPECT_NEAR(mean.y, 35.0, 0.7);
}

TEST(SceneBuilder, LayoutsThatReachTooFarAreRefusedWhereTheyDo) {
    Layout layout = simpleLayout();
    Formation formation;
    formation.id = "far";
    formation.where = {7, 3, {}};
    ListFormation list;
    list.agents.resize(1);
    list.agents[0].position = {8589934591.0, 0.0};
    list.agents[0].goal = {8589934592.0, 0.0};
    formation.shape = list;
    layout.formations.push_back(formation);
    Diagnostics diagnostics;
    EXPECT_FALSE(buildScene(layout, diagnostics));
    ASSERT_EQ(diagnostics.entries.size(), 1u);
    EXPECT_EQ(diagnostics.entries[0].where.line, 7);
    EXPECT_NE(diagnostics.entries[0].message.find("long or wide"), std::string::npos);
}

TEST(SceneBuilder, WallsThatNobodyCouldSimulateAreRefused) {
    Layout layout = simpleLayout();
    for (int i = 0; i < 8; ++i)
        layout.walls.push_back({"endless", {{0.0, 20.0 + i}, {90'000.0, 20.0 + i}}, false, 0.2, 3.0, {}});
    EXPECT_NE(errorOf(layout).find("walls are longer than"), std::string::npos);
}

}  // namespace
}  // namespace throng::authoring
