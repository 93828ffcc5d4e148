// SPDX-License-Identifier: Apache-2.0
#include "authoring/layout/layout_reader.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

namespace throng::authoring {
namespace {

Diagnostics diagnose(std::string_view text, const std::vector<std::string>& overrides = {}) {
    Diagnostics diagnostics;
    diagnostics.file = "lay.json";
    readLayout(text, overrides, diagnostics);
    return diagnostics;
}

Layout read(std::string_view text, const std::vector<std::string>& overrides = {}) {
    Diagnostics diagnostics;
    std::optional<Layout> layout = readLayout(text, overrides, diagnostics);
    for (const Diagnostic& entry : diagnostics.entries)
        if (entry.severity == Severity::error) ADD_FAILURE() << formatDiagnostic(entry, "lay.json", text);
    return layout.value_or(Layout{});
}

/// The one error of a text, at a line and column, with words in the message and the hint.
void expectError(std::string_view text, int line, int column, std::string_view pointer,
                 std::string_view message, std::string_view hint = "") {
    const Diagnostics found = diagnose(text);
    ASSERT_GE(found.entries.size(), 1u) << text;
    for (const Diagnostic& entry : found.entries) {
        if (entry.message.find(message) == std::string::npos) continue;
        EXPECT_EQ(entry.where.line, line) << entry.message;
        EXPECT_EQ(entry.where.column, column) << entry.message;
        EXPECT_EQ(entry.where.pointer(), pointer);
        EXPECT_NE(entry.hint.find(hint), std::string::npos) << entry.hint;
        return;
    }
    ADD_FAILURE() << "nothing says `" << message << "`; the first error is: " << found.entries[0].message;
}

const std::string kTwoAreas = R"({"throng": 1,
 "areas": [{"id": "a", "polygon": [[0,0],[4,0],[4,4],[0,4]]},
           {"id": "b", "polygon": [[20,0],[24,0],[24,4],[20,4]]}],
)";

TEST(LayoutReader, FillsInTheDocumentedDefaults) {
    const Layout layout = read(
        R"({"throng": 1, "formations": [{"id": "c", "type": "circle", "centre": [0, 0], "radius": 5, "count": 6}]})");
    const SimulationSettings standard;
    EXPECT_EQ(layout.simulation.fps, standard.fps);
    EXPECT_EQ(layout.simulation.tile_radius, standard.tile_radius);
    EXPECT_EQ(layout.simulation.seed, standard.seed);
    EXPECT_EQ(layout.formations[0].arrival, Arrival::stay);
    EXPECT_EQ(std::get<CircleFormation>(layout.formations[0].shape).count, 6u);
}

TEST(LayoutReader, ReadsWhatIsWritten) {
    const Layout layout =
        read(kTwoAreas + R"("simulation": {"duration": 12.5, "method": "gradient1", "seed": 9007199254740992},
 "walls": [{"points": [[10,-5],[10,5]], "thickness": 0.4, "height": 2}],
 "flows": [{"id": "f", "from": "a", "to": "b", "rate": 2.5, "start": 1,
   "people": {"speed": {"normal": [1.3, 0.2], "min": 1}, "radius": 0.2}}]})");
    EXPECT_EQ(layout.simulation.duration, 12.5);
    EXPECT_EQ(layout.simulation.method, DiagramMethod::gradient1);
    EXPECT_EQ(layout.simulation.seed, 9007199254740992u);
    EXPECT_EQ(layout.walls[0].thickness, 0.4);
    ASSERT_EQ(layout.flows.size(), 1u);
    EXPECT_EQ(layout.flows[0].rate, 2.5);
    EXPECT_EQ(layout.flows[0].end, 12.5);
    EXPECT_EQ(layout.flows[0].people.kinds[0].settings.speed.kind, Distribution::Kind::normal);
    EXPECT_EQ(layout.flows[0].people.kinds[0].settings.speed.minimum, 1.0);
    EXPECT_EQ(layout.flows[0].to.places.at(0).index, 1u);
}

TEST(LayoutReader, ReadsProfilesAndWhatIsWrittenBesideThem) {
    const Layout layout = read(kTwoAreas + R"("flows": [
 {"id": "f", "from": "a", "to": "b", "rate": 1, "people": {"profile": {"adult": 3, "child": 1}, "headway": 0.2}},
 {"id": "g", "from": "a", "to": "b", "rate": 1, "people": {"profile": "runner", "radius": 0.3}}]})");
    ASSERT_EQ(layout.flows[0].people.kinds.size(), 2u);
    EXPECT_EQ(layout.flows[0].people.kinds[0].weight, 3.0);
    EXPECT_EQ(layout.flows[0].people.kinds[1].settings.radius.maximum, 0.2);
    EXPECT_EQ(layout.flows[0].people.kinds[1].settings.headway, 0.2);
    ASSERT_EQ(layout.flows[1].people.kinds.size(), 1u);
    EXPECT_EQ(layout.flows[1].people.kinds[0].settings.speed.mean, 3.2);
    EXPECT_EQ(layout.flows[1].people.largestRadius(), 0.3);
}

TEST(LayoutReader, SaysWhatProfilesThereAre) {
    expectError(
        "{\"throng\": 1, \"formations\": [{\"id\": \"c\", \"type\": \"circle\", \"centre\": [0, 0],\n"
        " \"radius\": 5, \"count\": 6, \"people\": {\"profile\": \"adlut\"}}]}",
        2, 49, "/formations/0/people/profile", "expected one of", "`adult`");
}

TEST(LayoutReader, ReadsWhatPeopleWear) {
    const Layout layout = read(kTwoAreas + R"("flows": [
 {"id": "f", "from": "a", "to": "b", "rate": 1, "people": {"look": "fans", "colours": ["#a01020", "#FFFFFF"]}},
 {"id": "g", "from": "a", "to": "b", "rate": 1, "people": {"profile": {"child": 1, "elderly": 1}}}]})");
    EXPECT_EQ(layout.flows[0].people.look, "fans");
    EXPECT_EQ(layout.flows[0].people.colours, (std::vector<std::string>{"#a01020", "#FFFFFF"}));
    EXPECT_EQ(layout.flows[0].people.kinds[0].profile, "");
    EXPECT_EQ(layout.flows[1].people.look, "casual");
    EXPECT_TRUE(layout.flows[1].people.colours.empty());
    EXPECT_EQ(layout.flows[1].people.kinds[1].profile, "elderly");
}

TEST(LayoutReader, SaysWhatLooksThereAreAndWhatAColourIs) {
    const auto ring = [](const char* people) {
        return fmt::format(R"({{"throng": 1, "formations": [{{"id": "c", "type": "circle", "centre": [0, 0],
 "radius": 5, "count": 6, "people": {}}}]}})",
                           people);
    };
    expectError(ring(R"({"look": "sumer"})"), 2, 46, "/formations/0/people/look", "expected one of casual",
                "did you mean `summer`?");
    expectError(ring(R"({"colours": ["#a01020", "#ffffff"]})"), 2, 49, "/formations/0/people/colours",
                "only fans", "\"look\": \"fans\"");
    expectError(ring(R"({"look": "fans", "colours": ["#a01020"]})"), 2, 65, "/formations/0/people/colours",
                "expected 2 colours");
    expectError(ring(R"({"look": "fans", "colours": ["#a01020", "white"]})"), 2, 77,
                "/formations/0/people/colours/1", "expected a colour, found `white`", "#a01020");
    expectError(ring(R"({"look": "fans", "colours": ["#a0102g", "#ffffff"]})"), 2, 66,
                "/formations/0/people/colours/0", "expected a colour");
}

TEST(LayoutReader, ABarOnFlowNeedsALine) {
    expectError("{\"throng\": 1,\n \"expect\": {\"flow\": {\"min\": 1}}}", 2, 21, "/expect/flow",
                "needs the `line`");
    const Layout layout = read(R"({"throng": 1, "expect": {"line": [[0, -1], [0, 1]], "flow": {"min": 1}},
 "formations": [{"id": "c", "type": "circle", "centre": [0, 0], "radius": 5, "count": 6}]})");
    ASSERT_TRUE(layout.flow_line.has_value());
    EXPECT_EQ(layout.flow_line->b.y, 1.0);
}

TEST(LayoutReader, PointsAtUnknownKeysAndGuessesWhatWasMeant) {
    expectError(
        "{\"throng\": 1,\n \"roads\": [\n  {\"id\": \"r\", \"centreline\": [[0,0],[9,0]], \"widht\": 3}]}", 3,
        44, "/roads/0/widht", "`widht`", "did you mean `width`?");
    expectError("{\"throng\": 1, \"flow\": []}", 1, 15, "/flow", "`flow`", "did you mean `flows`?");
}

TEST(LayoutReader, CountsColumnsInCharactersAndLinesWithEitherEnding) {
    expectError("{\"throng\": 1,\r\n \"name\": \"Grüße 日本\", \"simulatoin\": {}}", 2, 22, "/simulatoin",
                "`simulatoin`", "`simulation`");
}

TEST(LayoutReader, NamesWrongTypesRangesAndMissingKeys) {
    expectError(R"({"throng": 1, "simulation": {"fps": "24"}})", 1, 37, "/simulation/fps",
                "expected a number, found a string");
    expectError(R"({"throng": 1, "simulation": {"fps": 0}})", 1, 37, "/simulation/fps", "out of range");
    expectError(R"({"throng": 1, "simulation": {"substeps": 1.5}})", 1, 42, "/simulation/substeps",
                "whole number");
    expectError(R"({"throng": 1, "roads": [{"id": "r"}]})", 1, 25, "/roads/0", "needs `centreline`");
    expectError(R"({"throng": 1, "roads": {}})", 1, 24, "/roads", "expected an array");
    expectError(R"({"simulation": {}})", 1, 1, "", "needs `throng`");
    expectError(R"({"throng": 2})", 1, 12, "/throng", "version 1");
    expectError(R"({"throng": 1, "simulation": {"method": "gradiant1"}})", 1, 40, "/simulation/method",
                "expected one of", "`gradient1`");
    expectError(R"({"throng": 1, "areas": [{"id": "a", "polygon": [[0,0],[1]]}]})", 1, 55,
                "/areas/0/polygon/1", "expected a point");
}

TEST(LayoutReader, RefusesNumbersThatAreNotFinite) {
    EXPECT_TRUE(diagnose(R"({"throng": 1, "simulation": {"duration": 1e999}})").hasErrors());
    EXPECT_TRUE(diagnose(R"({"throng": 1, "simulation": {"duration": NaN}})").hasErrors());
    EXPECT_TRUE(diagnose(R"({"throng": 1, "simulation": {"duration": Infinity}})").hasErrors());
}

TEST(LayoutReader, NamesThePlaceWhereAPolygonCrossesItself) {
    expectError(
        "{\"throng\": 1,\n \"areas\": [{\"id\": \"bow tie\", \"polygon\": [[0,0],[4,4],[4,0],[0,4]]}]}", 2,
        41, "/areas/0/polygon", "crosses itself at [2, 2]");
    expectError("{\"throng\": 1,\n \"walls\": [{\"closed\": true, \"points\": [[0,0],[4,4],[4,0],[0,4]]}]}",
                2, 39, "/walls/0/points", "crosses itself");
    expectError("{\"throng\": 1,\n \"areas\": [{\"id\": \"flat\", \"polygon\": [[0,0],[4,0],[8,0]]}]}", 2, 38,
                "/areas/0/polygon", "no area");
}

TEST(LayoutReader, MendsObstaclesThatBoundNothingOrTouchThemselves) {
    const auto mended = [](const std::string& points, const std::string& warning) {
        Diagnostics diagnostics;
        const auto layout = readLayout(
            R"({"throng": 1, "walls": [{"closed": true, "points": )" + points + "}]}", {}, diagnostics);
        EXPECT_TRUE(layout.has_value()) << points;
        EXPECT_EQ(diagnostics.entries.size(), 2u) << points;  // and that there is nobody
        std::string all;
        for (const Diagnostic& entry : diagnostics.entries) {
            if (entry.message.find("nobody") != std::string::npos) continue;
            EXPECT_EQ(entry.severity, Severity::warning);
            all += entry.message + "\n";
        }
        EXPECT_NE(all.find(warning), std::string::npos) << all;
        return layout ? layout->walls.front() : Wall{};
    };
    const Wall line = mended("[[0,0],[4,0],[8,0]]", "no area");
    EXPECT_FALSE(line.closed);
    EXPECT_EQ(line.thickness, 0.0);
    EXPECT_EQ(line.points.size(), 4u);
    const Wall spiked = mended("[[0,0],[4,0],[4,4],[9,4],[4,4],[0,4]]", "2 of its points");
    EXPECT_TRUE(spiked.closed);
    EXPECT_EQ(spiked.points.size(), 4u);
    // Two triangles that share a corner.
    EXPECT_TRUE(mended("[[0,0],[4,0],[2,2],[4,4],[0,4],[2,2]]", "touches itself at [2, 2]").closed);
}

TEST(LayoutReader, AcceptsEitherWindingAndPolygonsClosedByHand) {
    read(
        R"({"throng": 1, "areas": [{"id": "a", "polygon": [[0,0],[0,4],[4,4],[4,0]]},
 {"id": "b", "polygon": [[0,0],[4,0],[4,4],[0,4],[0,0]]}],
            "formations": [{"id": "c", "type": "circle", "centre": [0, 0], "radius": 5, "count": 6}]})");
}

TEST(LayoutReader, KnowsPlacesAndGuessesThoseMeant) {
    const std::string flow = R"( "flows": [{"id": "f", "from": "a", "to": ")";
    expectError(kTwoAreas + flow + "c\", \"count\": 1}]}", 4, 43, "/flows/0/to", "there is no place `c`",
                "did you mean");
    expectError(R"({"throng": 1, "roads": [{"id": "main", "centreline": [[0,0],[9,0]]}],
 "flows": [{"id": "f", "from": "main", "to": "main:end", "count": 1}]})",
                2, 32, "/flows/0/from", "names a road, not one of its ends");
    expectError(R"({"throng": 1, "roads": [{"id": "main", "centreline": [[0,0],[9,0]], "one_way": true}],
 "flows": [{"id": "f", "from": "main:end", "to": "main:start", "count": 1}]})",
                2, 32, "/flows/0/from", "against the one-way road");
}

TEST(LayoutReader, ReadsStopsDestinationsAndEvents) {
    const Layout layout = read(kTwoAreas + R"("walls": [{"id": "gate", "points": [[10,0],[10,4]]}],
 "flows": [{"id": "f", "from": "a", "to": {"choose": {"a": 1, "b": 3}}, "rate": 1,
   "via": ["b", {"at": {"nearest": ["a", "b"]}},
    {"at": "b", "wait": {"log_normal": [1, 0.5], "max": 9}, "activity": "look", "facing": [1, 2]}]}],
 "events": [{"at": 9, "flow": "f", "rate": 0}, {"at": 4, "close": "gate"}, {"at": 8, "open": "gate"},
   {"at": 20, "go_to": "a", "who": ["f"], "arrival": "stay"}]})");
    const Flow& flow = layout.flows.at(0);
    EXPECT_EQ(flow.to.kind, Destination::Kind::choose);
    EXPECT_EQ(flow.to.weights, (std::vector{1.0, 3.0}));
    ASSERT_EQ(flow.via.size(), 3u);
    EXPECT_FALSE(flow.via[0].stops());
    EXPECT_EQ(flow.via[1].to.kind, Destination::Kind::nearest);
    EXPECT_TRUE(flow.via[2].stops());
    EXPECT_EQ(flow.via[2].lasts->maximum, 9.0);
    EXPECT_EQ(flow.via[2].activity, ActivityCode::looks);
    ASSERT_EQ(layout.events.size(), 4u);
    EXPECT_EQ(layout.events[0].at, 4.0) << "in the order of their times";
    EXPECT_TRUE(layout.walls[0].open_at_start);
    EXPECT_TRUE(layout.walls[0].isOpen(3.9));
    EXPECT_FALSE(layout.walls[0].isOpen(5.0));
    EXPECT_TRUE(layout.walls[0].isOpen(8.5));
    EXPECT_TRUE(layout.events[3].then.for_good);
}

TEST(LayoutReader, ExplainsWhatIsWrongWithStopsAndEvents) {
    const std::string via = R"("flows": [{"id": "f", "from": "a", "to": "b", "count": 1, "via": [)";
    expectError(kTwoAreas + via + R"({"at": "b", "activity": "queue", "wait": 3}]}]})", 4, 67,
                "/flows/0/via/0", "a queue needs the `line`");
    expectError(kTwoAreas + via + R"({"at": "b", "activity": "look", "wait": 3}]}]})", 4, 67,
                "/flows/0/via/0", "where do people look?", "facing");
    expectError(kTwoAreas + via + R"({"at": "b", "activity": "look", "facing": [0, 0]}]}]})", 4, 67,
                "/flows/0/via/0", "has no `wait`");
    expectError(kTwoAreas + via + R"({"at": {"nearest": ["a", "b"]}, "wait": 3}]}]})", 4, 74,
                "/flows/0/via/0/at", "cannot stop at the nearest");
    expectError(kTwoAreas + via + R"({"at": "c", "wait": 3}]}]})", 4, 74, "/flows/0/via/0/at",
                "there is no place `c`");
    const std::string events = R"("walls": [{"id": "gate", "points": [[10,0],[10,4]]}],
 "flows": [{"id": "f", "from": "a", "to": "b", "count": 1}], "events": [)";
    expectError(kTwoAreas + events + R"({"at": 1}]})", 5, 73, "/events/0", "exactly one of `open`");
    expectError(kTwoAreas + events + R"({"at": 1, "open": "gat"}]})", 5, 91, "/events/0/open",
                "there is no wall `gat`", "did you mean `gate`?");
    expectError(kTwoAreas + events + R"({"at": 1, "flow": "f", "rate": 2}]})", 5, 91, "/events/0/flow",
                "is no flow with a `rate`");
    expectError(kTwoAreas + events + R"({"at": 1, "go_to": "a", "who": ["g"]}]})", 5, 105, "/events/0/who/0",
                "there is no flow or formation `g`");
    // Only those are offered that can be sent.
    expectError(kTwoAreas + R"("given": [{"id": "gang", "ways": [[[0, 1, 1], [9, 5, 1]]]}],
 )" + events + R"({"at": 1, "go_to": "a", "who": ["gangs"]}]})",
                6, 105, "/events/0/who/0", "there is no flow or formation `gangs`", "known here: f");
    expectError(kTwoAreas + events + R"({"at": 1, "flow": "gates", "rate": 2}]})", 5, 91, "/events/0/flow",
                "there is no flow `gates`", "known here: f");
    expectError(kTwoAreas + events + R"({"at": 1, "open": "gate"}, {"at": 2, "open": "gate"}]})", 5, 100,
                "/events/1", "already is open");
    expectError(kTwoAreas + R"("walls": [{"id": "block", "closed": true, "points": [[10,0],[12,0],[11,2]]}],
 "events": [{"at": 1, "open": "block"}]})",
                5, 13, "/events/0", "is a solid, not a gate");
    const std::string people =
        R"("flows": [{"id": "f", "from": "a", "to": "b", "count": 1, "people": {"groups": )";
    expectError(kTwoAreas + people + R"([1, 2, 3, 4, 5]}}]})", 4, 80, "/flows/0/people/groups",
                "one to 4 weights");
    expectError(kTwoAreas + people + R"([0, 0]}}]})", 4, 80, "/flows/0/people/groups",
                "all weights are zero");
}

TEST(LayoutReader, WantsExactlyOneWayOfComingIn) {
    const std::string flow = R"( "flows": [{"id": "f", "from": "a", "to": "b")";
    expectError(kTwoAreas + flow + "}]}", 4, 12, "/flows/0", "has none");
    expectError(kTwoAreas + flow + R"(, "count": 1, "rate": 1}]})", 4, 12, "/flows/0",
                "has `count` and `rate`");
    expectError(kTwoAreas + flow + R"(, "gaps": 2, "times": [1]}]})", 4, 12, "/flows/0",
                "has `gaps` and `times`");
    expectError(kTwoAreas + flow + R"(, "count": 1, "start": 5, "end": 3}]})", 4, 79, "/flows/0/end",
                "ends (3 s) before it starts (5 s)");
    expectError(kTwoAreas + flow + R"(, "count": 1, "start": 5, "end": 5}]})", 4, 79, "/flows/0/end",
                "ends (5 s) when it starts (5 s)");
}

TEST(LayoutReader, TellsAllMistakesOfAFileInOneGoAndInOrder) {
    const Diagnostics found = diagnose(R"({"throng": 1,
 "simulation": {"fps": -1, "sed": 3},
 "roads": [{"id": "r", "centreline": [[0,0]]}],
 "walls": [{"points": "here"}],
 "flows": [{"id": "f", "from": "nowhere", "to": "r:end", "count": -2}]})");
    EXPECT_GE(found.entries.size(), 6u);
    for (std::size_t i = 1; i < found.entries.size(); ++i)
        EXPECT_LE(found.entries[i - 1].where.line, found.entries[i].where.line);
}

TEST(LayoutReader, RefusesDuplicateKeysAndIdsAndDeepNesting) {
    expectError("{\"throng\": 1,\n \"name\": \"a\",\n \"name\": \"b\"}", 3, 2, "/name", "second time");
    expectError(
        "{\"throng\": 1, \"areas\": [{\"id\": \"a\", \"polygon\": [[0,0],[1,0],[1,1]]},\n {\"id\": \"a\", "
        "\"polygon\": [[5,0],[6,0],[6,1]]}]}",
        2, 9, "/areas/1/id", "there already is an area `a`");
    EXPECT_TRUE(diagnose(std::string(100000, '[')).hasErrors());
}

TEST(LayoutReader, TellsWhereTheSyntaxBreaks) {
    const Diagnostics found = diagnose("{\"throng\": 1,\n \"roads\": [\n  {\"id\" \"r\"}]}");
    ASSERT_EQ(found.entries.size(), 1u);
    EXPECT_EQ(found.entries[0].where.line, 3);
    EXPECT_NE(found.entries[0].message.find("syntax error"), std::string::npos);
    EXPECT_TRUE(diagnose("").hasErrors());
}

TEST(LayoutReader, TilesHaveToCoverBodies) {
    expectError(
        R"({"throng": 1, "simulation": {"tile_radius": 0.2},
 "formations": [{"id": "c", "type": "circle", "centre": [0, 0], "radius": 5, "count": 6}]})",
        1, 29, "/simulation", "smaller than the largest body");
}

TEST(LayoutReader, TilesHaveToCoverTheBodiesOfListedPeople) {
    const std::string before = R"({"throng": 1, "formations": [{"id": "c", "type": "agents", "agents": [)";
    expectError(before + R"({"position": [0, 0], "goal": [5, 0], "radius": 0.9}]}]})", 1, 1, "",
                "smaller than the largest body (0.9 m)");
    read(before + R"({"position": [0, 0], "goal": [5, 0], "radius": 0.5}]}]})");
}

TEST(LayoutReader, NamesWallsWithoutTakingAWrittenName) {
    const Layout layout = read(
        R"({"throng": 1, "walls": [{"points": [[9,0],[9,5]]}, {"id": "wall0", "points": [[12,0],[12,5]]}],
            "formations": [{"id": "c", "type": "circle", "centre": [0, 0], "radius": 5, "count": 6}]})");
    ASSERT_EQ(layout.walls.size(), 2u);
    EXPECT_EQ(layout.walls[1].id, "wall0");
    EXPECT_FALSE(layout.walls[0].id.empty());
    EXPECT_NE(layout.walls[0].id, "wall0");
    expectError(R"({"throng": 1, "walls": [{"id": "", "points": [[9,0],[9,5]]}]})", 1, 32, "/walls/0/id",
                "`id` is empty");
}

TEST(LayoutReader, RefusesSeedsThatADoubleWouldRound) {
    const std::string before = R"({"throng": 1, "simulation": {"seed": )";
    expectError(before + "9007199254740993}}", 1, 38, "/simulation/seed", "out of range");
    expectError(before + "18446744073709551615}}", 1, 38, "/simulation/seed", "out of range");
}

TEST(LayoutReader, WritesLayoutsAsOverridesMakeThem) {
    const std::string text = kTwoAreas + R"("simulation": {"fps": 23.976, "seed": 9007199254740992},
 "flows": [{"id": "f", "from": "a", "to": "b", "rate": 0.1}]})";
    EXPECT_EQ(layoutWith(text, {}), text);
    const std::string with = layoutWith(
        text, std::vector<std::string>{"simulation.duration=7", "flows.by-id.f.rate=0.30000000000000004",
                                       "/flows/0/people={\"profile\": \"child\"}"});
    const Layout layout = read(with);
    EXPECT_EQ(layout.simulation.duration, 7.0);
    EXPECT_EQ(layout.simulation.fps, 23.976);
    EXPECT_EQ(layout.simulation.seed, 9007199254740992u);
    EXPECT_EQ(layout.flows.at(0).rate, 0.30000000000000004);
    EXPECT_NE(with.find("\"profile\": \"child\""), std::string::npos);
}

TEST(LayoutReader, OverridesValuesAndNamesTheOverrideThatIsWrong) {
    const std::string text =
        R"({"throng": 1, "formations": [{"id": "c", "type": "circle", "centre": [0, 0], "radius": 5, "count": 6}]})";
    EXPECT_EQ(read(text, {"simulation.seed=7"}).simulation.seed, 7u);
    EXPECT_EQ(read(text, {"/simulation/fps=30"}).simulation.fps, 30.0);
    EXPECT_EQ(read(text, {"simulation.method=per-site"}).simulation.method, DiagramMethod::per_site);
    EXPECT_EQ(std::get<CircleFormation>(read(text, {"formations.0.count=12"}).formations[0].shape).count,
              12u);
    const std::string choice =
        R"({"throng": 1, "areas": [{"id": "x/y~", "polygon": [[0,0],[4,0],[4,4]]},
 {"id": "b", "polygon": [[9,0],[12,0],[12,4]]}],
 "flows": [{"id": "f", "from": "b", "to": {"choose": {"x/y~": 1}}, "count": 1}]})";
    EXPECT_EQ(read(choice, {"/flows/0/to/choose/x~1y~0=5"}).flows.at(0).to.weights.at(0), 5.0);
    EXPECT_EQ(read(choice, {"flows.by-id.f.count=5"}).flows.at(0).count, 5u);
    const Diagnostics absent = diagnose(choice, {"/areas/by-id/c/id=5"});
    EXPECT_EQ(absent.entries.at(0).message,
              "/areas: nothing in this list has the id `c`; there are `x/y~`, `b`");
    for (const std::string wrong :
         {"simulation.sed=7", "simulation.seed", "formations.3.count=1", "simulation.fps=fast"})
        EXPECT_TRUE(diagnose(text, {wrong}).hasErrors()) << wrong;
    const Diagnostics found = diagnose(text, {"simulation.sed=7"});
    EXPECT_EQ(formatDiagnostic(found.entries[0], "lay.json", text),
              "lay.json: error: --set /simulation/sed: `simulation` has no key `sed`\n  hint: did you mean "
              "`seed`?");
}

TEST(LayoutReader, FormatsDiagnosticsLikeACompiler) {
    const std::string text = "{\"throng\": 1,\n \"flow\": []}";
    const Diagnostics found = diagnose(text);
    EXPECT_EQ(formatDiagnostic(found.entries[0], "lay.json", text),
              "lay.json:2:2: error: /flow: the layout has no key `flow`\n   \"flow\": []}\n   ^\n  hint: did "
              "you mean `flows`?");
}

std::vector<std::string> exampleTexts() {
    std::vector<std::string> texts;
    for (const auto& entry : std::filesystem::directory_iterator(THRONG_EXAMPLES)) {
        const std::string name = entry.path().filename().string();
        if (!name.ends_with(".json") || name.starts_with("family-")) continue;
        std::ostringstream text;
        text << std::ifstream(entry.path()).rdbuf();
        texts.push_back(text.str());
    }
    return texts;
}

TEST(LayoutReader, ReadsTheExamplesWithoutAWord) {
    const std::vector<std::string> texts = exampleTexts();
    ASSERT_GE(texts.size(), 3u);
    for (const std::string& text : texts)
        EXPECT_TRUE(diagnose(text).entries.empty());
}

TEST(LayoutReader, SurvivesTwoThousandMutations) {
    std::mt19937 random(5);
    const std::vector<std::string> texts = exampleTexts();
    for (int i = 0; i < 2000; ++i) {
        std::string text = texts[static_cast<std::size_t>(i) % texts.size()];
        for (int change = 0; change < 1 + i % 4; ++change) {
            const std::size_t at = random() % text.size();
            if (i % 3 == 0)
                text.erase(at, random() % 9);
            else
                text[at] = static_cast<char>(random() % 256);
            if (text.empty()) text = "{";
        }
        const Diagnostics found = diagnose(text);
        for (const Diagnostic& entry : found.entries)
            EXPECT_FALSE(formatDiagnostic(entry, "x", text).empty());
    }
}

}  // namespace
}  // namespace throng::authoring
