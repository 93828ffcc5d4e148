// SPDX-License-Identifier: Apache-2.0
// Terrains with faces above each other: where people can stand, what is cut into which charts, and where it
// ends.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "authoring/storeys/chart_raster.h"
#include "authoring/storeys/cut.h"
#include "authoring/storeys/surface_edges.h"

namespace throng::authoring {
namespace {

constexpr double kMargin = 5.0;  // m

void addFace(TerrainMesh& mesh, const std::vector<glm::dvec3>& corners) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), corners.begin(), corners.end());
    for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u})
        mesh.indices.push_back(first + corner);
}

/// Rises along x.
void addRamp(TerrainMesh& mesh, glm::dvec2 a, glm::dvec2 b, double low, double high) {
    addFace(mesh, {{a.x, a.y, low}, {b.x, a.y, high}, {b.x, b.y, high}, {a.x, b.y, low}});
}

/// A plain with a plate of 4 m over its middle, and a ramp at either end of that.
std::shared_ptr<const Walkable> bridge() {
    TerrainMesh mesh;
    addRamp(mesh, {-40, -15}, {40, 15}, 0, 0);
    addRamp(mesh, {-30, -2}, {-10, 2}, 0, 4);
    addRamp(mesh, {-10, -2}, {10, 2}, 4, 4);
    addRamp(mesh, {10, -2}, {30, 2}, 4, 0);
    return std::make_shared<const Walkable>(mesh, glm::dvec2(-40, -15), glm::dvec2(40, 15));
}

std::vector<Surface> cut(const std::shared_ptr<const Walkable>& ground) {
    const Pieces pieces = piecesOf(*ground);
    return cutIntoSurfaces(ground, pieces, std::vector<bool>(pieces.spots.size(), true), kMargin);
}

TEST(Walkable, PeopleStandOnWhatHasHeadroom) {
    const auto ground = bridge();
    const auto countAt = [&](glm::dvec2 place) {
        const auto [begin, end] = ground->spotsOf(chartCellOf(place));
        return end - begin;
    };
    EXPECT_EQ(countAt({0.1, 0.1}), 2u);
    EXPECT_EQ(countAt({0.1, 5.1}), 1u);
    EXPECT_EQ(countAt({-21.0, 0.1}), 1u);  // 1.8 m below the ramp
    EXPECT_EQ(countAt({-19.0, 0.1}), 2u);  // 2.2 m
    EXPECT_EQ(piecesOf(*ground).spots.size(), 1u);
}

TEST(Walkable, AnUprightFaceIsInTheWay) {
    TerrainMesh mesh;
    addRamp(mesh, {-5, -5}, {5, 5}, 0, 0);
    addFace(mesh, {{0.1, -5, 0}, {0.1, 5, 0}, {0.1, 5, 1.2}, {0.1, -5, 1.2}});
    const Walkable ground(mesh, {-5, -5}, {5, 5});
    EXPECT_EQ(piecesOf(ground).spots.size(), 2u);
    const std::uint32_t beside = ground.nearestSpot(chartCellOf({-0.1, 0.1}), 0.0);
    EXPECT_NEAR(ground.roomBeside(beside, 0), 0.1 - chartCellMiddle(chartCellOf({-0.1, 0.1})).x, 2e-3);
}

/// Each spot is on one chart, no chart lies over itself, and beyond a seam a chart has no ground of its own.
TEST(Cut, ChartsHaveRoomToShowEachOther) {
    const auto ground = bridge();
    const std::vector<Surface> surfaces = cut(ground);
    ASSERT_EQ(surfaces.size(), 2u);
    std::vector<int> times(ground->spots().size(), 0);
    for (const Surface& surface : surfaces)
        for (const std::uint32_t spot : surface.spots)
            if (spot != kNoSpot) ++times[spot];
    EXPECT_TRUE(std::ranges::all_of(times, [](int count) { return count == 1; }));
    EXPECT_TRUE(surfaces[0].contains({0.1, 0.1}));
    EXPECT_LT(surfaces[0].heightAt({0.1, 0.1}), 0.1);
    EXPECT_GT(surfaces[1].heightAt({0.1, 0.1}), 3.9);
    double seam = 0.0;  // how far up the ramp the ground goes
    for (double x = -30.0; x < -20.0; x += kChartCell)
        if (surfaces[0].contains({x + 0.1, 0.1})) seam = x + kChartCell;
    EXPECT_NEAR(seam, -20.0 - kMargin, 0.6);  // at -20 it has 2 m of headroom below
    EXPECT_TRUE(areJoined(surfaces[0], {seam - 0.1, 0.1}, surfaces[1], {seam + 0.1, 0.1}));
    EXPECT_FALSE(areJoined(surfaces[0], {0.1, 0.1}, surfaces[1], {0.3, 0.1}));
}

TEST(SurfaceEdges, LieWhereTheMeshEndsAndLeaveNoGap) {
    const std::vector<Surface> surfaces = cut(bridge());
    const std::vector<SurfaceEdge> edges = edgesOf(surfaces);
    double deck = 0.0, outside = 0.0;
    for (const SurfaceEdge& edge : edges)
        for (std::size_t i = 0; i + 1 < edge.points.size(); ++i) {
            const glm::dvec2 a = edge.points[i], b = edge.points[i + 1];
            if (edge.surface == 1) {
                EXPECT_NEAR(std::abs(a.y), 2.0, 5e-3);
                deck += glm::distance(a, b);
            } else if (std::abs(a.y) > 10.0 || std::abs(a.x) > 35.0) {
                outside += glm::distance(a, b);
            }
        }
    EXPECT_NEAR(deck, 2 * 50.0, 1.0);
    EXPECT_NEAR(outside, 2 * 80.0 + 2 * 30.0, 0.5);
}

TEST(SurfaceEdges, OutlinesGoRoundAllOfASurface) {
    const std::vector<Surface> surfaces = cut(bridge());
    const std::vector<glm::dvec2> outline = outlineOf(surfaces[0]);
    double twice = 0.0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 a = outline[i], b = outline[(i + 1) % outline.size()];
        twice += a.x * b.y - a.y * b.x;
    }
    EXPECT_NEAR(0.5 * twice, 80.0 * 30.0, 1.0);
}

}  // namespace
}  // namespace throng::authoring
