// SPDX-License-Identifier: Apache-2.0
// Who walks with whom, where to, and what events make of it.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <set>

#include "authoring/layout/layout_reader.h"
#include "authoring/scene/scene_builder.h"

namespace throng::authoring {
namespace {

const std::string kPlaces = R"({"throng": 1, "simulation": {"duration": 100},
 "areas": [{"id": "a", "polygon": [[0,0],[4,0],[4,30],[0,30]]}, {"id": "b", "polygon": [[40,0],[44,0],[44,12],[40,12]]},
           {"id": "c", "polygon": [[40,18],[44,18],[44,30],[40,30]]}],
)";

Scene sceneOf(const std::string& rest) {
    Diagnostics diagnostics;
    const auto layout = readLayout(kPlaces + rest, {}, diagnostics);
    std::optional<Scene> scene;
    if (layout) scene = buildScene(*layout, diagnostics);
    for (const Diagnostic& entry : diagnostics.entries)
        ADD_FAILURE() << entry.message;
    return scene.value_or(Scene{});
}

TEST(Bodies, AreThoseOfEverybodysProfileUnlessToldOtherwise) {
    const auto people = [](const std::string& who) {
        return sceneOf(R"("flows": [{"id": "f", "from": "a", "to": "b", "count": 63)" + who + "}]}").people;
    };
    const std::vector<gpu::Person> nothing_said = people("");
    const std::vector<gpu::Person> adults = people(R"(, "people": {"profile": "adult", "body": "adult"})");
    const std::vector<gpu::Person> unsaid = people(R"(, "people": {"profile": "child"})");
    const std::vector<gpu::Person> children =
        people(R"(, "people": {"profile": "child", "body": "profile"})");
    ASSERT_EQ(nothing_said.size(), 63u);
    for (std::size_t i = 0; i < nothing_said.size(); ++i) {
        EXPECT_GT(nothing_said[i].half_axis, 0.0f);
        EXPECT_EQ(nothing_said[i].half_axis, adults[i].half_axis);
        EXPECT_EQ(nothing_said[i].radius, adults[i].radius);
        EXPECT_GT(unsaid[i].half_axis, 0.0f);
        EXPECT_EQ(unsaid[i].half_axis, children[i].half_axis);
        EXPECT_LT(unsaid[i].half_axis + unsaid[i].radius, adults[i].half_axis + adults[i].radius);
    }
}

TEST(Bodies, AreDiscsWhereARadiusIsGivenOrThatIsSaid) {
    const auto people = [](const std::string& who) {
        return sceneOf(R"("flows": [{"id": "f", "from": "a", "to": "b", "count": 63, "people": {)" + who +
                       "}}]}")
            .people;
    };
    const std::vector<gpu::Person> said = people(R"("profile": "child", "body": "disc")");
    const std::vector<gpu::Person> given = people(R"("radius": 0.31)");
    const std::vector<gpu::Person> both = people(R"("body": "disc", "radius": 0.31)");
    ASSERT_EQ(said.size(), 63u);
    for (std::size_t i = 0; i < said.size(); ++i) {
        EXPECT_EQ(said[i].half_axis, 0.0f);
        EXPECT_EQ(given[i].half_axis, 0.0f);
        EXPECT_EQ(both[i].half_axis, 0.0f);
        EXPECT_TRUE(said[i].radius >= 0.15f && said[i].radius <= 0.2f);
        EXPECT_EQ(given[i].radius, 0.31f);
        EXPECT_EQ(both[i].radius, 0.31f);
    }
}

TEST(Bodies, AreNotGivenBesideARadius) {
    Diagnostics diagnostics;
    readLayout(kPlaces + R"("flows": [{"id": "f", "from": "a", "to": "b", "count": 1,
 "people": {"radius": 0.2, "body": "adult"}}]})",
               {}, diagnostics);
    ASSERT_EQ(diagnostics.entries.size(), 1u);
    EXPECT_NE(diagnostics.entries.front().message.find("not both"), std::string::npos);
}

TEST(Parties, HaveTheObservedSizes) {
    const Scene scene = sceneOf(
        R"("flows": [{"id": "f", "from": "a", "to": "b", "count": 20000, "people": {"groups": "leisure"}}]})");
    std::map<std::uint32_t, double> parties;
    double all = 0.0;
    for (std::uint32_t row = 0; row < scene.people.size(); row += scene.people[row].party_size) {
        ASSERT_EQ(scene.people[row].party_first, row);
        ++parties[scene.people[row].party_size];
        ++all;
    }
    // P(n) is proportional to 1.11^n / n!, up to four.
    const double weights[] = {1.11, 1.11 * 1.11 / 2, 1.11 * 1.11 * 1.11 / 6, 1.11 * 1.11 * 1.11 * 1.11 / 24};
    const double sum = weights[0] + weights[1] + weights[2] + weights[3];
    for (std::uint32_t size = 1; size <= 4; ++size)
        EXPECT_NEAR(parties[size] / all, weights[size - 1] / sum, 0.015) << size;
}

TEST(Parties, ComeTogetherAtOneSpeedAndGoToOnePlace) {
    const Scene scene = sceneOf(
        R"("flows": [{"id": "f", "from": "a", "to": {"choose": {"b": 3, "c": 1}}, "rate": 20,
 "people": {"groups": [0, 1, 1, 1]}}]})");
    double to_b = 0.0;
    for (const gpu::Person& person : scene.people) {
        const gpu::Person& first = scene.people[person.party_first];
        EXPECT_EQ(person.spawn_time, first.spawn_time);
        EXPECT_EQ(person.preferred_speed, first.preferred_speed);
        EXPECT_GE(person.maximum_speed, person.preferred_speed);
        EXPECT_EQ(scene.stages[person.first_stage].field, scene.stages[first.first_stage].field);
        to_b += scene.stages[person.first_stage].field == scene.stages[scene.people[0].first_stage].field;
    }
    const double share = to_b / static_cast<double>(scene.people.size());
    EXPECT_NEAR(std::min(share, 1.0 - share), 0.25, 0.06);
}

TEST(Parties, AreSlowerThanTheirMembersAlone) {
    const auto mean = [](const std::string& groups) {
        const Scene scene =
            sceneOf(R"("flows": [{"id": "f", "from": "a", "to": "b", "count": 6000, "people": {"groups": )" +
                    groups + "}}]}");
        double sum = 0.0;
        for (const gpu::Person& person : scene.people)
            sum += person.preferred_speed;
        return sum / static_cast<double>(scene.people.size());
    };
    const double alone = mean("[1]");
    EXPECT_NEAR(alone - mean("[0, 1]"), 0.04, 0.02);
    EXPECT_NEAR(alone - mean("[0, 0, 0, 1]"), 0.12, 0.03);
}

TEST(Destinations, TheNearestOfSeveralIsOneField) {
    const Scene scene =
        sceneOf(R"("flows": [{"id": "f", "from": "a", "to": {"nearest": ["b", "c"]}, "count": 5}]})");
    EXPECT_EQ(scene.field_count, 1u);
    const auto distanceAt = [&](glm::dvec2 world) {
        const glm::vec2 at = (glm::vec2(world - scene.origin) - scene.grid.minimum) / scene.grid.cell_size;
        return (*scene.fields.fields.front())[static_cast<std::uint32_t>(at.y) * scene.grid.width +
                                              static_cast<std::uint32_t>(at.x)]
            .distance;
    };
    EXPECT_NEAR(distanceAt({30, 6}), 10.0f, 0.3f);
    EXPECT_NEAR(distanceAt({30, 24}), 10.0f, 0.3f);
}

TEST(Stops, EverybodyHasASpotAndAWaitOfTheirOwn) {
    const Scene scene = sceneOf(
        R"("flows": [{"id": "f", "from": "a", "to": "c", "count": 40,
 "via": [{"at": "b", "wait": {"uniform": [5, 9]}}]}]})");
    std::set<std::pair<float, float>> spots;
    double least = 100.0, most = 0.0;
    for (const gpu::Person& person : scene.people) {
        ASSERT_EQ(person.stage_count, 2u);
        const gpu::Stage& stop = scene.stages[person.first_stage];
        const glm::dvec2 at = scene.origin + glm::dvec2(stop.point);
        EXPECT_TRUE(at.x > 40 && at.x < 44 && at.y > 0 && at.y < 12);
        spots.insert({stop.point.x, stop.point.y});
        least = std::min(least, double{stop.dwell});
        most = std::max(most, double{stop.dwell});
    }
    EXPECT_EQ(spots.size(), 40u);
    EXPECT_TRUE(least >= 5.0 && least < 6.0 && most > 8.0 && most <= 9.0) << least << " to " << most;
}

TEST(Events, ChangeARate) {
    const Scene scene = sceneOf(
        R"("flows": [{"id": "f", "from": "a", "to": "b", "rate": 40}],
 "events": [{"at": 20, "flow": "f", "rate": 0}, {"at": 50, "flow": "f", "rate": 10}]})");
    double early = 0, none = 0, late = 0;
    for (const gpu::Person& person : scene.people)
        (person.spawn_time < 20 ? early : person.spawn_time < 50 ? none : late)++;
    EXPECT_NEAR(early, 800, 90);
    EXPECT_EQ(none, 0);
    EXPECT_NEAR(late, 500, 70);
}

TEST(Events, SendPeopleAwayWithinTheirReactions) {
    const Scene scene = sceneOf(
        R"("flows": [{"id": "f", "from": "a", "to": "b", "rate": 5,
 "people": {"reaction": {"log_normal": [1, 0.5], "max": 20}}},
 {"id": "later", "from": "a", "to": "b", "start": 60, "count": 7}],
 "events": [{"at": 50, "go_to": {"nearest": ["a", "c"]}}]})");
    double sum_of_logarithms = 0.0;
    std::size_t changed = 0;
    for (const gpu::Person& person : scene.people) {
        if (person.group == 1) {
            EXPECT_GE(person.spawn_time, 60.0f);
            continue;
        }
        EXPECT_LT(person.spawn_time, 50.0f) << "came in after everybody was sent away";
        ASSERT_EQ(person.change_count, 1u);
        const double reaction = scene.plan_changes[person.first_change].start_step / 48.0 - 50.0;
        ASSERT_TRUE(reaction >= 0.0 && reaction <= 20.1) << reaction;
        sum_of_logarithms += std::log(reaction);
        ++changed;
    }
    EXPECT_GT(changed, 150u);
    EXPECT_NEAR(sum_of_logarithms / static_cast<double>(changed), 1.0, 0.12);
}

TEST(Gates, DoNotStandInTheWayOfRoutes) {
    const std::string walls =
        R"("walls": [{"points": [[20,-40],[20,10]]}, {"id": "gate", "points": [[20,10],[20,20]]},
 {"points": [[20,20],[20,70]]},
 {"points": [[-20,-40],[60,-40],[60,70],[-20,70],[-20,-40]]}],
 "flows": [{"id": "f", "from": "a", "to": "b", "count": 5}])";
    const Scene scene =
        sceneOf(walls + R"(, "events": [{"at": 5, "open": "gate"}, {"at": 9, "close": "gate"}]})");
    EXPECT_TRUE(scene.open_at_start.empty());
    ASSERT_EQ(scene.gate_moves.size(), 2u);
    EXPECT_TRUE(scene.gate_moves[0].opens);
    EXPECT_FALSE(scene.gate_moves[1].opens);
    Diagnostics diagnostics;
    const auto shut = readLayout(kPlaces + walls + "}", {}, diagnostics);
    ASSERT_TRUE(shut);
    EXPECT_FALSE(buildScene(*shut, diagnostics)) << "without an event, it is a wall";
}

TEST(Stops, LinesHaveToLieInTheirArea) {
    Diagnostics diagnostics;
    const auto layout = readLayout(kPlaces +
                                       R"("flows": [{"id": "f", "from": "a", "to": "c", "count": 4,
 "via": [{"at": "b", "wait": 2, "activity": "queue", "line": [[42, 2], [30, 2]]}]}]})",
                                   {}, diagnostics);
    ASSERT_TRUE(layout);
    EXPECT_FALSE(buildScene(*layout, diagnostics));
    ASSERT_FALSE(diagnostics.entries.empty());
    EXPECT_NE(diagnostics.entries[0].message.find("leaves its area at [30, 2]"), std::string::npos)
        << diagnostics.entries[0].message;
}

}  // namespace
}  // namespace throng::authoring
