// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "authoring/overrides/overrides_reader.h"

namespace throng::authoring {
namespace {

constexpr const char* kPerson = R"({"id": 3, "group": "f", "spawn": {"frame": 7, "position": [1, 2, 0]}})";

/// A file with one layer, of which the selector stands in line 2 and what is done in line 3.
std::string fileWith(const std::string& who, const std::string& what = R"({"hide": true})") {
    return "{\"throng_overrides\": 1, \"overrides\": [], \"layers\": [{\"name\": \"a\", \"who\":\n" + who +
           ", \"do\":\n" + what + "}]}";
}

/// One error in that place, with words in the message and the hint.
void expectMistake(const std::string& text, int line, int column, const std::string& pointer,
                   const std::string& message, const std::string& hint = "") {
    Diagnostics diagnostics;
    EXPECT_FALSE(readOverrides(text, diagnostics)) << text;
    ASSERT_EQ(diagnostics.entries.size(), 1u)
        << text << (diagnostics.entries.empty() ? "" : diagnostics.entries.back().message);
    const Diagnostic& found = diagnostics.entries.front();
    EXPECT_EQ(found.where.line, line) << text;
    EXPECT_EQ(found.where.column, column) << text;
    EXPECT_EQ(found.where.pointer(), pointer) << text;
    EXPECT_NE(found.message.find(message), std::string::npos) << found.message;
    EXPECT_NE(found.hint.find(hint), std::string::npos) << found.hint;
}

Layer only(const std::string& text) {
    Diagnostics diagnostics;
    const auto file = readOverrides(text, diagnostics);
    EXPECT_TRUE(diagnostics.entries.empty()) << text;
    return file && !file->layers.empty() ? file->layers.front() : Layer{};
}

TEST(LayersReader, ReadsSelectorsAndWhatIsDone) {
    const Layer layer = only(
        fileWith(R"({"group": ["f", "g"], "share": {"of": 0.25, "seed": 3}, "not": {"rows": [2, 5]}})",
                 R"({"hide": {"frames": [3, 9]}, "move": {"turn": 30, "about": [1, 2]}, "tint": "#a01020",
             "clip": {"activity": "queues"}, "look_at": {"point": [0, 0, 2], "ease": 6},
             "duplicate": {"copies": 3, "by": [0, 1, 0], "offset": 5},
             "bend": {"points": [{"way": 3, "by": [0, 1]}, {"way": 6, "by": [0, -1]}], "falloff": 4}})"));
    EXPECT_EQ(layer.name, "a");
    EXPECT_TRUE(layer.enabled);
    const auto& all = std::get<Combined>(layer.who.what);
    EXPECT_EQ(all.by, Combined::By::all);
    ASSERT_EQ(all.parts.size(), 3u);
    EXPECT_EQ(std::get<Named>(all.parts[0].what).names, (std::vector<std::string>{"f", "g"}));
    EXPECT_EQ(std::get<Share>(all.parts[1].what).of, 0.25);
    EXPECT_EQ(std::get<Share>(all.parts[1].what).seed, 3u);
    const auto& none = std::get<Combined>(all.parts[2].what);
    EXPECT_EQ(none.by, Combined::By::none);
    EXPECT_EQ(std::get<Rows>(none.parts.at(0).what).last, 5u);
    const Operations& operations = layer.operations;
    EXPECT_EQ(operations.hidden->last, 9u);
    EXPECT_FALSE(operations.change.hide);
    EXPECT_EQ(operations.about, glm::dvec2(1.0, 2.0));
    EXPECT_EQ(operations.clip->activity, ClipActivity::queues);
    EXPECT_EQ(operations.look_at->ease, 6.0);
    EXPECT_EQ(operations.duplicate->copies, 3u);
    EXPECT_EQ(operations.duplicate->each.delay, 5.0);
    EXPECT_TRUE(operations.bend->by_way);
    EXPECT_EQ(operations.bend->points.at(1).by, glm::dvec2(0.0, -1.0));
    EXPECT_EQ(operationWords(operations),
              (std::vector<std::string>{"tint", "move", "hide", "bend", "clip", "look_at", "duplicate"}));
}

TEST(LayersReader, SaysWhereAMistakeInASelectorIs) {
    const std::string who = "/layers/0/who";
    expectMistake(fileWith("{}"), 2, 1, who, "without keys", "\"everybody\": true");
    expectMistake(fileWith(R"({"grop": "f"})"), 2, 2, who + "/grop", "no key `grop`",
                  "did you mean `group`?");
    expectMistake(fileWith(R"({"group": 3})"), 2, 11, who + "/group", "expected a name", "[\"a\", \"b\"]");
    expectMistake(fileWith(R"({"everybody": false})"), 2, 15, who + "/everybody", "can only be true", "not");
    expectMistake(fileWith(R"({"rows": [5, 2]})"), 2, 10, who + "/rows", "5 comes after 2", "[2, 5]");
    expectMistake(fileWith(R"({"party": [0, 2]})"), 2, 12, who + "/party/0", "out of range");
    expectMistake(fileWith(R"({"share": {"seed": 2}})"), 2, 11, who + "/share", "needs `of`");
    expectMistake(fileWith(R"({"share": {"of": 1.5}})"), 2, 18, who + "/share/of", "out of range");
    expectMistake(fileWith(R"({"region": {"polygon": [[0, 0], [1, 1]]}})"), 2, 24, who + "/region/polygon",
                  "at least 3 points");
    expectMistake(fileWith(R"({"region": {"polygon": [[0, 0], [1, 1], [2, 0]], "frames": [3]}})"), 2, 60,
                  who + "/region/frames", "expected [first, last]");
    expectMistake(fileWith(R"({"near": {"within": 2}})"), 2, 10, who + "/near", "of one thing, found 0",
                  "point, wall, who");
    expectMistake(fileWith(R"({"near": {"point": [0, 0], "wall": "w", "within": 2}})"), 2, 10, who + "/near",
                  "found 2");
    expectMistake(fileWith(R"({"or": []})"), 2, 8, who + "/or", "an empty one");
    expectMistake(fileWith(R"({"not": {"or": [{"rows": [0, 1]}, {}]}})"), 2, 35, who + "/not/or/1",
                  "without keys");
    expectMistake(fileWith(R"({"copies": "b"})"), 2, 12, who + "/copies", "no layer `b` before");
    expectMistake(fileWith(R"({"people": [{"id": 3, "group": "f"}]})"), 2, 13, who + "/people/0",
                  "needs `spawn`");
    const std::string view = R"({"seen": {"views": [{"matrix": [1,0,0,0, 0,1,0,0, 0,0,0,0, 0,0,0,1],)";
    expectMistake(fileWith(view + R"( "size": [1, 1]}]}})"), 2, 32, who + "/seen/views/0/matrix",
                  "has no inverse");
}

TEST(LayersReader, SaysWhereAMistakeInWhatIsDoneIs) {
    const std::string all = R"({"everybody": true})", what = "/layers/0/do";
    expectMistake(fileWith(all, R"({"hide": {"from": 3, "frames": [0, 1]}})"), 3, 11, what + "/hide/from",
                  "no key `from`");
    expectMistake(fileWith(all, R"({"hide": {}})"), 3, 10, what + "/hide", "needs `frames`");
    expectMistake(fileWith(all, R"({"hide": 1})"), 3, 10, what + "/hide", "expected true or false");
    expectMistake(fileWith(all, R"({"clip": {"activity": "runs"}})"), 3, 23, what + "/clip/activity",
                  "walks, stands, looks, queues");
    expectMistake(fileWith(all, R"({"look_at": {}})"), 3, 13, what + "/look_at", "one thing to look at");
    expectMistake(
        fileWith(all, std::string(R"({"look_at": {"point": [0, 0, 1], "person": )") + kPerson + "}}"), 3, 13,
        what + "/look_at", "one thing to look at");
    expectMistake(fileWith(all, R"({"duplicate": {"copies": 0}})"), 3, 26, what + "/duplicate/copies",
                  "out of range");
    const auto bend = [&](const std::string& points) {
        return fileWith(all, R"({"bend": {"points": [)" + points + "]}}");
    };
    expectMistake(bend(""), 3, 21, what + "/bend/points", "1 to 1000");
    expectMistake(bend(R"({"by": [0, 1]})"), 3, 22, what + "/bend/points/0",
                  "at a frame, or at so many metres");
    expectMistake(bend(R"({"frame": 9, "by": [0, 1]}, {"frame": 9, "by": [0, 2]})"), 3, 50,
                  what + "/bend/points/1", "9 comes after 9");
    expectMistake(bend(R"({"frame": 1, "by": [0, 1]}, {"way": 9, "by": [0, 2]})"), 3, 50,
                  what + "/bend/points/1", "all at frames, or all at metres");
    expectMistake(
        "{\"throng_overrides\": 1, \"overrides\": [], \"layers\": [\n"
        "{\"name\": \"a\", \"who\": {\"rows\": [0, 1]}, \"do\": {\"hide\": true}},\n"
        "{\"name\": \"a\", \"who\": {\"rows\": [0, 1]}, \"do\": {\"hide\": true}}]}",
        3, 10, "/layers/1/name", "a layer `a` in line 2 already");
    expectMistake("{\"throng_overrides\": 1, \"overrides\": [],\n \"layers\": {}}", 2, 12, "/layers",
                  "expected an array of layers");
}

TEST(LayersReader, WarnsOfLayersThatChangeNothing) {
    Diagnostics diagnostics;
    EXPECT_TRUE(readOverrides(fileWith(R"({"everybody": true})", R"({"hide": false})"), diagnostics));
    ASSERT_EQ(diagnostics.entries.size(), 1u);
    EXPECT_EQ(diagnostics.entries[0].severity, Severity::warning);
    EXPECT_NE(diagnostics.entries[0].message.find("layer `a` changes nothing"), std::string::npos);
}

}  // namespace
}  // namespace throng::authoring
