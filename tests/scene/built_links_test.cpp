// SPDX-License-Identifier: Apache-2.0
// What links take out of a terrain: the openings that they cut into its faces, and the ground that they
// become.
#include "authoring/storeys/built_links.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "authoring/storeys/mesh_cut.h"
#include "authoring/storeys/walkable.h"

namespace throng::authoring {
namespace {

void addFace(TerrainMesh& mesh, const std::vector<glm::dvec3>& corners) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), corners.begin(), corners.end());
    for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u})
        mesh.indices.push_back(first + corner);
}

void addFloor(TerrainMesh& mesh, glm::dvec2 a, glm::dvec2 b, double height) {
    addFace(mesh, {{a.x, a.y, height}, {b.x, a.y, height}, {b.x, b.y, height}, {a.x, b.y, height}});
}

/// Looks down.
void addCeiling(TerrainMesh& mesh, glm::dvec2 a, glm::dvec2 b, double height) {
    addFace(mesh, {{a.x, a.y, height}, {a.x, b.y, height}, {b.x, b.y, height}, {b.x, a.y, height}});
}

/// Upright, along y.
void addWallFace(TerrainMesh& mesh, double x, glm::dvec2 along, glm::dvec2 heights) {
    addFace(
        mesh,
        {{x, along.x, heights.x}, {x, along.y, heights.x}, {x, along.y, heights.y}, {x, along.x, heights.y}});
}

/// A box that is turned, from one height to another.
UprightSolid solidAt(glm::dvec2 middle, glm::dvec2 half, double angle, double low, double high) {
    const glm::dvec2 along(std::cos(angle), std::sin(angle)), left(-along.y, along.x);
    UprightSolid solid;
    for (const auto& [way, size] : {std::pair(along, half.x), std::pair(left, half.y)})
        for (const double sign : {1.0, -1.0})
            solid.sides.push_back({{sign * way, 0.0}, sign * glm::dot(way, middle) + size});
    solid.ends = {{{0.0, 0.0, 1.0}, high}, {{0.0, 0.0, -1.0}, -low}};
    return solid;
}

/// m^2, of faces whose normals' upward part lies in a range.
double areaOf(const TerrainMesh& mesh, double least_up = -2.0, double most_up = 2.0) {
    double area = 0.0;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::dvec3 a = mesh.positions[mesh.indices[i]];
        const glm::dvec3 across =
            glm::cross(mesh.positions[mesh.indices[i + 1]] - a, mesh.positions[mesh.indices[i + 2]] - a);
        const double size = glm::length(across);
        if (size > 0.0 && across.z / size >= least_up && across.z / size <= most_up) area += 0.5 * size;
    }
    return area;
}

TEST(MeshCut, ASolidTakesWhatIsInItAndNothingElse) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-3.0, 3.0), size(0.05, 1.0), angle(0.0, std::numbers::pi);
    for (int i = 0; i < 63; ++i) {
        TerrainMesh floor;
        addFloor(floor, {-5, -5}, {5, 5}, 0.7);
        const glm::dvec2 middle{place(random), place(random)}, half{size(random), size(random)};
        const UprightSolid solid = solidAt(middle, half, angle(random), 0.0, 1.0);
        const CutMesh cut = cutOut(floor, {solid}, false);
        EXPECT_NEAR(areaOf(cut.mesh), 100.0 - 4.0 * half.x * half.y, 1.0e-6);
        EXPECT_FALSE(cut.walls[0]) << "a floor is no wall";
        for (std::size_t k = 0; k + 2 < cut.mesh.indices.size(); k += 3) {
            glm::dvec3 inside(0.0);
            for (std::size_t corner = 0; corner < 3; ++corner)
                inside += cut.mesh.positions[cut.mesh.indices[k + corner]] / 3.0;
            EXPECT_TRUE(std::ranges::any_of(solid.sides, [&](const HalfSpace& side) {
                return side.beyond(inside) > -1.0e-9;
            })) << i;
        }
    }
}

TEST(MeshCut, WhatOnlyTouchesASolidStays) {
    TerrainMesh floor;
    addFloor(floor, {0, 0}, {2, 2}, 0.0);
    for (const UprightSolid& solid :
         {solidAt({3, 1}, {1, 1}, 0.0, -1.0, 1.0), solidAt({1, 1}, {5, 5}, 0.0, 0.5, 2.0),
          solidAt({1, 1}, {5, 5}, 0.0, -2.0, -0.5)}) {
        const CutMesh cut = cutOut(floor, {solid}, true);
        EXPECT_EQ(cut.mesh.indices, floor.indices);
        EXPECT_EQ(cut.mesh.positions, floor.positions);
    }
}

TEST(MeshCut, SolidsThatLeaveFloorsTakeParapetsOnly) {
    TerrainMesh mesh;
    addFloor(mesh, {-2, -2}, {2, 2}, 0.0);
    addWallFace(mesh, 0.0, {-2, 2}, {0, 1});
    UprightSolid solid = solidAt({0, 0}, {0.5, 0.75}, 0.0, -0.5, 1.5);
    solid.takes_floors = false;
    const CutMesh cut = cutOut(mesh, {solid}, false);
    EXPECT_NEAR(areaOf(cut.mesh, 0.9), 16.0, 1.0e-9);
    EXPECT_NEAR(areaOf(cut.mesh, -0.1, 0.1), 4.0 - 1.5, 1.0e-9);
}

TEST(MeshCut, TellsOfWhatIsAsHighAsAWall) {
    const auto wallAt = [](std::vector<glm::dvec2> heights) {
        TerrainMesh mesh;
        for (const glm::dvec2 each : heights)
            addWallFace(mesh, 0.1, {-0.1, 0.1}, each);
        return cutOut(mesh, {solidAt({0, 0}, {1, 1}, 0.0, 0.0, 2.2)}, false).walls[0];
    };
    EXPECT_FALSE(wallAt({{0.0, 1.1}})) << "a parapet";
    EXPECT_FALSE(wallAt({{-3.0, 1.1}})) << "as little of it is in the way";
    ASSERT_TRUE(wallAt({{0.0, 3.0}}));
    EXPECT_NEAR(wallAt({{0.0, 3.0}})->x, 0.1, 1.0e-9);
    EXPECT_TRUE(wallAt({{0.0, 0.6}, {0.6, 1.2}, {1.2, 1.9}})) << "of courses, each of them low";
}

TEST(MeshCut, SlabsGetSidesDownToTheirUndersides) {
    TerrainMesh slab;
    addFloor(slab, {-5, -5}, {5, 5}, 4.0);
    const std::vector<UprightSolid> solids = {solidAt({0, 0}, {1, 2}, 0.3, 2.0, 6.0)};
    const double rim = 2.0 * (2.0 + 4.0);  // m
    EXPECT_NEAR(areaOf(cutOut(slab, solids, true).mesh, -0.1, 0.1), rim * 0.25, 1.0e-6)
        << "a quarter of a metre where no underside is known";
    addCeiling(slab, {-5, -5}, {5, 5}, 3.6);
    const CutMesh cut = cutOut(slab, solids, true);
    EXPECT_NEAR(areaOf(cut.mesh, -0.1, 0.1), rim * 0.4, 1.0e-6);
    EXPECT_NEAR(areaOf(cut.mesh, 0.9), 92.0, 1.0e-6);
    EXPECT_NEAR(areaOf(cut.mesh, -2.0, -0.9), 92.0, 1.0e-6);
    EXPECT_EQ(areaOf(cutOut(slab, solids, false).mesh, -0.1, 0.1), 0.0);
}

/// A plain, and a plate over all of it that stairs lead onto in its middle.
struct Gallery {
    static constexpr double kHigh = 4.0, kRun = 8.0, kWidth = 2.0;  // m
    TerrainMesh terrain;
    Layout layout;
    Gallery() {
        addFloor(terrain, {-20, -10}, {20, 10}, 0.0);
        addFloor(terrain, {-20, -10}, {20, 10}, kHigh);
        layout.levels.resize(2);
        layout.levels[0].id = "plain";
        layout.levels[1].id = "plate";
        Link stairs;
        stairs.id = "stairs";
        stairs.to = 1;
        stairs.begin = {-kRun, 0};
        stairs.end = {0, 0};
        stairs.width = kWidth;
        stairs.heights = glm::dvec2(0.0, kHigh);
        layout.links = {stairs};
    }
    /// Heights on which one stands there.
    static std::vector<double> standingAt(const TerrainMesh& mesh, glm::dvec2 place) {
        const Walkable ground(mesh, {-20, -10}, {20, 10});
        const auto [begin, end] = ground.spotsOf(chartCellOf(place));
        std::vector<double> heights;
        for (auto spot = begin; spot < end; ++spot)
            heights.push_back(ground.spots()[spot].height);
        std::ranges::sort(heights);
        return heights;
    }
};

TEST(BuiltLinks, StairsAreGroundAndThePlateOverThemIsOpen) {
    const Gallery gallery;
    const BuiltLinks built = buildLinks(gallery.terrain, gallery.layout);
    ASSERT_EQ(built.parts.size(), 1u);
    EXPECT_TRUE(built.walls.empty());
    const Footprint& flight = built.parts[0].chart.link;
    EXPECT_EQ(glm::dvec2(flight.low, flight.high), glm::dvec2(0.0, Gallery::kHigh));
    const auto expectStanding = [&](double x, std::vector<double> expected) {
        const std::vector<double> heights = Gallery::standingAt(built.walked, {x, 0.1});
        ASSERT_EQ(heights.size(), expected.size()) << x;
        for (std::size_t i = 0; i < heights.size(); ++i)
            EXPECT_NEAR(heights[i], expected[i], 0.2) << x;  // a tread's height
    };
    expectStanding(-6.1, {0.95, Gallery::kHigh});
    expectStanding(-3.9, {2.05});       // the plate is open, and there is no room below
    expectStanding(-1.9, {0.0, 3.05});  // one stands below
    EXPECT_EQ(Gallery::standingAt(built.walked, {-2, 3}).size(), 2u) << "beside them, below and above";
}

TEST(BuiltLinks, OpenAsMuchOfAFloorAsPeopleNeedOverTheirHeads) {
    const Gallery gallery;
    const BuiltLinks built = buildLinks(gallery.terrain, gallery.layout);
    constexpr double kTread = 0.2;  // m: treads are so far over the slope
    const double open_from = (Gallery::kHigh - kHeadroom - kTread) / Gallery::kHigh * Gallery::kRun;
    const double opening = (Gallery::kRun - open_from) * 2.0 * built.parts[0].chart.link.half_width;
    const auto level = [](const TerrainMesh& mesh, double height) {
        double area = 0.0;
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            const glm::dvec3 a = mesh.positions[mesh.indices[i]], b = mesh.positions[mesh.indices[i + 1]],
                             c = mesh.positions[mesh.indices[i + 2]];
            if (a.z == height && b.z == height && c.z == height)
                area += 0.5 * glm::length(glm::cross(b - a, c - a));
        }
        return area;
    };
    EXPECT_NEAR(level(built.seen, Gallery::kHigh), level(gallery.terrain, Gallery::kHigh) - opening, 0.02);
}

TEST(BuiltLinks, AWallInTheWayIsToldOfTheLink) {
    Gallery gallery;
    addWallFace(gallery.terrain, -5.0, {-10, 10}, {0.0, 3.5});
    const BuiltLinks built = buildLinks(gallery.terrain, gallery.layout);
    ASSERT_FALSE(built.walls.empty());
    EXPECT_EQ(built.walls[0].link, 0u);
    EXPECT_NEAR(built.walls[0].at.x, -5.0, 1.0e-9);
}

}  // namespace
}  // namespace throng::authoring
