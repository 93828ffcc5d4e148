// SPDX-License-Identifier: Apache-2.0
#include "authoring/terrain/terrain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "authoring/layout/layout_reader.h"
#include "authoring/scene/scene_builder.h"

namespace throng::test {
namespace {

using authoring::Terrain;
using authoring::TerrainMesh;

void addQuad(TerrainMesh& mesh, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c, glm::dvec3 d) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const glm::dvec3& corner : {a, b, c, d}) {
        mesh.positions.push_back(corner);
        mesh.normals.emplace_back(0.0f, 0.0f, 1.0f);
    }
    for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u})
        mesh.indices.push_back(first + i);
}

TerrainMesh surface(const std::function<double(double, double)>& height, double half, double cell) {
    TerrainMesh mesh;
    for (double y = -half; y < half; y += cell)
        for (double x = -half; x < half; x += cell) {
            const auto at = [&](double px, double py) { return glm::dvec3(px, py, height(px, py)); };
            addQuad(mesh, at(x, y), at(x + cell, y), at(x + cell, y + cell), at(x, y + cell));
        }
    return mesh;
}

/// Twenty treads of 0.3 m, 0.17 m high each, up along x from 0.
TerrainMesh stairs() {
    TerrainMesh mesh;
    addQuad(mesh, {-10, -5, 0}, {0, -5, 0}, {0, 5, 0}, {-10, 5, 0});
    for (int i = 0; i < 20; ++i) {
        const double x = 0.3 * i, z = 0.17 * (i + 1);
        addQuad(mesh, {x, -5, z - 0.17}, {x, 5, z - 0.17}, {x, 5, z}, {x, -5, z});  // the riser
        addQuad(mesh, {x, -5, z}, {x + 0.3, -5, z}, {x + 0.3, 5, z}, {x, 5, z});
    }
    addQuad(mesh, {6, -5, 3.4}, {16, -5, 3.4}, {16, 5, 3.4}, {6, 5, 3.4});
    return mesh;
}

Terrain terrainOf(const TerrainMesh& mesh, bool highest = true, glm::dvec2 origin = {0, 0}) {
    return Terrain(mesh, highest, origin, {-9, -4}, {9, 4});
}

TEST(Terrain, IsExactOnAPlaneWhateverTheOrigin) {
    const auto plane = [](double x, double y) { return 12.0 + 0.1 * x - 0.37 * y; };
    for (const glm::dvec2 origin : {glm::dvec2(0.0), glm::dvec2(500'000.0, 4'200'000.0)}) {
        TerrainMesh mesh = surface(plane, 15.0, 2.5);
        for (glm::dvec3& p : mesh.positions)
            p += glm::dvec3(origin, 0.0);
        const Terrain terrain = terrainOf(mesh, true, origin);
        for (float y = -3.9f; y < 4.0f; y += 0.13f)
            for (float x = -8.9f; x < 9.0f; x += 0.17f) {
                ASSERT_TRUE(terrain.groundAt({x, y}));
                EXPECT_NEAR(*terrain.groundAt({x, y}), plane(x, y), 1e-4);
                EXPECT_NEAR(terrain.smoothAt({x, y}), plane(x, y), 1e-4);
                EXPECT_NEAR(terrain.slopeAt({x, y}).x, 0.1, 1e-4);
                EXPECT_NEAR(terrain.slopeAt({x, y}).y, -0.37, 1e-4);
            }
        EXPECT_LT(terrain.nodes()[terrain.nodes().size() / 2].steps, 0.05f) << "no stairs";
    }
}

TEST(Terrain, GoesOnAsItSlopesBeyondItsEdge) {
    TerrainMesh mesh;  // a ramp that is just as wide as what is asked
    addQuad(mesh, {-20, -1, -4}, {20, -1, 4}, {20, 1, 4}, {-20, 1, -4});
    const Terrain terrain = terrainOf(mesh);
    for (const float y : {-1.9f, -1.0f, 0.0f, 0.99f, 1.9f}) {
        EXPECT_NEAR(terrain.heightAt({2.5f, y}), 0.5, 1e-3) << y;
        EXPECT_NEAR(terrain.slopeAt({2.5f, y}).x, 0.2, 1e-3) << y;
        EXPECT_NEAR(terrain.slopeAt({2.5f, y}).y, 0.0, 2e-3) << y;
    }
    EXPECT_FALSE(terrain.groundAt({2.5f, 1.1f}));
}

TEST(Terrain, StairsAreTreadsAndOneSlope) {
    const Terrain terrain = terrainOf(stairs());
    for (int i = 2; i < 18; ++i) {
        const float x = 0.3f * static_cast<float>(i);
        EXPECT_NEAR(*terrain.groundAt({x + 0.01f, 0.3f}), 0.17 * (i + 1), 1e-4);
        EXPECT_NEAR(*terrain.groundAt({x + 0.29f, 0.3f}), 0.17 * (i + 1), 1e-4);
        for (const float offset : {0.0f, 0.1f, 0.2f}) {
            EXPECT_NEAR(terrain.smoothAt({x + offset, 0.3f}), 0.17 / 0.3 * double{x + offset} + 0.085, 0.02);
            EXPECT_NEAR(terrain.slopeAt({x + offset, 0.3f}).x, 0.17 / 0.3, 0.06);
        }
    }
    const auto stepsAt = [&](float x) {
        const glm::vec2 node = (glm::vec2(x, 0.0f) - terrain.minimum()) / terrain.lattice().cell;
        return terrain
            .nodes()[static_cast<std::size_t>(node.y) * terrain.lattice().width +
                     static_cast<std::size_t>(node.x)]
            .steps;
    };
    EXPECT_GT(stepsAt(3.0f), 0.9f);
    EXPECT_LT(stepsAt(-5.0f), 0.1f);
}

TEST(Terrain, OfSeveralStoreysOneCounts) {
    TerrainMesh mesh = surface([](double, double) { return 1.0; }, 15.0, 5.0);
    addQuad(mesh, {-2, -10, 6}, {2, -10, 6}, {2, 10, 6}, {-2, 10, 6});
    addQuad(mesh, {-2, -10, 5.5}, {-2, 10, 5.5}, {2, 10, 5.5},
            {2, -10, 5.5});  // its underside, which looks down
    EXPECT_FLOAT_EQ(*terrainOf(mesh, true).groundAt({0.3f, 0.2f}), 6.0f);
    EXPECT_FLOAT_EQ(*terrainOf(mesh, false).groundAt({0.3f, 0.2f}), 1.0f);
    EXPECT_FLOAT_EQ(terrainOf(mesh).storeysAt({0.3f, 0.2f}), 5.0f);
    EXPECT_FLOAT_EQ(terrainOf(mesh).storeysAt({4.3f, 0.2f}), 0.0f);
}

TEST(Terrain, NoPointFallsBetweenNeighbours) {
    const Terrain terrain =
        terrainOf(surface([](double x, double y) { return std::sin(x) * std::cos(y); }, 12.0, 1.0));
    for (int i = -32; i <= 32; ++i)
        for (int j = -14; j <= 14; ++j)  // on corners, edges and diagonals
            EXPECT_TRUE(terrain.groundAt({0.25f * static_cast<float>(i), 0.25f * static_cast<float>(j)}))
                << i << " " << j;
}

class TerrainCheckTest : public ::testing::Test {
  protected:
    /// All that is said of a road of 12 m on a terrain.
    std::string said(const TerrainMesh& mesh, const std::string& more = "") {
        authoring::Diagnostics diagnostics;
        const auto layout =
            authoring::readLayout(R"({"throng": 1, "terrain": {"file": "hill.glb")" + more + R"(},
            "roads": [{"id": "street", "centreline": [[-6, 0], [6, 0]], "width": 4}],
            "flows": [{"id": "f", "from": "street:start", "to": "street:end", "count": 3}]})",
                                  {}, diagnostics);
        if (layout) made_ = buildScene(*layout, diagnostics, nullptr, &mesh).has_value();
        std::string text;
        for (const authoring::Diagnostic& entry : diagnostics.entries)
            text += entry.where.pointer() + ": " + entry.message + " (" + entry.hint + ")\n";
        return text;
    }
    bool made_ = false;
};

TEST_F(TerrainCheckTest, NothingIsSaidOfAHill) {
    EXPECT_EQ(said(surface([](double x, double y) { return 0.01 * (x * x + y * y); }, 15.0, 1.0)), "");
    EXPECT_TRUE(made_);
}

TEST_F(TerrainCheckTest, RoadsOffTheTerrainAreErrors) {
    const std::string text = said(surface([](double, double) { return 0.0; }, 4.0, 1.0));
    EXPECT_NE(text.find("/roads/0: road `street`: there is no ground"), std::string::npos) << text;
    EXPECT_NE(text.find("x from -4.00 to 4.00"), std::string::npos) << text;
    EXPECT_FALSE(made_);
}

TEST_F(TerrainCheckTest, ATerrainElsewhereSaysWhereItIs) {
    TerrainMesh mesh = surface([](double, double) { return 0.0; }, 4.0, 1.0);
    for (glm::dvec3& p : mesh.positions)
        p.x += 1000.0;
    const std::string text = said(mesh);
    EXPECT_NE(text.find("/terrain/file: no face of `hill.glb`"), std::string::npos) << text;
    EXPECT_NE(text.find("x from 996.00 to 1004.00"), std::string::npos) << text;
}

TEST_F(TerrainCheckTest, BridgesHolesAndCliffsAreToldOf) {
    TerrainMesh bridge = surface([](double, double) { return 1.0; }, 15.0, 1.0);
    addQuad(bridge, {-2, -10, 6}, {2, -10, 6}, {2, 10, 6}, {-2, 10, 6});
    const std::string two = said(bridge);
    EXPECT_NE(two.find("/terrain: two faces of the terrain lie above each other, up to 5.0 m apart, on 33"),
              std::string::npos)
        << two;
    EXPECT_TRUE(made_);
    const std::string cliff = said(surface([](double x, double) { return x > 2.0 ? 5.0 : 0.0; }, 15.0, 1.0));
    EXPECT_NE(cliff.find("steeper than 45 degrees"), std::string::npos) << cliff;
    TerrainMesh hole;
    addQuad(hole, {-9, -9, 0}, {9, -9, 0}, {9, 0.5, 0}, {-9, 0.5, 0});
    EXPECT_NE(said(hole).find("there is a hole in the terrain on"), std::string::npos);
}

TEST_F(TerrainCheckTest, LayoutsSayWhatIsWrongWithTheirTerrain) {
    const TerrainMesh mesh = surface([](double, double) { return 0.0; }, 15.0, 1.0);
    EXPECT_NE(said(mesh, R"(, "offset": [1, 2])").find("/terrain/offset: expected an offset [x, y, z]"),
              std::string::npos);
    EXPECT_NE(said(mesh, R"(, "scale": 0)").find("/terrain/scale: 0 is out of range"), std::string::npos);
    EXPECT_NE(
        said(mesh, R"(, "surface": "middle")").find("/terrain/surface: expected one of highest, lowest"),
        std::string::npos);
    EXPECT_NE(said(mesh, R"(, "nodes": "x")").find("did you mean `node`"), std::string::npos);
}

TEST(Terrain, OfAnyWidthAnswersAtItsVeryEdges) {
    TerrainMesh mesh;
    addQuad(mesh, {-1.0e9, -1.0e9, 2.0}, {1.0e9, -1.0e9, 2.0}, {1.0e9, 1.0e9, 2.0}, {-1.0e9, 1.0e9, 2.0});
    for (const glm::vec2 half :
         {glm::vec2(500'000.0f, 500'000.0f), glm::vec2(4.0e9f, 1.0f), glm::vec2(2.0f, 4.0e9f)}) {
        const Terrain terrain(mesh, true, {0.0, 0.0}, -half, half);
        EXPECT_LT(terrain.lattice().count(), 4'000'000u);
        for (const float x : {-2.0f, -1.0f, 0.0f, 1.0f, 2.0f})
            for (const float y : {-2.0f, -1.0f, 0.0f, 1.0f, 2.0f})
                EXPECT_TRUE(std::isfinite(terrain.smoothAt(glm::vec2(x, y) * half)));
    }
}

}  // namespace
}  // namespace throng::test
