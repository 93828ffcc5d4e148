// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/narrow_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "authoring/scene/raster.h"
#include "authoring/scene/walls.h"

namespace throng::authoring {
namespace {

constexpr float kWidest = 2.0f;  // m

class NarrowPlaces : public ::testing::Test {
  protected:
    NarrowPlaces() {
        geometry.minimum = {-20.0f, -20.0f};
        geometry.maximum = {20.0f, 20.0f};
        geometry.smallest_radius = 0.2f;
    }
    void addWall(glm::vec2 a, glm::vec2 b, float half_thickness = 0.0f) {
        geometry.walls.push_back({a, b, half_thickness, static_cast<std::uint32_t>(geometry.walls.size())});
    }
    void addSolid(const LocalPolygon& outline) {
        for (std::size_t i = 0; i < outline.size(); ++i)
            addWall(outline[i], outline[(i + 1) % outline.size()]);
        geometry.solids.push_back(outline);
    }
    std::vector<glm::vec2> places() const { return narrowPlaces(geometry, kWidest); }
    WalkGeometry geometry;
};

TEST_F(NarrowPlaces, OpenGroundHasNone) {
    EXPECT_TRUE(places().empty());
}

TEST_F(NarrowPlaces, ADoorInAWallIsOneAtItsMiddle) {
    addWall({0.0f, -8.0f}, {0.0f, -0.4f});
    addWall({0.0f, 0.6f}, {0.0f, 8.0f});
    ASSERT_EQ(places().size(), 1u);
    EXPECT_NEAR(places()[0].x, 0.0f, 1e-5f);
    EXPECT_NEAR(places()[0].y, 0.1f, 1e-5f);
}

TEST_F(NarrowPlaces, WallsThatAreThickLeaveLessRoomBetweenThem) {
    addWall({0.0f, -8.0f}, {0.0f, -1.3f}, 0.4f);  // 1.7 m between the surfaces, 2.5 m between the ends
    addWall({0.0f, 1.2f}, {0.0f, 8.0f}, 0.4f);
    ASSERT_EQ(places().size(), 1u);
    EXPECT_NEAR(places()[0].y, -0.05f, 1e-5f);
    geometry.walls[1].half_thickness = 0.05f;  // 2.05 m
    EXPECT_TRUE(places().empty());
}

TEST_F(NarrowPlaces, AGapThatNobodyFitsThroughIsNone) {
    addWall({0.0f, -8.0f}, {0.0f, 0.0f});
    addWall({0.0f, 0.39f}, {0.0f, 8.0f});
    EXPECT_TRUE(places().empty());
    geometry.smallest_radius = 0.19f;
    EXPECT_EQ(places().size(), 1u);
}

TEST_F(NarrowPlaces, ANarrowCorridorHasThemAllAlongAndAWideOneNone) {
    addWall({-5.0f, 0.0f}, {5.0f, 0.0f});
    addWall({-5.0f, 1.8f}, {5.0f, 1.8f});
    const auto found = places();
    for (float x = -4.9f; x < 5.0f; x += 0.1f)
        EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](glm::vec2 place) {
            return glm::distance(place, glm::vec2(x, 0.9f)) < 0.3f;
        })) << x;
    EXPECT_TRUE(std::all_of(found.begin(), found.end(),
                            [](glm::vec2 place) { return std::abs(place.y - 0.9f) < 1e-4f; }));
    EXPECT_LE(found.size(), 41u) << "one in 0.25 m, not one for each wall";
    geometry.walls[1].a.y = geometry.walls[1].b.y = 2.1f;
    EXPECT_TRUE(places().empty());
}

TEST_F(NarrowPlaces, ACornerIsNone) {
    addWall({0.0f, 0.0f}, {6.0f, 0.0f});
    addWall({0.0f, 0.0f}, {0.0f, 6.0f});
    EXPECT_TRUE(places().empty());
}

TEST_F(NarrowPlaces, AWallBetweenTwoOthersPartsThem) {
    addWall({-5.0f, 0.0f}, {5.0f, 0.0f});
    addWall({-5.0f, 0.3f}, {5.0f, 0.3f});  // on both sides too little room for anybody
    addWall({-5.0f, 0.6f}, {5.0f, 0.6f});
    EXPECT_TRUE(places().empty());
}

TEST_F(NarrowPlaces, TheInsideOfABlockIsNoneAndThePassageBetweenTwoBlocksIs) {
    addSolid({{-4.0f, -1.0f}, {4.0f, -1.0f}, {4.0f, 0.0f}, {-4.0f, 0.0f}});  // 1 m deep
    EXPECT_TRUE(places().empty());
    addSolid({{-4.0f, 1.5f}, {4.0f, 1.5f}, {4.0f, 2.5f}, {-4.0f, 2.5f}});
    const auto found = places();
    ASSERT_FALSE(found.empty());
    for (const glm::vec2 place : found)
        EXPECT_NEAR(place.y, 0.75f, 1e-4f);
}

TEST_F(NarrowPlaces, AreTheSameWhereWallsAreSorted) {
    for (int i = 0; i < 300; ++i) {  // a fence of posts, 1 m apart, and another across it
        const auto at = static_cast<float>(i % 150) * 0.2f - 15.0f;
        if (i < 150)
            addWall({at, 3.0f}, {at + 0.05f, 3.0f});
        else
            addWall({at, 4.5f}, {at + 0.05f, 4.5f});
    }
    const auto found = places();
    ASSERT_FALSE(found.empty());
    sortWalls(geometry);
    ASSERT_TRUE(geometry.wall_grid);
    EXPECT_EQ(places(), found);
}

}  // namespace
}  // namespace throng::authoring
