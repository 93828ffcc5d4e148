// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/fields.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/packing.hpp>

namespace throng::authoring {
namespace {

WalkGeometry openGround(float extent) {
    WalkGeometry geometry;
    geometry.minimum = {0.0f, 0.0f};
    geometry.maximum = {extent, extent};
    return geometry;
}

void addWall(WalkGeometry& geometry, glm::vec2 a, glm::vec2 b, float half_thickness = 0.0f) {
    geometry.walls.push_back({a, b, half_thickness, 0});
}

glm::vec2 centreOf(const FieldGrid& grid, std::uint32_t cell) {
    return grid.minimum + (glm::vec2(cell % grid.width, cell / grid.width) + 0.5f) * grid.cell_size;
}

Field fieldTo(const WalkGeometry& geometry, glm::vec2 target, bool keep_to_roads = false) {
    const FieldGrid grid = makeGrid(geometry);
    const std::uint32_t cell = cellAt(grid, target);
    return solveField(makeWalkMap(geometry, grid, keep_to_roads), std::vector{cell});
}

float distanceAt(const WalkGeometry& geometry, const Field& field, glm::vec2 point) {
    return field.reachable[cellAt(makeGrid(geometry), point)];
}

TEST(Fields, MeasureStraightDistancesOnOpenGround) {
    const WalkGeometry geometry = openGround(40.0f);
    const FieldGrid grid = makeGrid(geometry);
    const Field field = fieldTo(geometry, {13.0f, 21.0f});
    const glm::vec2 target = centreOf(grid, cellAt(grid, {13.0f, 21.0f}));
    double worst_distance = 0.0;
    double worst_angle = 0.0;
    for (std::uint32_t cell = 0; cell < field.cells.size(); cell += 7) {
        const glm::vec2 offset = target - centreOf(grid, cell);
        const float exact = glm::length(offset);
        if (exact < 2.0f) continue;
        worst_distance =
            std::max(worst_distance, std::abs(field.reachable[cell] / static_cast<double>(exact) - 1.0));
        const glm::vec2 direction = glm::unpackSnorm2x16(field.cells[cell].direction);
        const float cosine = glm::dot(direction, offset / exact);
        worst_angle =
            std::max(worst_angle, static_cast<double>(std::acos(std::min(1.0f, cosine))) * 57.29578);
    }
    EXPECT_LT(worst_distance, 0.015);
    EXPECT_LT(worst_angle, 3.0) << "degrees";
}

TEST(Fields, LeadRoundTheEndOfAWallByTheShortestWay) {
    WalkGeometry geometry = openGround(30.0f);
    addWall(geometry, {15.0f, 0.0f}, {15.0f, 20.0f});
    const Field field = fieldTo(geometry, {25.0f, 5.0f});
    // Round the wall's end, with room for a body.
    const float exact = glm::distance(glm::vec2(5.0f, 5.0f), glm::vec2(15.0f, 20.3f)) +
                        glm::distance(glm::vec2(15.0f, 20.3f), glm::vec2(25.0f, 5.0f));
    EXPECT_NEAR(distanceAt(geometry, field, {5.0f, 5.0f}) / exact, 1.0f, 0.03f);
}

TEST(Fields, DoNotLeakThroughThinWallsInAnyDirection) {
    for (const glm::vec2 end : {glm::vec2(10.0f, 30.0f), glm::vec2(30.0f, 30.0f), glm::vec2(17.0f, 30.0f)}) {
        WalkGeometry geometry = openGround(30.0f);
        addWall(geometry, {10.0f - (end.x - 10.0f) * 0.01f, -1.0f}, {end.x, end.y + 1.0f});
        const Field field = fieldTo(geometry, {2.0f, 28.0f});
        EXPECT_EQ(distanceAt(geometry, field, {28.0f, 2.0f}), kUnreachable) << end.x;
        // The GPU gets finite numbers all the same.
        for (const gpu::FieldCell& cell : field.cells)
            ASSERT_TRUE(std::isfinite(cell.distance));
    }
}

TEST(Fields, ADoorALittleWiderThanABodyStaysOpen) {
    for (const float extent : {10.0f, 60.0f, 120.0f}) {
        WalkGeometry geometry = openGround(extent);
        const float middle = 0.5f * extent + 0.037f;
        addWall(geometry, {middle, -1.0f}, {middle, middle - 0.3f});
        addWall(geometry, {middle, middle + 0.3f}, {middle, extent + 1.0f});
        EXPECT_LT(distanceAt(geometry, fieldTo(geometry, {1.0f, middle}), {extent - 1.0f, middle}),
                  1.5f * extent)
            << extent;
    }
}

TEST(Fields, NobodyStandsInsideASolidPolygonOfEitherWinding) {
    for (const bool reversed : {false, true}) {
        WalkGeometry geometry = openGround(20.0f);
        LocalPolygon solid = {{5, 5}, {15, 5}, {15, 15}, {5, 15}};
        if (reversed) std::reverse(solid.begin(), solid.end());
        geometry.solids.push_back(solid);
        for (std::size_t i = 0; i < 4; ++i)
            addWall(geometry, solid[i], solid[(i + 1) % 4]);
        const Field field = fieldTo(geometry, {2.0f, 10.0f});
        EXPECT_EQ(distanceAt(geometry, field, {10.0f, 10.0f}), kUnreachable);
        EXPECT_GT(distanceAt(geometry, field, {18.0f, 10.0f}), 18.0f);
        // Whoever is pushed inside is led out again.
        const FieldGrid grid = makeGrid(geometry);
        const glm::vec2 direction = glm::unpackSnorm2x16(field.cells[cellAt(grid, {6.0f, 10.0f})].direction);
        EXPECT_LT(direction.x, -0.9f);
    }
}

TEST(Fields, LeadOutOfADeadEnd) {
    WalkGeometry geometry = openGround(30.0f);
    addWall(geometry, {20.0f, 10.0f}, {20.0f, 20.0f});  // a U, open to the left, the goal behind it
    addWall(geometry, {10.0f, 10.0f}, {20.0f, 10.0f});
    addWall(geometry, {10.0f, 20.0f}, {20.0f, 20.0f});
    const Field field = fieldTo(geometry, {25.0f, 15.0f});
    const FieldGrid grid = makeGrid(geometry);
    EXPECT_LT(glm::unpackSnorm2x16(field.cells[cellAt(grid, {18.0f, 15.0f})].direction).x, 0.0f)
        << "away from the goal at first";
    EXPECT_GT(distanceAt(geometry, field, {18.0f, 15.0f}), 25.0f);
}

TEST(Fields, KeepToRoadsAndObeyOneWays) {
    WalkGeometry geometry = openGround(60.0f);
    geometry.roads.push_back({{{5, 10}, {55, 10}}, 4.0f, true});
    geometry.roads.push_back({{{5, 30}, {55, 30}}, 4.0f, false});
    geometry.roads.push_back({{{7, 10}, {7, 30}}, 4.0f, false});
    geometry.roads.push_back({{{53, 10}, {53, 30}}, 4.0f, false});
    const Field along = fieldTo(geometry, {54.0f, 10.0f}, true);
    EXPECT_NEAR(distanceAt(geometry, along, {12.0f, 10.0f}), 42.0f, 2.0f);
    const Field against = fieldTo(geometry, {6.0f, 10.0f}, true);
    EXPECT_GT(distanceAt(geometry, against, {48.0f, 10.0f}), 60.0f)
        << "the way back is round by the other road";
    EXPECT_LT(distanceAt(geometry, against, {48.0f, 10.0f}), 130.0f);
}

TEST(CoarseMap, KeepsNarrowDoorsOpenAndThinWallsClosedInAnyDirection) {
    for (const double turn : {0.0, 0.13, 0.4, 0.785, 1.2}) {
        const auto place = [&](double along, double across) {
            return glm::vec2(20.3 + along * std::cos(turn) - across * std::sin(turn),
                             20.1 + along * std::sin(turn) + across * std::cos(turn));
        };
        for (const bool door : {true, false}) {
            WalkGeometry geometry = openGround(40.0f);
            addWall(geometry, place(-40.0, 0.0), place(door ? -0.45 : 0.0, 0.0));
            addWall(geometry, place(door ? 0.45 : 0.0, 0.0), place(40.0, 0.0));
            const FieldGrid coarse = makeGrid(geometry, 0.75f, 30'000.0);
            const WalkMap map = coarsen(makeWalkMap(geometry, makeGrid(geometry), false), coarse).map;
            const std::vector<std::uint32_t> target = {cellAt(coarse, place(0.0, 10.0))};
            const Field field = solveField(map, target);
            const float found = field.reachable[cellAt(coarse, place(0.0, -10.0))];
            if (door) {
                EXPECT_NEAR(found, 20.0f, 2.5f) << turn;
            } else {
                EXPECT_EQ(found, kUnreachable) << turn;
            }
        }
    }
}

TEST(CoarseMap, GroundBehindAThinWallBelongsToNoCellOnThisSide) {
    WalkGeometry geometry = openGround(12.0f);
    addWall(geometry, {6.2f, -1.0f},
            {6.2f, 13.0f});  // off the middle of its cells, which reach from 6.0 to 6.75
    const FieldGrid grid = makeGrid(geometry), coarse = makeGrid(geometry, 0.75f, 30'000.0);
    const CoarseMap map = coarsen(makeWalkMap(geometry, grid, false), coarse);
    for (std::uint32_t cell = 0; cell < map.cell_of.size(); ++cell) {
        if (map.cell_of[cell] == gpu::NO_INDEX) continue;
        const Field field = solveField(map.map, std::vector{map.cell_of[cell]});
        const bool east = centreOf(grid, cell).x > 6.2f;
        ASSERT_EQ(field.reachable[cellAt(coarse, {1.0f, 6.0f})] == kUnreachable, east);
        cell += 97;  // some of them
    }
}

TEST(RoadDistance, HasNoEdgeWhereARoadMeetsAnArea) {
    WalkGeometry geometry = openGround(40.0f);
    geometry.roads.push_back({{{2, 20}, {20, 20}}, 6.0f, false});
    geometry.areas.push_back({{20, 10}, {35, 10}, {35, 30}, {20, 30}});
    const FieldGrid grid = makeGrid(geometry);
    const std::vector<float> distance = roadDistance(geometry, grid);
    EXPECT_NEAR(distance[cellAt(grid, {10.0f, 20.0f})], 3.0f, grid.cell_size);
    EXPECT_NEAR(distance[cellAt(grid, {10.0f, 22.0f})], 1.0f, grid.cell_size);
    EXPECT_GT(distance[cellAt(grid, {20.0f, 20.0f})], 2.5f) << "at the seam";
    EXPECT_NEAR(distance[cellAt(grid, {10.0f, 25.0f})], -2.0f, grid.cell_size);
    EXPECT_TRUE(roadDistance(openGround(10.0f), makeGrid(openGround(10.0f))).empty());
}

TEST(WalkMaps, HoldTheLastOfTheOneWayRoadsThatLieOverEachOther) {
    WalkGeometry geometry = openGround(20.0f);
    geometry.roads = {{{{2.0f, 10.0f}, {18.0f, 10.0f}}, 6.0f, true},
                      {{{10.0f, 2.0f}, {10.0f, 18.0f}, {15.0f, 18.0f}}, 6.0f, true},
                      {{{2.0f, 4.0f}, {18.0f, 4.0f}}, 3.0f, false}};
    const FieldGrid grid = makeGrid(geometry);
    const WalkMap map = makeWalkMap(geometry, grid, true);
    const auto way = [&](float x, float y) { return map.one_way[cellAt(grid, {x, y})]; };
    EXPECT_EQ(way(4.0f, 10.0f), glm::vec2(1.0f, 0.0f));
    EXPECT_EQ(way(10.0f, 10.0f), glm::vec2(0.0f, 1.0f)) << "the second road's, not the first one's";
    EXPECT_EQ(way(11.0f, 17.0f), glm::vec2(1.0f, 0.0f)) << "of its pieces, the later one's";
    EXPECT_EQ(way(10.0f, 4.0f), glm::vec2(0.0f)) << "a road that one may walk both ways lies over it";
    EXPECT_EQ(way(4.0f, 17.0f), glm::vec2(0.0f)) << "no road";
}

}  // namespace
}  // namespace throng::authoring
