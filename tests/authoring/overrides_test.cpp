// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "authoring/overrides/matching.h"
#include "authoring/overrides/overrides_reader.h"

namespace throng::authoring {
namespace {

constexpr const char* kPerson =
    R"("id": 3, "group": "f", "spawn": {"frame": 7, "position": [1.5, -2, 0.25]})";

std::string fileWith(const std::string& entries) {
    return "{\"throng_overrides\": 1, \"overrides\": [\n" + entries + "\n]}";
}

std::string entryWith(const std::string& change) {
    return std::string("{") + kPerson + (change.empty() ? "" : ", ") + change + "}";
}

/// An error in that place, with words in the message and the hint.
void expectMistake(const std::string& text, int line, int column, const std::string& pointer,
                   const std::string& message, const std::string& hint = "") {
    Diagnostics diagnostics;
    EXPECT_FALSE(readOverrides(text, diagnostics)) << text;
    ASSERT_EQ(diagnostics.entries.size(), 1u) << text;
    const Diagnostic& found = diagnostics.entries.front();
    EXPECT_EQ(found.where.line, line) << text;
    EXPECT_EQ(found.where.column, column) << text;
    EXPECT_EQ(found.where.pointer(), pointer);
    EXPECT_NE(found.message.find(message), std::string::npos) << found.message;
    EXPECT_NE(found.hint.find(hint), std::string::npos) << found.hint;
}

TEST(OverridesReader, ReadsEveryKindOfChange) {
    Diagnostics diagnostics;
    const auto read = readOverrides(
        fileWith(
            entryWith(
                R"("hide": true, "character": 5, "tint": [0.25, 0.5, 1], "scale": 1.25, "note": "seen in dailies")") +
            R"(, {"id": 4, "group": "g", "spawn": {"frame": 0, "position": [0, 0, 0]}, "tint": "#A01020",
                      "move": {"by": [1, 2, 3], "turn": -90}, "retime": {"offset": -12.5, "speed": 1.5},
                      "hero": "Anna"})"),
        diagnostics);
    ASSERT_TRUE(read);
    EXPECT_TRUE(diagnostics.entries.empty());
    ASSERT_EQ(read->people.size(), 2u);
    const Override& one = read->people[0];
    EXPECT_EQ(one.id, 3u);
    EXPECT_EQ(one.group, "f");
    EXPECT_EQ(one.spawn_frame, 7u);
    EXPECT_EQ(one.spawn_place, glm::dvec3(1.5, -2.0, 0.25));
    EXPECT_EQ(changeWords(one.change), (std::vector<std::string>{"hide", "character", "tint", "scale"}));
    EXPECT_EQ(one.change.tint->text, "0.25 0.5 1");
    EXPECT_FALSE(one.change.tint->colour);
    const PersonChange& two = read->people[1].change;
    EXPECT_EQ(two.tint->colour, 0xa01020u);
    EXPECT_EQ(two.tint->text, "#a01020");
    EXPECT_EQ(two.move, glm::dvec3(1.0, 2.0, 3.0));
    EXPECT_EQ(two.turn, -90.0);
    EXPECT_EQ(two.delay, -12.5);
    EXPECT_EQ(two.speed, 1.5);
    EXPECT_EQ(changeWords(two), (std::vector<std::string>{"tint", "move", "retime", "hero"}));
    EXPECT_TRUE(two.hides());
}

TEST(OverridesReader, SaysWhereAMistakeIsAndHowToMendIt) {
    expectMistake("{\"throng_overrides\": 2, \"overrides\": []}", 1, 22, "/throng_overrides", "version 1",
                  "\"throng_overrides\": 1");
    expectMistake("{\"throng_overrides\": 1,\n \"overrides\": {}}", 2, 15, "/overrides", "expected an array");
    expectMistake(fileWith(entryWith("\"hidden\": true")), 2, 77, "/overrides/0/hidden", "no key `hidden`",
                  "did you mean `hide`?");
    expectMistake(fileWith(entryWith("\"scale\": 11")), 2, 86, "/overrides/0/scale", "out of range");
    expectMistake(fileWith(entryWith("\"tint\": \"red\"")), 2, 85, "/overrides/0/tint",
                  "`red` is not a colour", "#a01020");
    expectMistake(fileWith(entryWith("\"tint\": \"#12 456\"")), 2, 85, "/overrides/0/tint",
                  "is not a colour");
    expectMistake(fileWith(entryWith("\"tint\": \"\"")), 2, 85, "/overrides/0/tint", "is not a colour");
    expectMistake(fileWith(entryWith("\"tint\": [0, 1]")), 2, 85, "/overrides/0/tint", "found an array of 2");
    expectMistake(fileWith(entryWith("\"move\": {\"by\": [0, 0]}")), 2, 92, "/overrides/0/move/by",
                  "found an array of 2");
    expectMistake(fileWith(entryWith("\"retime\": {\"speed\": 0}")), 2, 97, "/overrides/0/retime/speed",
                  "out of range");
    expectMistake(fileWith(entryWith("\"character\": 1.5")), 2, 90, "/overrides/0/character", "whole number");
    expectMistake(fileWith(entryWith("\"hero\": \"\"")), 2, 85, "/overrides/0/hero", "empty");
    expectMistake(fileWith(R"({"id": 1, "group": "f", "hide": true})"), 2, 1, "/overrides/0",
                  "needs `spawn`");
    expectMistake(fileWith(entryWith("\"hide\": true") + ",\n" + entryWith("\"scale\": 2")), 3, 8,
                  "/overrides/1/id", "in line 2 already", "into one");
    expectMistake("{\"throng_overrides\": 1, \"overrides\": [}", 1, 39, "", "syntax error");
}

TEST(OverridesReader, WarnsOfEntriesThatChangeNothing) {
    Diagnostics diagnostics;
    EXPECT_TRUE(readOverrides(fileWith(entryWith("\"move\": {}")), diagnostics));
    ASSERT_EQ(diagnostics.entries.size(), 1u);
    EXPECT_EQ(diagnostics.entries[0].severity, Severity::warning);
    EXPECT_NE(diagnostics.entries[0].message.find("person 3 changes nothing"), std::string::npos);
}

TEST(OverrideMatching, GivesTheAnswersThatTheAddOnGives) {
    std::ifstream file(THRONG_SHARED_TESTS "/override_matching.json");
    const nlohmann::json cases = nlohmann::json::parse(file).at("cases");
    ASSERT_GE(cases.size(), 10u);
    for (const auto& each : cases) {
        std::vector<Entrant> people;
        for (const auto& person : each["people"])
            people.push_back({person[0],
                              !person[1].is_null(),
                              person[1].is_null() ? 0u : person[1].get<unsigned>(),
                              {person[2], person[3], person[4]}});
        std::vector<Override> overrides;
        for (const auto& entry : each["overrides"]) {
            Override made;
            made.id = entry[0];
            made.group = entry[1];
            made.spawn_frame = entry[2];
            made.spawn_place = {entry[3], entry[4], entry[5]};
            overrides.push_back(made);
        }
        nlohmann::json answers = nlohmann::json::array();
        for (const Match& match : matchOverrides(overrides, people)) {
            if (match.kind == Match::Kind::orphaned)
                answers.push_back({"orphaned", nullptr});
            else
                answers.push_back({match.kind == Match::Kind::sure ? "sure" : "nearest", match.row});
        }
        EXPECT_EQ(answers, each["answers"]) << each["name"];
    }
}

}  // namespace
}  // namespace throng::authoring
