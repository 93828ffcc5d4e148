// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "applied_crowd.h"
#include "authoring/overrides/bend_curve.h"
#include "recording/gaits.h"

namespace throng::io {
namespace {

using test::AppliedLayers;

constexpr std::uint32_t kBendFrames = 48;
constexpr double kBendFps = 24.0;

glm::dvec2 placeOf(const AppliedLayers& applied, std::uint32_t frame, std::uint32_t row) {
    const auto pos = applied.row(Stream::pos, frame, row);
    return {pos[0], pos[1]};
}

TEST(Bend, MovesTheWayByTheCurveAndNobodyElse) {
    const AppliedLayers applied(
        R"([{"name": "bend", "who": {"rows": [0, 0]},
             "do": {"bend": {"points": [{"frame": 24, "by": [0, 1]}], "falloff": 16, "most_acceleration": 50}}}])");
    EXPECT_TRUE(applied.problems.empty());
    EXPECT_TRUE(applied.results[0].remarks.empty());
    const authoring::BendCurve curve({{24.0, {0.0, 1.0}}}, 16.0, 16.0);
    const authoring::BendCurve none({{1.0e6, {0.0, 1.0}}}, 1.0, 1.0);
    for (std::uint32_t frame = 0; frame < kBendFrames; ++frame) {
        const glm::dvec2 expected = applied.crowd.position(0, frame) + curve.at(frame);
        EXPECT_NEAR(placeOf(applied, frame, 0).x, expected.x, 1e-5) << frame;
        EXPECT_NEAR(placeOf(applied, frame, 0).y, expected.y, 1e-5) << frame;
        EXPECT_NEAR(placeOf(applied, frame, 2).x, applied.crowd.position(2, frame).x, 1e-6);
    }
    EXPECT_NEAR(placeOf(applied, 24, 0).y, applied.crowd.position(0, 24).y + 1.0, 1e-5);
}

TEST(Bend, HeadingsSpeedsAndPhasesFollowTheNewWay) {
    const AppliedLayers applied(
        R"([{"name": "bend", "who": {"rows": [0, 0]},
             "do": {"bend": {"points": [{"frame": 24, "by": [0, 1]}], "falloff": 16, "most_acceleration": 50}}}])");
    const AppliedLayers straight("[]");
    for (const std::uint32_t frame : {12u, 16u, 20u, 28u, 32u, 36u}) {
        const glm::dvec2 way = placeOf(applied, frame + 1, 0) - placeOf(applied, frame - 1, 0);
        const auto facing = applied.row(Stream::dir, frame, 0);
        EXPECT_NEAR(std::atan2(facing[1], facing[0]), std::atan2(way.y, way.x), 0.01) << frame;
        const double walked = glm::distance(placeOf(applied, frame, 0), placeOf(applied, frame - 1, 0));
        const double before = glm::distance(placeOf(straight, frame, 0), placeOf(straight, frame - 1, 0));
        const double told = straight.row(Stream::dir, frame, 0)[2];
        EXPECT_NEAR(facing[2], told * walked / before, 1e-4);
        const auto state = applied.row(Stream::state, frame, 0),
                   last = applied.row(Stream::state, frame - 1, 0);
        if (recording::gaitOf(state[0]) == recording::gaitOf(last[0])) {
            EXPECT_NEAR(state[2] - last[2],
                        facing[2] / kBendFps / recording::strideOf(recording::gaitOf(state[0])), 1e-5);
        }
    }
    // Before it begins everything is as it was, to the last bit.
    for (const Stream stream : {Stream::pos, Stream::dir, Stream::state})
        for (std::uint32_t frame = 0; frame < 8; ++frame)
            EXPECT_EQ(applied.row(stream, frame, 0), straight.row(stream, frame, 0));
    EXPECT_GT(applied.row(Stream::state, 47, 0)[2], straight.row(Stream::state, 47, 0)[2])
        << "who walks further has taken more steps";
}

TEST(Bend, PointsByTheWayAreWhereSoMuchHasBeenWalked) {
    const AppliedLayers applied(
        R"([{"name": "bend", "who": {"rows": [0, 0]},
             "do": {"bend": {"points": [{"way": 1, "by": [0, 0.5]}], "falloff": 0.7, "most_acceleration": 50}}}])");
    double way = 0.0;
    const authoring::BendCurve curve({{1.0, {0.0, 0.5}}}, 0.7, 0.7);
    for (std::uint32_t frame = 0; frame < kBendFrames; ++frame) {
        if (frame)
            way += glm::distance(applied.crowd.position(0, frame), applied.crowd.position(0, frame - 1));
        EXPECT_NEAR(placeOf(applied, frame, 0).y, applied.crowd.position(0, frame).y + curve.at(way).y, 1e-4);
    }
    EXPECT_GT(way, 1.7);
}

TEST(Bend, AccelerationIsBoundByItselfAndToldWhereItIsNot) {
    const std::string points = R"("points": [{"frame": 24, "by": [0, 0.1]}])";
    const AppliedLayers gentle(R"([{"name": "bend", "who": {"rows": [0, 3]}, "do": {"bend": {)" + points +
                                   R"(, "most_acceleration": 2}}}])",
                               {}, false);
    EXPECT_TRUE(gentle.results[0].sharp.empty());
    EXPECT_TRUE(gentle.results[0].remarks.empty());
    // 0.1 m in 6 frames, a quarter of a second, frame by frame.
    const authoring::BendCurve curve({{24.0, {0.0, 0.1}}}, 6.0, 6.0);
    double most = 0.0;
    for (double at = 17.0; at < 31.0; ++at)
        most = std::max(most, std::abs(curve.at(at + 1.0).y - 2.0 * curve.at(at).y + curve.at(at - 1.0).y) *
                                  kBendFps * kBendFps);
    const AppliedLayers sharp(R"([{"name": "bend", "who": {"rows": [0, 3]}, "do": {"bend": {)" + points +
                                  R"(, "falloff": 6, "most_acceleration": 2}}}])",
                              {}, false);
    ASSERT_EQ(sharp.results[0].sharp.size(), 4u);
    EXPECT_NEAR(sharp.results[0].sharp[0].acceleration, most, 1e-9);
    EXPECT_GT(most, 7.0);
    EXPECT_NE(sharp.results[0].remarks.at(0).find("more than 2 m/s^2 to 4 of them"), std::string::npos);
}

TEST(Bend, WhatComesAfterwardsComesOnTop) {
    const std::string bend =
        R"({"name": "bend", "who": {"rows": [0, 0]},
            "do": {"bend": {"points": [{"frame": 24, "by": [0, 1]}], "falloff": 16, "most_acceleration": 50}}})";
    const AppliedLayers applied(
        "[" + bend + R"(, {"name": "late", "who": {"rows": [0, 0]}, "do": {"retime": {"offset": 5}}},
                         {"name": "more", "who": {"rows": [0, 0]}, "do": {"duplicate": {"by": [0, 30, 0]}}}])");
    const authoring::BendCurve curve({{24.0, {0.0, 1.0}}}, 16.0, 16.0);
    for (const std::uint32_t frame : {10u, 29u, 40u}) {
        const glm::dvec2 expected = applied.crowd.position(0, frame - 5) + curve.at(frame - 5);
        EXPECT_NEAR(placeOf(applied, frame, 0).y, expected.y, 1e-5);
        EXPECT_NEAR(placeOf(applied, frame, 64).y, expected.y + 30.0, 1e-5);
    }
    const AppliedLayers twice("[" + bend + R"(, {"name": "back", "who": {"rows": [0, 0]}, "do": {"bend": {
        "points": [{"frame": 24, "by": [0, -1]}], "falloff": 16, "most_acceleration": 50}}}])");
    EXPECT_NEAR(placeOf(twice, 24, 0).y, twice.crowd.position(0, 24).y, 1e-5) << "and back";
    const AppliedLayers before(
        R"([{"name": "move", "who": {"rows": [0, 0]}, "do": {"move": {"by": [0, 7, 0]}}}, )" + bend + "]");
    EXPECT_NEAR(placeOf(before, 24, 0).y, before.crowd.position(0, 24).y + 8.0, 1e-5) << "moved once";
    const AppliedLayers absent(
        R"([{"name": "bend", "who": {"rows": [63, 63]}, "do": {"bend": {"points": [{"frame": 9, "by": [0, 1]}]}}}])");
    EXPECT_EQ(absent.results[0].remarks.at(0), "1 of them are not there when their ways would be bent");
}

TEST(Bend, OverlapsThatItMakesAreToldWithTheirFrames) {
    // Lanes are 0.9 m apart: 0.85 m to the side is nearly where row 2 walks, one lane further.
    const AppliedLayers applied(
        R"([{"name": "bend", "who": {"rows": [0, 0]},
             "do": {"bend": {"points": [{"frame": 24, "by": [0, 0.85]}], "falloff": 16, "most_acceleration": 50}}}])");
    ASSERT_FALSE(applied.result->overlaps.empty());
    const Overlap& overlap = applied.result->overlaps.front();
    EXPECT_EQ(overlap.row, 0u);
    EXPECT_EQ(overlap.other, 2u);
    double deepest = 0.0;
    std::uint32_t first = kBendFrames, last = 0, at = 0;
    for (std::uint32_t frame = 0; frame < kBendFrames; ++frame) {
        const double depth =
            0.22 + 0.24 - glm::distance(placeOf(applied, frame, 0), placeOf(applied, frame, 2));
        if (depth <= OverlapWatch::kLeast) continue;
        first = std::min(first, frame);
        last = frame;
        if (depth > deepest) deepest = depth, at = frame;
    }
    EXPECT_NEAR(overlap.depth, deepest, 1e-5);
    EXPECT_EQ(overlap.first, first);
    EXPECT_EQ(overlap.last, last);
    EXPECT_EQ(overlap.deepest, at);
}

}  // namespace
}  // namespace throng::io
