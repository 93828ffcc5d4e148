// SPDX-License-Identifier: Apache-2.0
// What the device is told of behaviours.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "authoring/layout/layout_reader.h"
#include "authoring/scene/scene_builder.h"

namespace throng::authoring {
namespace {

constexpr const char* kText = R"({"throng": 1, "simulation": {"duration": 30},
 "areas": [{"id": "in", "polygon": [[0, 0], [4, 0], [4, 4], [0, 4]]},
  {"id": "square", "polygon": [[10, 0], [20, 0], [20, 9], [10, 9]], "facing": [15, 12]},
  {"id": "away", "polygon": [[30, 0], [34, 0], [34, 4], [30, 4]]}],
 "walls": [{"id": "doors", "points": [[25, 0], [25, 4]]},
  {"id": "pillar", "closed": true, "points": [[14, 4], [16, 4], [16, 6], [14, 6]]}],
 "behaviours": [{"id": "b", "start": "stroll", "states": {
   "leave": {"walk_to": {"nearest": ["in", "away"]}},
   "stroll": {"wander": "square", "until": [{"open": "doors", "empty": "square", "of": ["people", "others"],
     "then": "shop"}, {"all_here": "square", "then": "leave"}]},
   "shop": {"visit": ["square", "away"], "count": [1, 2], "for": {"uniform": [2, 5]}, "then": "leave"}}}],
 "flows": [{"id": "people", "from": "in", "behaviour": "b", "count": 5},
  {"id": "passers", "from": "in", "to": "away", "count": 3}],
 "formations": [{"id": "others", "type": "grid", "origin": [12, 2], "rows": 1, "columns": 2, "behaviour": "b"}],
 "events": [{"at": 5, "open": "doors"}, {"at": 9, "close": "doors"}]})";

Scene built(std::string_view text) {
    Diagnostics diagnostics;
    const std::optional<Layout> layout = readLayout(text, {}, diagnostics);
    std::optional<Scene> scene = layout ? buildScene(*layout, diagnostics) : std::nullopt;
    for (const Diagnostic& entry : diagnostics.entries)
        ADD_FAILURE() << entry.message;
    return scene.value_or(Scene{});
}

TEST(BehaviourTables, EveryGroupHasItsOwnCopy) {
    const Scene scene = built(kText);
    const Behaviours& tables = scene.behaviours;
    ASSERT_EQ(tables.states.size(), 6u) << "three for the flow, three for the formation";
    ASSERT_EQ(tables.minds.size(), scene.people.size());
    for (std::size_t row = 0; row < scene.people.size(); ++row) {
        const std::string& group = scene.groups[scene.people[row].group].id;
        EXPECT_EQ(tables.minds[row].state, group == "people" ? 1u : group == "others" ? 4u : gpu::NO_INDEX);
        if (group == "passers") continue;
        EXPECT_EQ(tables.minds[row].first_stage, scene.people[row].first_stage);
        EXPECT_EQ(scene.people[row].stage_count, 2u);
    }
    EXPECT_EQ(tables.states[2].then, 0u);
    EXPECT_EQ(tables.states[5].then, 3u);
}

TEST(BehaviourTables, StatesAreWhatTheLayoutSays) {
    const Scene scene = built(kText);
    const Behaviours& tables = scene.behaviours;
    const gpu::BehaviourState &leave = tables.states[0], &stroll = tables.states[1], &shop = tables.states[2];
    EXPECT_EQ(leave.does, gpu::DOES_WALK);
    EXPECT_EQ(leave.flags, gpu::STATE_LEAVES | gpu::STATE_NEAREST);
    EXPECT_EQ(leave.place_count, 1u) << "one field leads to whichever is nearest";
    EXPECT_EQ(stroll.does, gpu::DOES_WANDER);
    EXPECT_EQ(stroll.then, gpu::NO_INDEX);
    EXPECT_EQ(shop.place_count, 2u);
    EXPECT_EQ(shop.least, 1u);
    EXPECT_EQ(shop.most, 2u);
    EXPECT_EQ(shop.lasts.kind, 1u);
    EXPECT_EQ(shop.lasts.maximum, 5.0f);
    EXPECT_EQ(shop.activity, gpu::ACTIVITY_LOOK);
    const gpu::BehaviourPlace& square = tables.places[shop.first_place];
    EXPECT_NEAR(glm::distance(square.facing - square.middle, {0.0f, 7.5f}), 0.0f, 1e-4f);
    const gpu::BehaviourPlace& away = tables.places[shop.first_place + 1];
    EXPECT_EQ(away.facing, away.middle) << "an area that faces nothing";
}

TEST(BehaviourTables, RulesThatStandTogetherLeadOnInTheLastOfThem) {
    const Scene scene = built(kText);
    const Behaviours& tables = scene.behaviours;
    const gpu::BehaviourState& stroll = tables.states[1];
    ASSERT_EQ(stroll.rule_count, 4u) << "empty of the one, empty of the other, open; and all here";
    const gpu::BehaviourRule* rules = &tables.rules[stroll.first_rule];
    EXPECT_EQ(rules[0].condition, gpu::IF_EMPTY);
    EXPECT_EQ(rules[1].condition, gpu::IF_EMPTY);
    EXPECT_EQ(rules[2].condition, gpu::IF_OPEN);
    EXPECT_EQ(rules[0].then, gpu::NO_INDEX);
    EXPECT_EQ(rules[1].then, gpu::NO_INDEX);
    EXPECT_EQ(rules[2].then, 2u);
    EXPECT_EQ(rules[3].then, 0u);
    EXPECT_EQ(rules[2].subject, 0u) << "closed at first";
    ASSERT_EQ(rules[2].count, 2u);
    EXPECT_EQ(tables.points[rules[2].first].x, 5.0f);
    EXPECT_EQ(tables.points[rules[2].first + 1].x, 9.0f);
    const gpu::Census& people = tables.censuses[rules[0].subject];
    EXPECT_EQ(people.row_count, 5u);
    EXPECT_EQ(tables.censuses[rules[1].subject].row_count, 2u);
    EXPECT_EQ(rules[3].subject, rules[0].subject) << "the same people in the same place are counted once";
}

TEST(BehaviourTables, SpotsAreInThePlaceAndClearOfWalls) {
    const Scene scene = built(kText);
    const Behaviours& tables = scene.behaviours;
    const gpu::BehaviourPlace& square = tables.places[tables.states[1].first_place];
    EXPECT_GT(square.point_count, 100u);
    for (std::uint32_t i = square.first_point; i < square.first_point + square.point_count; ++i) {
        const glm::vec2 away = glm::abs(tables.points[i] - square.middle);
        EXPECT_LT(away.x, 5.0f);
        EXPECT_LT(away.y, 4.5f);
        const glm::vec2 of_pillar = glm::abs(tables.points[i] - (square.middle + glm::vec2(0.0f, 0.5f)));
        EXPECT_TRUE(of_pillar.x > 1.2f || of_pillar.y > 1.2f);
    }
}

TEST(BehaviourTables, AreEmptyWithoutBehaviours) {
    const Scene scene = built(R"({"throng": 1, "formations": [{"id": "two", "type": "agents", "agents": [
        {"position": [0, 0], "goal": [5, 0]}]}]})");
    EXPECT_TRUE(scene.behaviours.empty());
    EXPECT_TRUE(scene.behaviours.minds.empty());
}

TEST(BehaviourTables, PlacesThatNobodyCanWalkToAreErrors) {
    Diagnostics diagnostics;
    const std::optional<Layout> layout = readLayout(R"({"throng": 1,
 "areas": [{"id": "in", "polygon": [[0, 0], [4, 0], [4, 4], [0, 4]]},
  {"id": "cell", "polygon": [[20, 0], [24, 0], [24, 4], [20, 4]]}],
 "walls": [{"points": [[19, -1], [25, -1], [25, 5], [19, 5], [19, -1]]}],
 "behaviours": [{"id": "b", "start": "a", "states": {"a": {"gather": "cell", "for_good": true}}}],
 "flows": [{"id": "people", "from": "in", "behaviour": "b", "count": 4}]})",
                                                    {}, diagnostics);
    ASSERT_TRUE(layout);
    EXPECT_FALSE(buildScene(*layout, diagnostics));
    ASSERT_GE(diagnostics.entries.size(), 1u);  // and then nobody can enter either
    EXPECT_EQ(diagnostics.entries[0].message, "flow `people`: nobody can walk from `in` to `cell`");
    EXPECT_EQ(diagnostics.entries[0].where.line, 5);
}

}  // namespace
}  // namespace throng::authoring
