// SPDX-License-Identifier: Apache-2.0
// Seats on a terrain: a plane whose heights are known, and what cannot be.
#include "authoring/scene/seat_ground.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "authoring/layout/layout_reader.h"
#include "authoring/layout/row_floor.h"
#include "authoring/layout/seat_rows.h"
#include "authoring/scene/audience.h"
#include "authoring/scene/scene_builder.h"

namespace throng::authoring {
namespace {

/// m: 0.2 up to the east and 0.1 up to the north.
double plane(glm::dvec2 at) {
    return 5.0 + 0.2 * at.x + 0.1 * at.y;
}

/// Two triangles, far enough all round. @param steeper times as steep
TerrainMesh planeMesh(double half = 80.0, double steeper = 1.0) {
    TerrainMesh mesh;
    for (const glm::dvec2 at : {glm::dvec2(-half, -half), glm::dvec2(half, -half), glm::dvec2(half, half),
                                glm::dvec2(-half, half)}) {
        mesh.positions.emplace_back(at, 5.0 + steeper * (plane(at) - 5.0));
        mesh.normals.emplace_back(0.0f, 0.0f, 1.0f);
    }
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

const std::string kTerrain = R"({"throng": 1, "simulation": {"duration": 60},
 "terrain": {"file": "plane.glb", "surface": "highest"}, )";

/// What is said of a layout on the plane.
std::vector<Diagnostic> saidOf(const std::string& rest, Layout& layout, const TerrainMesh& mesh) {
    Diagnostics diagnostics;
    auto read = readLayout(kTerrain + rest + "}", {}, diagnostics);
    if (read) {
        layout = std::move(*read);
        layOnTerrain(layout, mesh, diagnostics);
    }
    return diagnostics.entries;
}

Layout laid(const std::string& rest, const TerrainMesh& mesh = planeMesh()) {
    Layout layout;
    for (const Diagnostic& entry : saidOf(rest, layout, mesh))
        ADD_FAILURE() << entry.message;
    return layout;
}

std::string block(const std::string& front, std::size_t rows, const std::string& more) {
    return R"("seats": [{"id": "a", "front": )" + front + R"(, "rows": )" + std::to_string(rows) + more +
           "}]";
}

class SeatGround : public testing::TestWithParam<std::size_t> {};  // rows

TEST_P(SeatGround, RowsAreLevelAcrossAndNowhereBelowTheGround) {
    // Looking north, the front edge of a row is the higher one; looking south, the back edge. Half of 0.8 m.
    for (const auto& [front, edge] : {std::pair(std::string("[[-6, 3], [6.3, 3]]"), 0.4),
                                      std::pair(std::string("[[6.3, 3], [-6, 3]]"), 0.4)}) {
        const Layout layout = laid(block(front, GetParam(), R"(, "on_terrain": true)"));
        const std::vector<Seat> seats = seatsOf(layout.seats.front());
        EXPECT_EQ(seats.size(), 24u * GetParam());
        for (const Seat& seat : seats)
            EXPECT_NEAR(seat.height, plane(seat.place) + 0.1 * edge, 1e-4);
    }
}

TEST_P(SeatGround, HeightAndRiseCountOverIt) {
    const Layout layout = laid(block("[[0, 0], [0, 9]]", GetParam(),
                                     R"(, "on_terrain": true, "height": 0.5, "rise": 0.25, "pitch": 1)"));
    for (const Seat& seat : seatsOf(layout.seats.front()))
        EXPECT_NEAR(seat.height, plane(seat.place) + 0.2 * 0.5 + 0.5 + 0.25 * static_cast<double>(seat.row),
                    1e-4);
}

TEST_P(SeatGround, LinesOfRowsFollowIt) {
    const Layout layout = laid(
        R"("seats": [{"id": "a", "arc": {"centre": [3, -2], "radius": 8, "from": 10, "to": 130}, "aisles": 2,
 "on_terrain": true, "rows": )" +
        std::to_string(std::min<std::size_t>(GetParam(), 40)) + "}]");
    const SeatBlock& of = layout.seats.front();
    for (const SeatRow& row : seatRows(of)) {
        ASSERT_EQ(row.heights.size(), row.line.size());
        double lowest = 1e9;
        for (std::size_t i = 0; i < row.line.size(); ++i) {
            // Somewhere between the heights of its edges, which are half a pitch to either side.
            EXPECT_GE(row.heights[i], plane(row.line[i]) - 1e-4);
            EXPECT_LE(row.heights[i], plane(row.line[i]) + 0.4 * std::hypot(0.2, 0.1) * 1.05);
            if (i > 0) {
                EXPECT_LE(glm::distance(row.line[i], row.line[i - 1]), 0.51);
            }
            lowest = std::min(lowest, row.heights[i]);
        }
        EXPECT_EQ(row.height, lowest);
    }
}

INSTANTIATE_TEST_SUITE_P(Rows, SeatGround, testing::Values(1, 7, 63));

TEST(SeatGround, BlocksThatStandLevelDoSoOnATerrainToo) {
    const Layout layout = laid(block("[[-6, 0], [6, 0]]", 3, R"(, "height": 9, "rise": 0.4)"));
    for (const Seat& seat : seatsOf(layout.seats.front()))
        EXPECT_EQ(seat.height, 9.0 + 0.4 * static_cast<double>(seat.row));
    EXPECT_TRUE(seatRows(layout.seats.front()).front().heights.empty());
    // The lowest corner: 6 m to the west, 2.5 rows of 0.8 m behind.
    EXPECT_NEAR(lowestGround(layout.seats.front()).value_or(0.0), plane({-6.0, -2.0}), 1e-4);
}

TEST(SeatGround, SpectatorsOfClosedBlocksSitOnIt) {
    const Layout layout = laid(block("[[-6, 0], [6, 0]]", 2, R"(, "on_terrain": true)"));
    const std::vector<Spectator> audience = audienceOf(layout);
    ASSERT_EQ(audience.size(), 48u);
    for (const Spectator& each : audience)
        EXPECT_NEAR(each.seat.height, plane(each.seat.place) + 0.04, 1e-4);
}

const std::string kGuests =
    R"("areas": [{"id": "gate", "polygon": [[-20, 8], [-12, 8], [-12, 14], [-20, 14]]}],
 "flows": [{"id": "guests", "from": "gate", "to": {"seats": "a"}, "count": 9, "end": 20}], )";

/// Who walks to seats or leaves them: from the ground at the foot of an aisle up and along the rows.
TEST(SeatGround, WaysToSeatsBeginOnTheGroundAndEndAtTheSeat) {
    for (const std::string more : {R"(, "aisles": 1, "on_terrain": true, "occupancy": 0.5)",
                                   R"(, "on_terrain": true, "occupancy": 0.5)",
                                   R"(, "aisles": 1, "height": 5, "rise": 0.3, "occupancy": 0.5)"}) {
        const TerrainMesh mesh = planeMesh();
        const Layout layout = laid(kGuests + block("[[-6, 0], [6, 0]]", 4, more), mesh);
        Diagnostics diagnostics;
        const std::optional<Scene> scene = buildScene(layout, diagnostics, nullptr, &mesh);
        for (const Diagnostic& entry : diagnostics.entries)
            ADD_FAILURE() << entry.message;
        ASSERT_TRUE(scene);
        const auto count = scene->seats.ways.size();
        EXPECT_EQ(count, 9u + audienceIn(layout, 0).size());
        for (const gpu::SeatWay& way : scene->seats.ways) {
            const gpu::SeatPoint* points = &scene->seats.points[way.first_point];
            const gpu::SeatPoint& last = points[way.point_count - 1];
            EXPECT_NEAR(points[0].height, plane(scene->origin + glm::dvec2(points[0].place)), 2e-3);
            EXPECT_NEAR(last.height, way.height, 1e-4);
            for (std::uint32_t i = 1; i < way.point_count; ++i)
                EXPECT_LE(std::abs(points[i].height - points[i - 1].height),
                          0.8f * (points[i].along - points[i - 1].along) + 0.011f);
        }
    }
}

void expectMistake(const std::string& rest, const std::string& words, const std::string& hint,
                   const TerrainMesh& mesh = planeMesh()) {
    Layout layout;
    std::vector<Diagnostic> said = saidOf(rest, layout, mesh);
    if (said.empty()) {
        Diagnostics diagnostics;
        buildScene(layout, diagnostics, nullptr, &mesh);
        said = diagnostics.entries;
    }
    ASSERT_EQ(said.size(), 1u) << words;
    EXPECT_NE(said[0].message.find(words), std::string::npos) << said[0].message;
    EXPECT_NE(said[0].hint.find(hint), std::string::npos) << said[0].hint;
    EXPECT_GT(said[0].where.line, 0u);
}

TEST(SeatGround, WhatCannotStandThereIsTold) {
    const std::string front = "[[-6, 0], [6, 0]]", aisle = R"(, "aisles": 1, "occupancy": 0)";
    expectMistake(block("[[70, 0], [90, 0]]", 2, R"(, "on_terrain": true)"),
                  "block `a`: there is no ground of the terrain under row 1, at [80.", "move the block");
    expectMistake(block(front, 2, R"(, "on_terrain": true)"),
                  "block `a`: row 1 climbs 0.50 m over 0.50 m at [-5.50, 0.00]: people climb at most 80 %",
                  "less steep", planeMesh(80.0, 5.0));
    expectMistake(kGuests + block(front, 3, aisle + R"(, "on_terrain": true)"),
                  "from the ground to its first row, climbs 1.69 m over 0.80 m at [0.00, 0.30]", "less steep",
                  [] {
                      TerrainMesh mesh = planeMesh();
                      for (glm::dvec3& at : mesh.positions)
                          at.z = -1.125 * at.y;
                      return mesh;
                  }());
    expectMistake(kGuests + block(front, 3, aisle),
                  "block `a`: aisle 1, from the ground to its first row, climbs 5.", R"("on_terrain": true)");
    expectMistake(
        kGuests + block(front, 3, aisle + R"(, "height": 5, "mouths": {"at": "back", "passage": 9})"),
        "by passages: these are for flat ground and levels only", "leave out its `mouths`");
    expectMistake(block(front, 3, R"(, "on_terrain": true, "aisles": 1, "mouths": {"at": "back"})"),
                  "block `a` has passages: these are of level stands only", "leave out its `mouths`");
}

TEST(SeatGround, WithoutATerrainThereIsNothingToGoUpAndDownWith) {
    Diagnostics diagnostics;
    readLayout(R"({"throng": 1, )" + block("[[0, 0], [5, 0]]", 1, R"(, "on_terrain": true)") + "}", {},
               diagnostics);
    ASSERT_EQ(diagnostics.entries.size(), 1u);
    EXPECT_EQ(diagnostics.entries[0].message, "there is no terrain that the block could go up and down with");
}

}  // namespace
}  // namespace throng::authoring
