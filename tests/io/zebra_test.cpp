// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/zebra.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "io/gltf/meshes.h"

namespace throng::io {
namespace {

authoring::Lane laneOf(std::vector<glm::dvec2> points) {
    authoring::Lane lane;
    lane.points = std::move(points);
    return lane;
}

TEST(Zebra, StripesLieAlongTheLaneAndCoverHalf) {
    const std::array<glm::dvec2, 4> crossing{{{-4, -4}, {4, -4}, {4, 4}, {-4, 4}}};
    const auto stripes = zebraStripes(crossing, {1.0, 0.0}, 0.5);
    ASSERT_EQ(stripes.size(), 8u);
    for (std::size_t i = 0; i < stripes.size(); ++i) {
        EXPECT_NEAR(std::abs(signedArea(stripes[i])), 4.0, 1e-9);
        for (const glm::dvec2 point : stripes[i]) {
            EXPECT_LE(std::abs(point.x), 4.0);
            EXPECT_GE(point.y, -3.75 + static_cast<double>(i) - 1e-9);
            EXPECT_LE(point.y, -3.25 + static_cast<double>(i) + 1e-9);
        }
    }
}

TEST(Zebra, StripesEndWhereTheCrossingDoes) {
    const std::array<glm::dvec2, 3> triangle{{{0, 0}, {8, 0}, {0, 8}}};
    const double half = std::sqrt(0.5);
    double area = 0.0;
    for (const auto& stripe : zebraStripes(triangle, {half, half}, 0.5)) {
        area += std::abs(signedArea(stripe));
        for (const glm::dvec2 point : stripe) {
            EXPECT_GE(std::min(point.x, point.y), -1e-9);
            EXPECT_LE(point.x + point.y, 8.0 + 1e-9);
        }
    }
    EXPECT_NEAR(area, 16.0, 1.5);
}

TEST(Zebra, TheNearestPieceOfALaneTellsTheWay) {
    const std::array<authoring::Lane, 2> lanes{laneOf({{0, 0}, {10, 0}, {10, 10}}),
                                               laneOf({{0, 50}, {-3, 54}})};
    EXPECT_EQ(wayBeside(lanes, {4, 1}), glm::dvec2(1, 0));
    EXPECT_EQ(wayBeside(lanes, {12, 6}), glm::dvec2(0, 1));
    EXPECT_NEAR(wayBeside(lanes, {-1, 60}).x, -0.6, 1e-12);
    EXPECT_EQ(wayBeside({}, {4, 1}), glm::dvec2(1, 0));
}

}  // namespace
}  // namespace throng::io
