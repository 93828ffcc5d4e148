// SPDX-License-Identifier: Apache-2.0
// The way to a seat through an opening in a stand.
#include "authoring/layout/seat_mouths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace throng::authoring {
namespace {

/// Twelve rows, people look up; the opening is on the fourth row, the aisle in the middle.
SeatBlock block(SeatBlock::Mouths::At at = SeatBlock::Mouths::At::row) {
    SeatBlock made;
    made.front = {{-6.0, 0.0}, {6.0, 0.0}};
    made.rows = 12;
    made.pitch = 0.9;
    made.rise = 0.4;
    made.height = 1.0;
    made.aisles = 1;
    made.mouths.at = at;
    made.mouths.row = 4;
    made.mouths.height = -0.5;
    return made;
}

std::vector<double> xOfRow(const SeatBlock& of, std::size_t row) {
    std::vector<double> found;
    for (const Seat& seat : seatsOf(of))
        if (seat.row == row) found.push_back(seat.place.x);
    return found;
}

TEST(SeatMouths, RowsAreCutAsFarAsThePassageNeedsHeadroom) {
    const SeatBlock of = block();
    // The floor goes from 2.2 m down to -0.5 m over 8.35 m; the rows behind rise by 0.4 m each 0.9 m.
    EXPECT_NEAR(passageLength(of), 8 * 0.9 + 0.7, 1e-9);
    EXPECT_EQ(landingRow(of), 3u);
    const std::size_t last = lastCutRow(of);
    const auto roomUnder = [&](std::size_t row) {
        const double behind = (static_cast<double>(row) - 4.0) * 0.9;
        const double floor = 2.2 - 2.7 * behind / passageLength(of);
        return 1.0 + 0.4 * static_cast<double>(row) - 0.15 - floor;
    };
    EXPECT_GE(roomUnder(last), kPassageHeadroom);
    EXPECT_LT(roomUnder(last - 1), kPassageHeadroom);
    const auto gap = [&](std::size_t row) {
        double nearest = 9.0;
        for (const double x : xOfRow(of, row))
            nearest = std::min(nearest, std::abs(x));
        return 2.0 * nearest;
    };
    for (std::size_t row = 0; row < 12; ++row) {
        const bool is_cut = row >= 3 && row <= last;
        EXPECT_NEAR(gapOfRow(of, row), is_cut ? 3.2 : 1.2, 1e-9) << row;
        EXPECT_GE(gap(row), gapOfRow(of, row)) << row;
    }
}

TEST(SeatMouths, WaysShareThePassageAndRiseWithTheRows) {
    const SeatBlock of = block();
    for (const Seat& seat : seatsOf(of)) {
        const AisleWay way = BlockWays(of).to(0, seat);
        EXPECT_NEAR(glm::distance(way.points.front().place, passageFoot(of, 0)), 0.0, 1e-9);
        EXPECT_EQ(way.points.front().height, -0.5);
        EXPECT_NEAR(way.fork, passageLength(of) + std::hypot(0.0, 0.45 + passingAhead(of)), 0.2);
        EXPECT_EQ(way.branch, seat.row < 3 ? 0u : seat.place.x > 0.0 ? 1u : 2u);
        EXPECT_NEAR(way.points.back().height, seat.height, 1e-9);
        EXPECT_NEAR(way.points.back().place.x, seat.place.x, 1e-6);
        for (std::size_t i = 1; i < way.points.size(); ++i) {
            EXPECT_GT(way.points[i].along, way.points[i - 1].along);
            // Two who follow each other where nobody comes in are as far apart as `along` says, but for
            // corners.
            const AislePoint &a = way.points[i - 1], &b = way.points[i];
            EXPECT_NEAR(glm::distance(a.place + a.alone, b.place + b.alone), b.along - a.along, 1e-6);
        }
        const auto mouth = std::ranges::find(way.points, way.mouth, &AislePoint::along);
        ASSERT_NE(mouth, way.points.end());
        EXPECT_NEAR(mouth->height, seat.height, 1e-9);
    }
}

TEST(SeatMouths, WhoLeavesAloneKeepsToTheSideOfItsSeat) {
    const SeatBlock of = block();
    for (const Seat& seat : seatsOf(of)) {
        const AisleWay way = BlockWays(of).to(0, seat);
        for (const AislePoint& point : way.points)
            EXPECT_GE((point.place + point.alone).x * (seat.place.x > 0.0 ? 1.0 : -1.0), 0.0);
        // Who comes in keeps to its right: in the passage, which leads to the front, towards the row's end.
        EXPECT_GT(way.points.front().beside.x, 0.2);
    }
}

TEST(SeatMouths, BehindTheBlockThereIsNoOpening) {
    const SeatBlock of = block(SeatBlock::Mouths::At::back);
    EXPECT_EQ(landingRow(of), 11u);
    EXPECT_EQ(lastCutRow(of), 11u);
    for (std::size_t row = 0; row < 12; ++row)
        EXPECT_EQ(gapOfRow(of, row), 1.2);
    EXPECT_NEAR(passageFoot(of, 0).y, -(11.5 * 0.9 + 0.7), 1e-9);
    for (const Seat& seat : seatsOf(of))
        EXPECT_EQ(BlockWays(of).to(0, seat).branch, 0u);
}

TEST(SeatMouths, NobodyElseWalksWhereThePassageIsTooLow) {
    const SeatBlock of = block();
    const std::vector<glm::dvec2> outline = passageOutline(of, 0);
    ASSERT_EQ(outline.size(), 4u);
    const double foot = passageFoot(of, 0).y;
    EXPECT_NEAR(outline[0].y, foot + 0.7, 1e-6) << "room to step off it";
    const double share = (outline[2].y - foot) / passageLength(of);
    EXPECT_NEAR(2.7 * share, kPassageHeadroom + 0.15, 0.05) << "and beyond, one walks under it";
}

}  // namespace
}  // namespace throng::authoring
