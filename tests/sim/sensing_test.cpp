// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "sim/benchmarks/proximity_benchmark.h"
#include "sim/diagram/bands.h"
#include "sim/sensing_pattern.h"
#include "sim/simulation_parts.h"
#include "tests/sim/gpu_test.h"
#include "tests/sim/scenes.h"

namespace throng::test {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

TEST(SensingPattern, FollowsThePapersEquations) {
    // a = 0.3, r_s = 0.6, s = 6: R = 3.3; theta = arccos(1 - 0.36 / 21.78) = 0.18207 rad; 200 degrees / theta
    // = 19.2 gaps between rays, so 20 gaps and 21 rays; all round, 34.5 and so 35.
    const sim::SensingGeometry geometry{0.3f, 0.6f, 6, 200.0f * kPi / 180.0f};
    EXPECT_FLOAT_EQ(sim::sensingReach(geometry), 3.3f);
    EXPECT_EQ(sim::raysAtRadius(geometry, 3.3f), 21);
    EXPECT_EQ(sim::fullPattern(geometry).size(), 21u * 6u);
    EXPECT_EQ(sim::raysAtRadius({0.3f, 0.6f, 6, 2.0f * kPi}, 3.3f), 35);
}

TEST(SensingPattern, LeavesNoGapAboveTheTileRadius) {
    for (const float view : {0.5f, 200.0f * kPi / 180.0f, 2.0f * kPi})
        for (const float tile : {0.25f, 0.6f, 1.5f}) {
            const sim::SensingGeometry geometry{0.25f, tile, 6, view};
            for (const auto& pattern : {sim::fullPattern(geometry), sim::thinnedPattern(geometry, 0.0f)}) {
                // On each circle, neighbouring samples lie at most M apart.
                for (int ring = 0; ring < geometry.samples_per_ray; ++ring) {
                    const float radius = geometry.body_radius + static_cast<float>(ring) * tile;
                    std::vector<float> angles;
                    for (const glm::vec2 sample : pattern)
                        if (std::abs(std::hypot(sample.x, sample.y) - radius) < 1.0e-3f)
                            angles.push_back(std::atan2(sample.y, sample.x));
                    ASSERT_FALSE(angles.empty());
                    std::sort(angles.begin(), angles.end());
                    for (std::size_t i = 1; i < angles.size(); ++i) {
                        const float gap = 2.0f * radius * std::sin(0.5f * (angles[i] - angles[i - 1]));
                        EXPECT_LE(gap, tile * 1.0001f) << "view " << view << ", ring " << ring;
                    }
                }
            }
        }
}

TEST(SensingPattern, StaysInsideTheFieldOfView) {
    const sim::SensingGeometry geometry{0.25f, 0.6f, 6, 1.0f};
    for (const glm::vec2 sample : sim::thinnedPattern(geometry, 1.0f)) {
        EXPECT_LE(std::abs(std::atan2(sample.y, sample.x)), 0.5001f);
        EXPECT_GT(std::hypot(sample.x, sample.y), 1.0f);
    }
}

using sim::senseNow;

/// The k nearest within the reach and the field of view, plus everybody within the contact range, by
/// comparing all.
std::vector<std::uint32_t> nearestByBruteForce(const authoring::Scene& scene, std::uint32_t row, float reach,
                                               float contact_range) {
    const gpu::Person& self = scene.people[row];
    const float half_view = static_cast<float>(scene.settings.field_of_view) * kPi / 360.0f;
    std::vector<std::pair<float, std::uint32_t>> found;
    for (std::uint32_t other = 0; other < scene.people.size(); ++other) {
        if (other == row) continue;
        const glm::vec2 offset = scene.people[other].spawn_position - self.spawn_position;
        const float distance = std::hypot(offset.x, offset.y);
        float turn = std::atan2(offset.y, offset.x) - self.heading;
        turn -= 2.0f * kPi * std::round(turn / (2.0f * kPi));
        if (distance <= contact_range || (distance <= reach && std::abs(turn) <= half_view))
            found.emplace_back(distance, other);
    }
    std::sort(found.begin(), found.end());
    const auto most = std::min(found.size(), static_cast<std::size_t>(scene.settings.neighbours));
    std::vector<std::uint32_t> rows;
    for (std::size_t i = 0; i < most; ++i)
        rows.push_back(found[i].second);
    return rows;
}

float distanceBetween(const authoring::Scene& scene, std::uint32_t row, std::uint32_t other) {
    return glm::distance(scene.people[row].spawn_position, scene.people[other].spawn_position);
}

class SensingTest : public GpuTest {
  protected:
    /// The share of true nearest neighbours that sensing found. Samples also meet some whose tile, but not
    /// whose centre, is in view; where such a one is nearer and the list is full, the true neighbour it
    /// displaces is not a miss.
    double recall(authoring::Scene scene) {
        sim::Simulation simulation(scene, library);
        const auto lists = senseNow(simulation);
        const sim::SensingGeometry geometry{
            scene.smallest_radius, static_cast<float>(scene.settings.tile_radius),
            scene.settings.samples_per_ray, static_cast<float>(scene.settings.field_of_view) * kPi / 180.0f};
        std::size_t expected = 0, found = 0;
        for (std::uint32_t row = 0; row < scene.people.size(); ++row) {
            const std::set<std::uint32_t> list(lists[row].begin(), lists[row].end());
            const bool full = list.size() == static_cast<std::size_t>(scene.settings.neighbours);
            const float farthest = full ? distanceBetween(scene, row, lists[row].back()) : INFINITY;
            for (const std::uint32_t other : nearestByBruteForce(scene, row, sim::sensingReach(geometry),
                                                                 simulation.parameters().contact_range)) {
                if (distanceBetween(scene, row, other) > farthest) continue;
                ++expected;
                found += list.count(other);
            }
        }
        const double share = expected ? static_cast<double>(found) / static_cast<double>(expected) : 1.0;
        RecordProperty("recall", std::to_string(share));
        std::printf("    recall %.4f %% of %zu neighbours\n", 100.0 * share, expected);
        return share;
    }
};

TEST_F(SensingTest, FindsNearlyAllNeighboursInOpenCrowds) {
    for (const std::uint32_t count : {2u, 63u, 1234u, 4096u})
        EXPECT_GE(recall(uniformScene(count, 2.0f, count)), 0.995) << count;
}

/// Crowding cuts the tiles until some are narrower than the gap between samples: the bars are what was
/// measured, less a little. Whoever is within the contact range is never among the missed.
TEST_F(SensingTest, LosesFewNeighboursWhenCrowdingCutsTheTiles) {
    struct Bar {
        float spacing, tile_radius;
        double least;
    };
    for (const Bar bar : {Bar{1.0f, 0.6f, 0.99}, Bar{0.75f, 0.6f, 0.94}, Bar{0.62f, 0.6f, 0.93},  //
                          Bar{1.0f, 0.3f, 0.998}, Bar{0.75f, 0.3f, 0.998}, Bar{0.62f, 0.3f, 0.997}}) {
        authoring::Scene scene = uniformScene(1234, bar.spacing, 5);
        scene.settings.tile_radius = bar.tile_radius;
        scene.settings.samples_per_ray = bar.tile_radius < 0.5f ? 11 : 6;
        EXPECT_GE(recall(scene), bar.least)
            << "tile radius " << bar.tile_radius << ", one person per " << bar.spacing << " m squared";
    }
}

TEST_F(SensingTest, DoesNotSeeBehindItselfBeyondTheContactRange) {
    authoring::Scene scene = emptyScene({-10, -10}, {10, 10});
    addPerson(scene, {0, 0}, {5, 0});
    addPerson(scene, {2, 0}, {9, 0});       // ahead
    addPerson(scene, {-2, 0}, {-9, 0});     // behind, out of touch
    addPerson(scene, {-0.8f, 0}, {-9, 0});  // behind, within the contact range
    sim::Simulation simulation(scene, library);
    const auto lists = senseNow(simulation);
    EXPECT_EQ(std::set<std::uint32_t>(lists[0].begin(), lists[0].end()), (std::set<std::uint32_t>{1, 3}));
    EXPECT_EQ(lists[0].front(), 3u) << "the nearest comes first";
}

TEST_F(SensingTest, SeesALongWallAsOneNeighbour) {
    authoring::Scene scene = emptyScene({-10, -10}, {10, 10});
    addPerson(scene, {0, 0}, {5, 0});
    addPerson(scene, {2.5f, 0.5f}, {5, 0});
    addWall(scene, {-8, 1.5f}, {8, 1.5f});
    sim::Simulation simulation(scene, library);
    const auto lists = senseNow(simulation);
    EXPECT_EQ(std::set<std::uint32_t>(lists[0].begin(), lists[0].end()),
              (std::set<std::uint32_t>{1u, gpu::NEIGHBOUR_IS_WALL | 0u}));
}

TEST_F(SensingTest, KeepsTheNearestWhenThereAreMoreThanTheListHolds) {
    authoring::Scene scene = emptyScene({-10, -10}, {10, 10});
    scene.settings.neighbours = 4;
    addPerson(scene, {0, 0}, {5, 0});
    for (int i = 0; i < 24; ++i) {
        const float angle = (static_cast<float>(i) - 11.5f) / 24.0f * 3.0f;
        const float distance = 1.1f + 0.08f * static_cast<float>((i * 7) % 24);
        addPerson(scene, {distance * std::cos(angle), distance * std::sin(angle)}, {5, 0}, 1.3f, 0.1f);
    }
    scene.settings.tile_radius = 0.2;
    scene.settings.samples_per_ray = 20;
    sim::Simulation simulation(scene, library);
    EXPECT_EQ(senseNow(simulation)[0],
              nearestByBruteForce(scene, 0, 4.0f, simulation.parameters().contact_range));
}

TEST_F(SensingTest, EveryExactDiagramGivesTheSameNeighbours) {
    authoring::Scene scene = uniformScene(1234, 1.2f, 21);
    addWall(scene, {5, 5}, {30, 22});
    scene.settings.method = authoring::DiagramMethod::per_site;
    sim::Simulation per_site(scene, library);
    const auto expected = senseNow(per_site);
    for (const auto& entry : authoring::kDiagramMethods) {
        if (!entry.exact || entry.method == authoring::DiagramMethod::per_site) continue;
        scene.settings.method = entry.method;
        sim::Simulation other(scene, library);
        EXPECT_EQ(senseNow(other), expected) << entry.word;
    }
}

TEST_F(SensingTest, FewPeopleAmongManyWallsSenseWhatTheWholeDiagramShows) {
    authoring::Scene scene = emptyScene({-2, -2}, {102, 102});
    for (int i = 0; i < 40; ++i)
        for (int j = 0; j < 40; ++j) {
            const glm::vec2 corner(2.5f * static_cast<float>(i) + 0.5f, 2.5f * static_cast<float>(j) + 0.5f);
            addWall(scene, corner, corner + glm::vec2(0.8f, 0.1f * static_cast<float>((i + j) % 7)));
        }
    for (int i = 0; i < 9; ++i)
        addPerson(scene, {11.0f * static_cast<float>(i) + 1.7f, 9.0f * static_cast<float>(i * i % 11) + 2.2f},
                  {50, 50});
    addPerson(scene, {1.7f, 3.1f}, {50, 50});
    addPerson(scene, {-1.9f, 101.9f}, {50, 50});  // in a corner of the window
    scene.settings.method = authoring::DiagramMethod::per_site;
    sim::Simulation whole(scene, library);
    scene.settings.method = authoring::DiagramMethod::automatic;
    sim::Simulation chosen(scene, library);
    EXPECT_EQ(whole.parts().extent, sim::Extent::everywhere);
    ASSERT_EQ(chosen.parts().extent, sim::Extent::near_people);
    for (int step = 0; step < 60; ++step) {
        whole.step();
        chosen.step();
    }
    EXPECT_EQ(senseNow(chosen), senseNow(whole));
    std::size_t walls = 0;
    for (const auto& list : senseNow(chosen))
        walls += std::ranges::count_if(list, [](std::uint32_t key) { return key & gpu::NEIGHBOUR_IS_WALL; });
    EXPECT_GT(walls, 20u);
}

TEST_F(SensingTest, CrossesTheBordersOfPagesWithoutASeam) {
    // People in two far corners of a world that is too empty to be kept whole; what they sense is what they
    // sense when their corner is a world of its own.
    authoring::Scene small = uniformScene(1234, 1.1f, 33);
    addWall(small, {5, 5}, {30, 22});
    authoring::Scene large = small;
    large.maximum = {900, 900};
    sim::Simulation whole(small, library);
    sim::Simulation paged(large, library);
    EXPECT_FALSE(whole.diagramIsPaged());
    EXPECT_TRUE(paged.diagramIsPaged());
    EXPECT_EQ(senseNow(paged), senseNow(whole));
}

TEST_F(SensingTest, CrossesTheBordersOfBandsWithoutASeam) {
    for (const std::uint32_t count : {9u, 1234u}) {
        authoring::Scene scene = uniformScene(count, count < 100 ? 13.0f : 1.1f, 34);
        addWall(scene, {5, 5}, {30, 22});
        addPerson(scene, {-40.0f, -40.0f}, {20, 20});  // outside, where places are those at the edge
        addPerson(scene, {90.0f, 140.0f}, {20, 20});
        scene.settings.pixels_per_metre = 28.0;
        scene.settings.method = authoring::DiagramMethod::per_site;
        sim::Simulation whole(scene, library);
        scene.settings.method = authoring::DiagramMethod::automatic;
        sim::Simulation banded(scene, library);
        ASSERT_EQ(whole.diagram().bands(), nullptr);
        ASSERT_NE(banded.diagram().bands(), nullptr);
        EXPECT_GE(banded.diagram().bands()->count(), 4u);
        for (int step = 0; step < 40; ++step) {
            whole.step();
            banded.step();
        }
        EXPECT_EQ(senseNow(banded), senseNow(whole)) << count;
        EXPECT_EQ(banded.parts().extent == sim::Extent::near_people, count < 100u);
    }
}

TEST_F(SensingTest, TheGridAndComparingAllWithAllAgreeExactly) {
    for (const double view : {60.0, 200.0, 360.0})
        for (const std::uint32_t count : {1u, 63u, 1234u}) {
            authoring::Scene scene = uniformScene(count, 0.9f, 40 + count);
            addWall(scene, {3, 3}, {20, 12}, 0.1f);
            addWall(scene, {10, 2}, {10, 25});
            scene.settings.field_of_view = view;
            scene.settings.proximity = authoring::Proximity::grid;
            sim::Simulation grid(scene, library);
            scene.settings.proximity = authoring::Proximity::brute;
            sim::Simulation brute(scene, library);
            const auto lists = senseNow(grid);
            EXPECT_EQ(lists, senseNow(brute)) << count << " people, " << view << " degrees";
            // And, as far as people go, with the definition.
            const sim::SensingGeometry geometry{
                scene.smallest_radius, static_cast<float>(scene.settings.tile_radius),
                scene.settings.samples_per_ray, static_cast<float>(view) * kPi / 180.0f};
            scene.settings.neighbours = 32;
            scene.wall_segments.clear();
            scene.wall_tiles.clear();
            sim::Simulation alone(scene, library);
            const auto people = senseNow(alone);
            for (std::uint32_t row = 0; row < count; ++row)
                EXPECT_EQ(people[row], nearestByBruteForce(scene, row, sim::sensingReach(geometry),
                                                           alone.parameters().contact_range));
        }
}

TEST_F(SensingTest, TheGridSeesTheWallsThatTheRaysSee) {
    authoring::Scene scene = uniformScene(400, 2.0f, 50);
    addWall(scene, {5, 5}, {30, 22});
    addWall(scene, {12, 30}, {35, 8});
    scene.settings.neighbours = 32;
    sim::Simulation rays(scene, library);
    scene.settings.proximity = authoring::Proximity::grid;
    sim::Simulation grid(scene, library);
    const auto seen = senseNow(rays);
    const auto exact = senseNow(grid);
    std::size_t walls = 0, missed = 0;
    for (std::size_t row = 0; row < exact.size(); ++row)
        for (const std::uint32_t key : exact[row]) {
            if (!(key & gpu::NEIGHBOUR_IS_WALL)) continue;
            ++walls;
            missed += std::count(seen[row].begin(), seen[row].end(), key) == 0;
        }
    EXPECT_GT(walls, 100u);
    EXPECT_LE(missed, walls / 20) << "of " << walls;
}

}  // namespace
}  // namespace throng::test
