// SPDX-License-Identifier: Apache-2.0
#include "authoring/layout/plan.h"

#include <gtest/gtest.h>

#include "authoring/layout/layout_reader.h"

namespace throng::authoring {
namespace {

using Does = BehaviourState::Does;

Layout readPlan(std::string_view flow, std::string_view events) {
    const std::string text = R"({"throng": 1, "simulation": {"duration": 60},
 "areas": [{"id": "a", "polygon": [[0, 0], [9, 0], [9, 9], [0, 9]]},
           {"id": "b", "polygon": [[20, 0], [29, 0], [29, 9], [20, 9]]},
           {"id": "c", "polygon": [[40, 0], [49, 0], [49, 9], [40, 9]]}],
 "flows": [)" + std::string(flow) +
                             R"(, {"id": "others", "from": "c", "to": "a", "count": 1}],
 "events": [)" + std::string(events) +
                             "]}";
    Diagnostics diagnostics;
    std::optional<Layout> layout = readLayout(text, {}, diagnostics);
    for (const Diagnostic& entry : diagnostics.entries)
        if (entry.severity == Severity::error) ADD_FAILURE() << formatDiagnostic(entry, "plan.json", text);
    return layout.value_or(Layout{});
}

TEST(Plan, IsAStateForEachStopAndOneForTheGoal) {
    const Layout layout = readPlan(R"({"id": "f", "from": "a", "to": "c", "count": 9, "arrival": "stay",
   "via": ["b", {"at": "b", "wait": 4}, {"at": "c", "wait": 5, "activity": "look", "facing": [1, 2]},
           {"at": "b", "wait": 6, "activity": "queue", "line": [[21, 1], [28, 1]]}]})",
                                   "");
    const Behaviour plan = planOf(layout, layout.flows.at(0));
    ASSERT_EQ(plan.states.size(), 5u);
    const std::vector<Does> does = {Does::walk, Does::gather, Does::gather, Does::queue, Does::walk};
    const std::vector<ActivityCode> activities = {ActivityCode::stands, ActivityCode::stands,
                                                  ActivityCode::looks, ActivityCode::queues,
                                                  ActivityCode::stands};
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(plan.states[i].does, does[i]) << i;
        EXPECT_EQ(plan.states[i].activity, activities[i]) << i;
        EXPECT_EQ(plan.states[i].then, i < 4 ? std::optional(i + 1) : std::nullopt) << i;
        EXPECT_EQ(plan.states[i].for_good, i == 4) << i;
        EXPECT_TRUE(plan.states[i].until.empty()) << i;
    }
    EXPECT_FALSE(plan.states[0].lasts);
    EXPECT_EQ(plan.states[3].lasts->mean, 6.0);
    EXPECT_EQ(plan.states[3].line.size(), 2u);
    EXPECT_EQ(wayFrom(plan, 0).size(), 5u);
    EXPECT_EQ(wayFrom(plan, 3).size(), 2u);
    EXPECT_TRUE(turnsOf(plan).empty());
}

TEST(Plan, LeadsToWhereEventsSendPeople) {
    const Layout layout = readPlan(R"({"id": "f", "from": "a", "via": ["b"], "to": "c", "rate": 1})",
                                   R"({"at": 20, "go_to": "b", "who": ["f"], "arrival": "stay"},
   {"at": 10, "go_to": "a"}, {"at": 5, "go_to": "a", "who": ["others"]}, {"at": 7, "flow": "f", "rate": 1})");
    const Behaviour plan = planOf(layout, layout.flows.at(0));
    ASSERT_EQ(plan.states.size(), 4u);  // one stop, the goal, and two of the four events
    const std::vector<Turn> turns = turnsOf(plan);
    ASSERT_EQ(turns.size(), 2u);
    EXPECT_EQ(turns[0].at, 10.0);
    EXPECT_EQ(turns[1].at, 20.0);
    EXPECT_FALSE(plan.states[turns[0].then].for_good);
    EXPECT_TRUE(plan.states[turns[1].then].for_good);
    EXPECT_EQ(plan.states[1].until.size(), 2u) << "the goal, too, is left";
    EXPECT_EQ(plan.states[turns[0].then].until.size(), 1u) << "who was sent is sent again";
    EXPECT_TRUE(plan.states[turns[1].then].until.empty());
    EXPECT_EQ(wayFrom(plan, turns[0].then).size(), 1u);
}

TEST(Plan, OfAFormationWithoutAGoalStaysWhereItIs) {
    Layout layout =
        readPlan(R"({"id": "f", "from": "a", "to": "c", "count": 9})", R"({"at": 10, "go_to": "a"})");
    Formation formation;
    formation.id = "row";
    formation.shape = ListFormation{};
    const Behaviour plan = planOf(layout, formation);
    ASSERT_EQ(plan.states.size(), 2u);
    EXPECT_EQ(plan.states[0].does, Does::stay);
    EXPECT_TRUE(plan.states[0].to.places.empty());
    EXPECT_EQ(turnsOf(plan).size(), 1u);
}

}  // namespace
}  // namespace throng::authoring
