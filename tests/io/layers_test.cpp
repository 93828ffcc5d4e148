// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "applied_crowd.h"
#include "io/overrides/agent_table_edit.h"

namespace throng::io {
namespace {

using test::AppliedLayers;

constexpr std::uint32_t kLayerFrames = 48;

TEST(Layers, HideInSomeFramesOnly) {
    const AppliedLayers applied(
        R"([{"name": "gap", "who": {"rows": [0, 1]}, "do": {"hide": {"frames": [10, 20]}}},
            {"name": "late", "who": {"rows": [2, 2]}, "do": {"hide": {"frames": [0, 5]}}},
            {"name": "never", "who": {"rows": [3, 3]}, "do": {"hide": true}}])");
    EXPECT_TRUE(applied.problems.empty());
    for (std::uint32_t frame = 0; frame < kLayerFrames; ++frame) {
        EXPECT_EQ(applied.row(Stream::state, frame, 0)[0] > 0.5f, frame < 10 || frame > 20) << frame;
        EXPECT_EQ(applied.row(Stream::state, frame, 2)[0] > 0.5f, frame > 5) << frame;
        EXPECT_EQ(applied.row(Stream::state, frame, 3)[0], 0.0f);
        EXPECT_EQ(applied.row(Stream::state, frame, 5)[0] > 0.5f, applied.crowd.isAlive(5, frame));
    }
    const AgentTableEdit table(applied.made);
    EXPECT_EQ(table.at(0, "spawn_frame"), "0");
    EXPECT_EQ(table.at(2, "spawn_frame"), "6");
    EXPECT_EQ(table.at(3, "reason"), "hidden by a layer");
    EXPECT_EQ(table.at(0, "overrides"), "hide");
    EXPECT_EQ(applied.made.account.refused, applied.source.account.refused + 1);
}

TEST(Layers, TurnAllAboutOnePlace) {
    const AppliedLayers applied(
        R"([{"name": "turn", "who": {"everybody": true},
             "do": {"move": {"turn": 90, "about": [2, 3], "by": [0, 0, 1]}}}])");
    for (const std::uint32_t row : {0u, 5u, 9u})
        for (const std::uint32_t frame : {0u, 47u}) {
            const glm::dvec2 arm = applied.crowd.position(row, frame) - glm::dvec2(2.0, 3.0);
            const auto place = applied.row(Stream::pos, frame, row);
            EXPECT_NEAR(place[0], 2.0 - arm.y, 1e-5);
            EXPECT_NEAR(place[1], 3.0 + arm.x, 1e-5);
            EXPECT_NEAR(place[2], 1.0, 1e-6);
            const auto facing = applied.row(Stream::dir, frame, row);
            EXPECT_NEAR(std::remainder(std::atan2(facing[1], facing[0]) - applied.crowd.heading(row, frame) -
                                           0.5 * std::numbers::pi,
                                       2.0 * std::numbers::pi),
                        0.0, 1e-5);
        }
    EXPECT_TRUE(applied.result->overlaps.empty()) << "nobody is nearer to anybody";
    EXPECT_GT(applied.made.maximum.y, applied.source.maximum.y - 1.0);
}

TEST(Layers, LaterOnesChangeWhatEarlierOnesHaveLeft) {
    const AppliedLayers applied(
        R"([{"name": "all", "who": {"everybody": true}, "do": {"tint": "#000001", "scale": 1.5}},
            {"name": "some", "who": {"rows": [4, 4]}, "do": {"tint": "#000002", "character": 3}},
            {"name": "off", "enabled": false, "who": {"everybody": true}, "do": {"tint": "#000003"}},
            {"name": "first", "who": {"rows": [9, 9]}, "do": {"move": {"by": [5, 0, 0]}}},
            {"name": "then", "who": {"rows": [9, 9]}, "do": {"move": {"turn": 180}}}])");
    const AgentTableEdit table(applied.made);
    EXPECT_EQ(table.at(3, "tint"), "#000001");
    EXPECT_EQ(table.at(4, "tint"), "#000002");
    EXPECT_EQ(table.at(4, "scale"), "1.5");
    EXPECT_EQ(table.at(4, "overrides"), "tint scale character");
    EXPECT_EQ(applied.row(Stream::state, 0, 4)[1], 3.0f);
    // About where it enters once it has been moved.
    const std::uint32_t spawn = applied.crowd.spawnFrame(9);
    const glm::dvec2 entry = applied.crowd.position(9, spawn);
    const glm::dvec2 way = applied.crowd.position(9, 47) - entry;
    EXPECT_NEAR(applied.row(Stream::pos, 47, 9)[0], entry.x + 5.0 - way.x, 1e-5);
    EXPECT_NEAR(applied.row(Stream::pos, 47, 9)[1], entry.y - way.y, 1e-5);
}

TEST(Layers, RetimesAddUp) {
    const AppliedLayers applied(
        R"([{"name": "late", "who": {"rows": [14, 14]}, "do": {"retime": {"offset": 6}}},
            {"name": "fast", "who": {"rows": [14, 14]}, "do": {"retime": {"offset": -2, "speed": 2}}}])");
    const std::uint32_t spawn = applied.crowd.spawnFrame(14);  // 15; then 21, then 19
    ASSERT_EQ(spawn, 15u);
    for (const std::uint32_t frame : {19u, 25u, 33u}) {
        const std::uint32_t shown = spawn + 2 * (frame - 19);
        EXPECT_NEAR(applied.row(Stream::pos, frame, 14)[0], applied.crowd.position(14, shown).x, 1e-5);
    }
    EXPECT_NEAR(applied.row(Stream::dir, 30, 14)[2], 2.0 * (1.1 + 0.1 * (14 % 4)), 1e-5);
    EXPECT_EQ(AgentTableEdit(applied.made).at(14, "spawn_frame"), "19");
    EXPECT_NEAR(applied.row(Stream::pos, 47, 14)[0], applied.crowd.position(14, 47).x, 1e-5) << "held";
    EXPECT_EQ(applied.result->held, 1u);
}

TEST(Layers, CopiesCarryAllThatWasDoneToThem) {
    const AppliedLayers applied(
        R"([{"name": "red", "who": {"rows": [2, 3]}, "do": {"tint": "#a01020",
             "duplicate": {"copies": 2, "by": [0, 40, 0], "turn": 90, "offset": 3}}}])");
    EXPECT_TRUE(applied.problems.empty());
    EXPECT_EQ(applied.results[0].copies, 4u);
    EXPECT_EQ(applied.made.agents, 68u);
    const AgentTableEdit table(applied.made);
    for (const std::uint32_t row : {2u, 3u, 64u, 65u, 66u, 67u})
        EXPECT_EQ(table.at(row, "tint"), "#a01020");
    EXPECT_EQ(table.at(66, "id"), "66");
    EXPECT_EQ(table.at(66, "group"), "eastbound");
    EXPECT_EQ(table.at(66, "overrides"), "tint duplicate");
    EXPECT_EQ(table.at(66, "spawn_frame"), "0") << "it stands until it goes on: the bake begins with it";
    const glm::dvec2 entry = applied.crowd.position(2, 0), way = applied.crowd.position(2, 30) - entry;
    const auto once = applied.row(Stream::pos, 33, 64), twice = applied.row(Stream::pos, 36, 66);
    EXPECT_NEAR(once[0], entry.x - way.y, 1e-5);
    EXPECT_NEAR(once[1], entry.y + way.x + 40.0, 1e-5);
    EXPECT_NEAR(twice[0], entry.x - way.x, 1e-5);
    EXPECT_NEAR(twice[1], entry.y - way.y + 80.0, 1e-5);
    for (const std::uint32_t frame : {0u, 20u})
        EXPECT_NEAR(applied.row(Stream::pos, frame, 2)[0], applied.crowd.position(2, frame).x, 1e-5);
    const auto account = applied.made.account;
    EXPECT_EQ(account.spawned, applied.source.account.spawned + 4);
    EXPECT_EQ(account.walking + account.arrived, account.spawned);
}

TEST(Layers, CopiesAreScatteredWithinADisc) {
    const AppliedLayers applied(
        R"([{"name": "more", "who": {"rows": [0, 9]}, "do": {"duplicate": {"copies": 5, "scatter": 3}}}])");
    double sum = 0.0;
    for (std::uint32_t copy = 0; copy < 50; ++copy) {
        const auto place = applied.row(Stream::pos, 0, 64 + copy);
        const double away =
            glm::distance(glm::dvec2(place[0], place[1]),
                          applied.crowd.position(copy % 10, applied.crowd.spawnFrame(copy % 10)));
        EXPECT_LE(away, 3.0 + 1e-5);
        sum += away;
    }
    EXPECT_NEAR(sum / 50, 2.0, 0.3) << "even over the disc: two thirds of its radius on average";
}

TEST(Layers, TooManyCopiesAreRefused) {
    test::TemporaryFolder folder;
    test::SampleCrowd({}).bake(folder / "bake");
    CrowdReader reader(loadBake(folder / "bake"));
    LayeredCrowd layered(reader);
    const auto layers =
        test::layersOf(R"([{"name": "x", "who": {"everybody": true}, "do": {"duplicate": {"copies": 2}}}])");
    EXPECT_THROW(applyLayers(layered, layers, loadEntrants(reader), 191), InputError);
    EXPECT_EQ(applyLayers(layered, layers, loadEntrants(reader), 192).front().copies, 128u);
}

TEST(Layers, ClipsChangeTheActivityAndLeaveTheGait) {
    const AppliedLayers applied(
        R"([{"name": "wait", "who": {"rows": [0, 0]}, "do": {"clip": {"activity": "queues", "frames": [5, 9]}}}])");
    for (const std::uint32_t frame : {4u, 5u, 9u, 10u}) {
        const float state = applied.row(Stream::state, frame, 0)[0],
                    other = applied.row(Stream::state, frame, 2)[0];
        EXPECT_EQ(std::floor(state), frame == 5 || frame == 9 ? 4.0f : 1.0f);
        EXPECT_EQ(state - std::floor(state), other - std::floor(other));
    }
}

TEST(Layers, HeadsTurnToAPointAndToSomebody) {
    test::SampleOptions options;
    options.every_stream = true;
    const AppliedLayers applied(
        R"([{"name": "up", "who": {"rows": [0, 2]},
             "do": {"look_at": {"point": [-14, 100, 1.6], "frames": [0, 30], "ease": 0}}}])",
        options);
    const auto facing = applied.row(Stream::dir, 8, 1), place = applied.row(Stream::pos, 8, 1);
    const auto gaze = applied.row(Stream::gaze, 8, 1);
    // Row 1 goes north: it sees the point within its reach, a little to one side.
    const double yaw = std::atan2(100.0 - place[1], -14.0 - place[0]) - std::atan2(facing[1], facing[0]);
    EXPECT_NEAR(gaze[0], yaw, 1e-5);
    EXPECT_NEAR(gaze[1], std::atan2(-place[2], std::hypot(100.0 - place[1], -14.0 - place[0])), 1e-5);
    EXPECT_EQ(gaze[2], 0.0f);
    const auto head = applied.row(Stream::attention, 8, 1);
    const double most = 70.0 * std::numbers::pi / 180.0;
    EXPECT_NEAR(head[0], std::clamp(yaw - double{applied.row(Stream::carriage, 8, 1)[1]}, -most, most), 1e-5);
    EXPECT_EQ(head[1], gaze[1]);
    EXPECT_EQ(head[2], 1.0f) << "all of it";
    // Row 0 goes east: its neck turns by 70 degrees and no more.
    EXPECT_NEAR(applied.row(Stream::gaze, 8, 0)[0], 70.0 * std::numbers::pi / 180.0, 1e-5);
    const AppliedLayers at(R"([{"name": "at", "who": {"rows": [0, 4]}, "do": {"look_at": {"frames": [10, 40],
        "person": {"id": 2, "group": "eastbound", "spawn": {"frame": 0, "position": [)" +
                               std::to_string(applied.crowd.position(2, 0).x) + ", " +
                               std::to_string(applied.crowd.position(2, 0).y) + R"(, -1.5]}}}}}])",
                           options);
    EXPECT_EQ(at.results[0].remarks, std::vector<std::string>{});
    EXPECT_EQ(at.row(Stream::gaze, 25, 0)[2], 3.0f);
    EXPECT_NE(at.row(Stream::gaze, 25, 2)[2], 3.0f) << "not at oneself";
    EXPECT_EQ(at.row(Stream::gaze, 9, 0), applied.crowd.isAlive(0, 9)
                                              ? AppliedLayers("[]", options).row(Stream::gaze, 9, 0)
                                              : at.row(Stream::gaze, 9, 0));
    const AppliedLayers without(
        R"([{"name": "up", "who": {"rows": [0, 2]}, "do": {"look_at": {"point": [0, 0, 2]}}}])");
    EXPECT_NE(without.results[0].remarks.at(0).find("no stream `gaze`"), std::string::npos);
}

TEST(Layers, OnATerrainWhoIsTakenElsewhereStandsOnTheGround) {
    test::SampleOptions options;
    options.every_stream = true;  // on a square that rises by a tenth along x
    const AppliedLayers applied(
        R"([{"name": "bend", "who": {"rows": [1, 1]},
             "do": {"bend": {"points": [{"frame": 24, "by": [2, 0]}], "falloff": 20, "most_acceleration": 50}}},
            {"name": "copies", "who": {"rows": [0, 1]}, "do": {"duplicate": {"by": [6, 0, 0.5]}}},
            {"name": "across", "who": {"rows": [2, 2]}, "do": {"move": {"turn": 180, "about": [0, 0]}}}])",
        options);
    for (const auto& [row, over] : {std::pair{1u, 0.0}, {64u, 0.5}, {65u, 0.5}, {2u, 0.0}}) {
        const auto place = applied.row(Stream::pos, 24, row);
        EXPECT_NEAR(place[2], 0.1 * place[0] + over, 0.02) << row;
        EXPECT_NEAR(applied.row(Stream::ground, 24, row)[2], 0.1 * place[0], 1e-4) << row;
    }
}

TEST(Layers, HeroesHaveANameEach) {
    const AppliedLayers applied(
        R"([{"name": "guards", "who": {"rows": [5, 6]}, "do": {"hero": "Guard"}},
            {"name": "one", "who": {"rows": [8, 8]}, "do": {"hero": "Anna"}}])",
        {}, true);
    const AgentTableEdit table(applied.made);
    EXPECT_EQ(table.at(5, "reason"), "a hero outside the crowd");
    EXPECT_EQ(table.at(8, "overrides"), "hero");
    EXPECT_EQ(applied.row(Stream::state, 20, 6)[0], 0.0f);
}

TEST(Layers, WhoIsPutIntoAWallIsTold) {
    // Row 0 walks along y = -3.6; the wall `corner` runs along y = 5.2, 0.3 m thick, up to x = -5.2.
    const AppliedLayers applied(
        R"([{"name": "in", "who": {"rows": [0, 0]}, "do": {"move": {"by": [0, 8.8, 0]}}},
            {"name": "beside", "who": {"rows": [2, 2]}, "do": {"move": {"by": [0, 0.1, 0]}}}])");
    ASSERT_EQ(applied.result->in_walls.size(), 1u);
    EXPECT_EQ(applied.result->in_walls[0].row, 0u);
    EXPECT_EQ(applied.result->in_walls[0].wall, "corner");
    EXPECT_EQ(applied.result->in_walls[0].first, 0u);
    EXPECT_EQ(applied.made.manifest["applied"]["in_walls"][0]["frames"][1], kLayerFrames - 1);
}

TEST(Layers, OverlapsThatTheyMakeAreTold) {
    // Row 0 is put to where row 2 is (radii 0.22 and 0.24 m), 0.1 m beside it, in all frames.
    const test::SampleCrowd crowd({});
    const glm::dvec2 by = crowd.position(2, 0) - crowd.position(0, 0) + glm::dvec2(0.0, 0.1);
    const AppliedLayers applied(R"([{"name": "on", "who": {"rows": [0, 0]}, "do": {"move": {"by": [)" +
                                std::to_string(by.x) + ", " + std::to_string(by.y) + ", 0]}}}]");
    ASSERT_FALSE(applied.result->overlaps.empty());
    const Overlap& deepest = applied.result->overlaps.front();
    EXPECT_EQ(deepest.row, 0u);
    EXPECT_EQ(deepest.other, 2u);
    EXPECT_EQ(deepest.first, 0u);
    EXPECT_NEAR(deepest.depth, 0.22 + 0.24 - 0.1, 0.02);
    EXPECT_EQ(applied.made.manifest["applied"]["overlaps"]["pairs"], applied.result->overlaps.size());
}

}  // namespace
}  // namespace throng::io
