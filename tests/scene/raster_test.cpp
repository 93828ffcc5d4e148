// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/raster.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "authoring/scene/wall_grid.h"
#include "authoring/scene/walls.h"

namespace throng::authoring {
namespace {

class Raster : public ::testing::Test {
  protected:
    Raster() {
        grid.minimum = {-10.0f, -7.0f};
        grid.cell_size = 0.37f;
        grid.width = 61;
        grid.height = 43;
    }
    float draw(float least, float most) { return std::uniform_real_distribution<float>(least, most)(engine); }
    glm::vec2 somewhere() { return {draw(-14.0f, 16.0f), draw(-11.0f, 12.0f)}; }
    template <class Holds>
    std::set<std::uint32_t> cellsWhere(Holds holds) const {
        std::set<std::uint32_t> cells;
        for (std::uint32_t y = 0; y < grid.height; ++y)
            for (std::uint32_t x = 0; x < grid.width; ++x)
                if (holds(cellCentre(grid, x, y))) cells.insert(y * grid.width + x);
        return cells;
    }
    FieldGrid grid;
    std::mt19937 engine{7};
};

TEST_F(Raster, VisitsAllCellsNearASegmentAndFewOthers) {
    for (int trial = 0; trial < 300; ++trial) {
        const glm::vec2 a = somewhere(), b = trial % 7 ? somewhere() : a;
        const float reach = draw(0.0f, 2.0f);
        std::set<std::uint32_t> visited;
        visitAlong(grid, a, b, reach, [&](std::uint32_t cell, glm::vec2) { visited.insert(cell); });
        for (const std::uint32_t cell :
             cellsWhere([&](glm::vec2 centre) { return segmentDistance(centre, a, b) <= reach; }))
            ASSERT_TRUE(visited.contains(cell)) << trial;
    }
    std::size_t visits = 0;
    visitAlong(grid, {-10.0f, -7.0f}, {12.0f, 8.0f}, 0.4f, [&](std::uint32_t, glm::vec2) { ++visits; });
    EXPECT_LT(visits, cellCount(grid) / 5);
}

TEST_F(Raster, FillsPolygonsAsOnePointAfterTheOtherWouldTell) {
    for (int trial = 0; trial < 200; ++trial) {
        std::vector<glm::vec2> polygon;
        for (int i = 0; i < 3 + trial % 9; ++i)
            polygon.push_back(somewhere());
        std::set<std::uint32_t> visited;
        visitInside(grid, polygon, [&](std::uint32_t cell, glm::vec2) { visited.insert(cell); });
        EXPECT_EQ(visited, cellsWhere([&](glm::vec2 centre) { return insidePolygon(polygon, centre); }))
            << trial;
    }
}

TEST_F(Raster, SortedWallsAnswerAsUnsortedOnes) {
    WalkGeometry plain;
    plain.minimum = {-14.0f, -11.0f};
    plain.maximum = {16.0f, 12.0f};
    for (std::uint32_t i = 0; i < 400; ++i) {
        const glm::vec2 a = somewhere();
        plain.walls.push_back(
            {a, a + glm::vec2(draw(-1.0f, 1.0f), draw(-1.0f, 1.0f)), i % 90 ? 0.05f : 1.0f, i});
    }
    plain.solids.push_back({{0.0f, 0.0f}, {4.0f, 0.0f}, {2.0f, 3.0f}});
    WalkGeometry sorted = plain;
    sortWalls(sorted);
    ASSERT_TRUE(sorted.wall_grid);
    for (int trial = 0; trial < 3000; ++trial) {
        const glm::vec2 a = somewhere(), b = trial % 2 ? somewhere() : a + glm::vec2(draw(-1.0f, 1.0f));
        const float radius = draw(0.0f, 1.5f), depth = wallDepth(plain, a, radius);
        ASSERT_EQ(depth > 0.0f, wallDepth(sorted, a, radius) > 0.0f);
        if (depth > 0.0f) {
            ASSERT_EQ(depth, wallDepth(sorted, a, radius));
        }
        ASSERT_EQ(straightIsClear(plain, a, b, 0.1f * radius), straightIsClear(sorted, a, b, 0.1f * radius));
    }
}

TEST_F(Raster, GridsOfLongThinLayoutsStaySmall) {
    WalkGeometry geometry;
    geometry.minimum = {-50'000.0f, 0.0f};
    geometry.maximum = {50'000.0f, 1.0f};
    EXPECT_LT(cellCount(makeGrid(geometry)), 1'000'000u);
}

}  // namespace
}  // namespace throng::authoring
