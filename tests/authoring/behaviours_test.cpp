// SPDX-License-Identifier: Apache-2.0
// Behaviours as layouts write them, and what is wrong with them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "authoring/layout/layout_reader.h"

namespace throng::authoring {
namespace {

/// A layout whose one flow has the behaviour with these states, which begin in `a`. States begin on line 6.
std::string withStates(const std::string& states) {
    return R"({"throng": 1, "simulation": {"duration": 30},
 "areas": [{"id": "in", "polygon": [[0, 0], [4, 0], [4, 4], [0, 4]]},
  {"id": "square", "polygon": [[10, 0], [20, 0], [20, 9], [10, 9]], "facing": [15, 12]}],
 "walls": [{"id": "doors", "points": [[30, 0], [30, 4]]}, {"id": "fence", "points": [[30, 6], [30, 8]]}],
 "behaviours": [{"id": "b", "start": "a", "states": {
)" + states +
           R"(
 }}],
 "flows": [{"id": "people", "from": "in", "behaviour": "b", "count": 4}],
 "events": [{"at": 5, "open": "doors"}]})";
}

Layout read(const std::string& text) {
    Diagnostics diagnostics;
    const std::optional<Layout> layout = readLayout(text, {}, diagnostics);
    for (const Diagnostic& entry : diagnostics.entries)
        ADD_FAILURE() << formatDiagnostic(entry, "lay.json", text);
    return layout.value_or(Layout{});
}

/// What is said of a layout, with its lines.
std::string told(const std::string& text) {
    Diagnostics diagnostics;
    readLayout(text, {}, diagnostics);
    std::string all;
    for (const Diagnostic& entry : diagnostics.entries)
        all += fmt::format("{}{}: {} ({})\n", entry.severity == Severity::error ? "" : "warning ",
                           entry.where.line, entry.message, entry.hint);
    return all;
}

void expectTold(const std::string& states, const std::string& words) {
    const std::string said = told(withStates(states));
    EXPECT_NE(said.find(words), std::string::npos) << "not `" << words << "`, but\n" << said;
}

const std::string kLeave = R"("leave": {"walk_to": "in"})";

TEST(Behaviours, AreReadAsTheyAreWritten) {
    const Layout layout = read(withStates(R"("a": {"wander": "square", "pace": 0.8, "until": [
   {"after": {"uniform": [5, 9]}, "crowded": 1.5, "then": "shop"},
   {"near": "people", "within": 3, "then": "leave"},
   {"open": "doors", "empty": "square", "of": "people", "then": "leave"}]},
  "shop": {"visit": ["square", "in"], "count": [1, 2], "for": 4, "then": "leave"}, )" +
                                          kLeave));
    ASSERT_EQ(layout.behaviours.size(), 1u);
    const Behaviour& behaviour = layout.behaviours[0];
    EXPECT_EQ(layout.flows.at(0).behaviour, 0u);
    EXPECT_EQ(layout.areas[1].facing, glm::dvec2(15, 12));
    const BehaviourState& a = behaviour.states.at(0);
    EXPECT_EQ(a.does, BehaviourState::Does::wander);
    EXPECT_EQ(a.pace, 0.8);
    ASSERT_EQ(a.until.size(), 3u);
    EXPECT_EQ(a.until[0].conditions.size(), 2u);
    EXPECT_EQ(a.until[0].conditions[0].time.maximum, 9.0);
    EXPECT_EQ(a.until[0].conditions[1].number, 1.5);
    EXPECT_EQ(a.until[0].then, 1u);
    EXPECT_EQ(a.until[1].conditions[0].kind, Condition::Kind::near_people);
    EXPECT_EQ(a.until[1].conditions[0].number, 3.0);
    EXPECT_EQ(a.until[2].conditions[0].kind, Condition::Kind::empty);
    EXPECT_EQ(a.until[2].conditions[0].who.at(0).id, "people");
    EXPECT_EQ(a.until[2].conditions[1].kind, Condition::Kind::open);
    const BehaviourState& shop = behaviour.states.at(1);
    EXPECT_EQ(shop.least, 1u);
    EXPECT_EQ(shop.most, 2u);
    EXPECT_EQ(shop.activity, ActivityCode::looks);
    EXPECT_EQ(shop.then, 2u);
}

/// Where people of a name or a place of a name can be meant, ends of roads are known as areas are, and given
/// people as flows are.
TEST(Behaviours, EndsOfRoadsAndGivenPeopleAreGuessedWhereAnythingIsMeant) {
    const auto with = [](std::string_view states) {
        std::string text = withStates(std::string(states) + ", " + kLeave);
        text.insert(text.find(R"("flows")"), R"("roads": [{"id": "alley", "centreline": [[0, 60], [30, 60]]}],
 "given": [{"id": "parade", "ways": [[[0, 1, 1], [9, 5, 1]]]}], )");
        return told(text);
    };
    for (const auto& [states, words] : {
             std::pair(R"("a": {"flee": "aley:end", "then": "leave"})",
                       "`aley:end` (did you mean `alley:end`?)"),
             std::pair(R"("a": {"flee": "parad", "then": "leave"})", "`parad` (did you mean `parade`?)"),
             std::pair(R"("a": {"follow": "prade", "until": [{"after": 3, "then": "leave"}]})",
                       "`prade` (did you mean `parade`?)"),
             std::pair(R"("a": {"stay": true, "until": [{"near": "ally:start", "then": "leave"}]})",
                       "`ally:start` (did you mean `alley:start`?)"),
             std::pair(R"("a": {"stay": true, "until": [{"near": "parde", "then": "leave"}]})",
                       "`parde` (did you mean `parade`?)"),
             std::pair(
                 R"("a": {"stay": true, "until": [{"empty": "square", "of": "paraed", "then": "leave"}]})",
                 "`paraed` (did you mean `parade`?)"),
             std::pair(R"("a": {"stay": true, "until": [{"near": "elsewhere", "then": "leave"}]})",
                       "(known here: parade, people, in, square, alley:start, alley:end)"),
         })
        EXPECT_NE(with(states).find(words), std::string::npos) << "not `" << words << "`, but\n"
                                                               << with(states);
}

TEST(Behaviours, NamesThatDoNotExistAreToldWithTheNearest) {
    expectTold(R"("a": {"wander": "sqare", "until": [{"after": 3, "then": "leave"}]}, )" + kLeave,
               "6: there is no place `sqare` (did you mean `square`?)");
    expectTold(R"("a": {"wander": "square", "until": [{"after": 3, "then": "leaf"}]}, )" + kLeave,
               "6: there is no state `leaf` (did you mean `leave`?)");
    expectTold(R"("a": {"follow": "peple", "until": [{"after": 3, "then": "leave"}]}, )" + kLeave,
               "6: there is no flow, formation or given people `peple` (did you mean `people`?)");
    expectTold(R"("a": {"stay": true, "until": [{"open": "door", "then": "leave"}]}, )" + kLeave,
               "6: there is no wall `door` (did you mean `doors`?)");
    expectTold(R"("a": {"stay": true, "until": [{"near": "pepole", "then": "leave"}]}, )" + kLeave,
               "6: there is no place, flow, formation or given people `pepole` (did you mean `people`?)");
    expectTold(R"("a": {"flee": "", "then": "leave"}, )" + kLeave, "6: there is no place ``");
    expectTold(R"("a": {"strol": "square"})", "6: the state `a` has no key `strol`");
}

TEST(Behaviours, AGateThatNeverMovesIsNone) {
    expectTold(R"("a": {"stay": true, "until": [{"closed": "fence", "then": "leave"}]}, )" + kLeave,
               "6: wall `fence` never opens or closes");
}

TEST(Behaviours, AGateWhereThereIsNoWallIsAnError) {
    const std::string said =
        told(R"({"throng": 1, "areas": [{"id": "in", "polygon": [[0, 0], [4, 0], [4, 4]]}],
 "behaviours": [{"id": "b", "start": "a", "states": {
  "a": {"stay": true, "until": [{"open": "doors", "then": "a"}]}}}],
 "flows": [{"id": "people", "from": "in", "behaviour": "b", "count": 4}]})");
    EXPECT_EQ(said, "3: there is no wall `doors` (there are none)\n");
}

TEST(Behaviours, SignalsAreThoseOfCrossingsAndLanes) {
    const auto toldOf = [](const std::string& condition) {
        return told(R"({"throng": 1, "areas": [{"id": "in", "polygon": [[0, 0], [4, 0], [4, 4]]}],
 "crossings": [{"id": "zebra", "polygon": [[0, 4], [4, 4], [4, 8], [0, 8]]},
  {"id": "other", "polygon": [[10, 4], [14, 4], [14, 8], [10, 8]]}],
 "lanes": [{"id": "street", "points": [[-20, 6], [20, 6]], "stops": [{"at": [-3, 6], "signal": "lights"}]}],
 "signals": [{"id": "lights", "phases": [{"seconds": 9, "green": ["zebra"]}, {"seconds": 5, "green": ["street"]}]}],
 "behaviours": [{"id": "b", "start": "a", "states": {"a": {"stay": true, "until": [{)" +
                    condition + R"(, "then": "c"}]}, "c": {"stay": true, "for_good": true}}}],
 "flows": [{"id": "people", "from": "in", "behaviour": "b", "count": 4}]})");
    };
    EXPECT_EQ(toldOf(R"("green": "zebra")"), "");
    EXPECT_EQ(toldOf(R"("red": "street")"), "");
    EXPECT_EQ(toldOf(R"("green": "zebr")"),
              "6: there is no crossing or lane `zebr` (did you mean `zebra`?)\n");
    EXPECT_EQ(toldOf(R"("red": "other")"),
              "6: no signal has `other` (name it under `green` in a phase of a signal)\n");
}

TEST(Behaviours, QueuesHaveALineAndServe) {
    const std::string line = R"("a": {"queue": "square", "line": [[1, 1], [3, 1]], )";
    EXPECT_EQ(told(withStates(line + R"("for": 9, "then": "leave"}, )" + kLeave)), "");
    expectTold(R"("a": {"queue": "square", "for": 9, "then": "leave"}, )" + kLeave,
               "6: a queue needs the `line` along which people stand, from its front");
    expectTold(line + R"("then": "leave"}, )" + kLeave, "6: how long is one served?");
    expectTold(line + R"("for": 9}, )" + kLeave, "6: what comes after the state `a`?");
    expectTold(
        R"("a": {"wander": "square", "spacing": 1, "until": [{"after": 3, "then": "leave"}]}, )" + kLeave,
        "6: `spacing` says nothing beside `wander`");
}

TEST(Behaviours, AStateDoesOneThing) {
    expectTold(R"("a": {"stay": true, "wander": "square"})", "this one has several");
    expectTold(R"("a": {"pace": 1})", "this one has none");
    expectTold(R"("a": {"wander": "square", "count": 2, "until": [{"after": 1, "then": "a"}]})",
               "6: `count` says nothing beside `wander` (it belongs to visit)");
    expectTold(R"("a": {"wander": "square", "then": "leave"}, )" + kLeave, "`wander` is never done");
    expectTold(R"("a": {"visit": ["square"], "for": 3})", "what comes after the state `a`?");
    expectTold(R"("a": {"visit": ["square"], "then": "leave"}, )" + kLeave,
               "how long do people stay at each place?");
    expectTold(R"("a": {"visit": ["square"], "count": 2, "for": 3, "then": "leave"}, )" + kLeave,
               "there are only 1 places to visit");
    expectTold(R"("a": {"stay": true, "until": [{"then": "leave"}]}, )" + kLeave,
               "nothing says when this happens");
    expectTold(R"("a": {"gather": "square", "for_good": true, "for": 2, "then": "leave"}, )" + kLeave,
               "who stays for good does not go on");
}

TEST(Behaviours, StatesThatNobodyComesToAreTold) {
    expectTold(R"("a": {"walk_to": "in"},
  "b": {"walk_to": "square"})",
               "warning 7: nothing leads to the state `b` of behaviour `b`");
}

TEST(Behaviours, StatesThatCannotBeLeftAreTold) {
    expectTold(R"("a": {"wander": "square"})", "warning 6: the state `a` of behaviour `b` cannot be left");
    EXPECT_EQ(told(withStates(R"("a": {"gather": "square", "for_good": true})")), "");
    expectTold(R"("a": {"wander": "square", "until": [{"after": 5, "then": "b"}]},
  "b": {"stay": true, "for": 4, "then": "a"})",
               "warning 5: the behaviour `b` has no end");
}

TEST(Behaviours, LoopsWithoutTimeAreTold) {
    expectTold(
        R"("a": {"wander": "square", "until": [{"near": "in", "then": "b"}, {"after": 9, "then": "leave"}]},
  "b": {"stay": true, "until": [{"crowded": 1, "then": "a"}]}, )" +
            kLeave,
        "may lead round without time: `a`, `b`, and `a` again");
    const std::string timed =
        R"("a": {"wander": "square", "until": [{"near": "in", "then": "b"}, {"after": 9, "then": "leave"}]},
  "b": {"stay": true, "until": [{"crowded": 1, "after": 2, "then": "a"}]}, )";
    EXPECT_EQ(told(withStates(timed + kLeave)), "");
    const std::string gate =
        R"("a": {"wander": "square", "until": [{"open": "doors", "then": "b"}, {"after": 9, "then": "leave"}]},
  "b": {"stay": true, "until": [{"closed": "doors", "then": "a"}]}, )";
    EXPECT_EQ(told(withStates(gate + kLeave)), "") << "a gate is not open and closed at once";
}

TEST(Behaviours, StandInPlaceOfGoals) {
    std::string text = withStates(R"("a": {"walk_to": "square"})");
    text.replace(text.find(R"("behaviour": "b")"), 16, R"("behaviour": "b", "to": "square")");
    EXPECT_NE(told(text).find("`to` is said twice"), std::string::npos) << told(text);
    text = withStates(R"("a": {"walk_to": "square"})");
    text.replace(text.find(R"("behaviour": "b")"), 16, R"("behaviour": "bb")");
    EXPECT_NE(told(text).find("there is no behaviour `bb` (did you mean `b`?)"), std::string::npos)
        << told(text);
}

}  // namespace
}  // namespace throng::authoring
