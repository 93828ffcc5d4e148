// SPDX-License-Identifier: Apache-2.0
#include "sim/field_solver.h"

#include <cmath>
#include <random>

#include "authoring/scene/fields.h"
#include "tests/sim/gpu_test.h"

namespace throng::test {
namespace {

using authoring::FieldGrid;
using authoring::kUnreachable;
using authoring::WalkMap;

class FieldSolverTest : public GpuTest {
  protected:
    /// Both ways to solve a field agree, and the device's gives the same bits again.
    void expectSameDistances(const WalkMap& map, const std::vector<std::uint32_t>& targets,
                             const std::string& what) {
        sim::FieldSolver solver(library);
        const std::vector<float> expected = authoring::solveField(map, targets).reachable;
        const std::vector<float> found = authoring::solveField(map, targets, &solver).reachable;
        ASSERT_EQ(found.size(), expected.size()) << what;
        float worst = 0.0f;
        std::size_t apart = 0;
        for (std::size_t cell = 0; cell < found.size(); ++cell) {
            if ((found[cell] < kUnreachable) != (expected[cell] < kUnreachable)) ++apart;
            if (found[cell] < kUnreachable && expected[cell] < kUnreachable)
                worst = std::max(worst, std::abs(found[cell] - expected[cell]) / (1.0f + expected[cell]));
        }
        EXPECT_EQ(apart, 0u) << what << ": cells that only one of the two reaches";
        EXPECT_LT(worst, 2.0e-5f) << what << ": of the distance";
        EXPECT_EQ(authoring::solveField(map, targets, &solver).reachable, found) << what;
    }
};

WalkMap openMap(std::uint32_t width, std::uint32_t height, float cell_size = 0.25f) {
    WalkMap map;
    map.grid = FieldGrid{{0.0f, 0.0f}, cell_size, width, height};
    map.cost.assign(std::size_t{width} * height, 1.0f);
    return map;
}

/// Blocks and bad ground at random.
void litter(WalkMap& map, std::mt19937& random, double blocked) {
    std::uniform_real_distribution<double> draw(0.0, 1.0);
    for (float& cost : map.cost) {
        const double chance = draw(random);
        cost = chance < blocked ? kUnreachable : chance < blocked + 0.1 ? 5.0f : 1.0f;
    }
}

TEST_F(FieldSolverTest, AgreesWithFastMarchingOnGridsOfAnySize) {
    std::mt19937 random(3);
    for (const auto& [width, height] :
         {std::pair{1u, 1u}, {1u, 63u}, {16u, 16u}, {17u, 33u}, {63u, 5u}, {130u, 97u}}) {
        WalkMap map = openMap(width, height);
        const std::uint32_t middle = height / 2 * width + width / 2;
        expectSameDistances(map, {middle}, "open ground");
        litter(map, random, 0.25);
        map.cost[middle] = 1.0f;
        expectSameDistances(map, {middle, 0}, "blocks");
    }
}

TEST_F(FieldSolverTest, FollowsAMazeToItsEnd) {
    WalkMap map = openMap(90, 61);
    for (std::uint32_t y = 2; y < 61; y += 3)
        for (std::uint32_t x = 0; x < 90; ++x)
            if (y / 3 % 2 == 0 ? x < 88 : x > 1) map.cost[y * 90 + x] = kUnreachable;
    expectSameDistances(map, {0}, "a maze");
    sim::FieldSolver solver(library);
    const float end = authoring::solveField(map, std::vector<std::uint32_t>{0}, &solver).reachable[60 * 90];
    EXPECT_GT(end, 0.25f * 90.0f * 18.0f) << "through all its passages";
}

TEST_F(FieldSolverTest, HeedsClosedSidesAndOneWayRoads) {
    std::mt19937 random(11);
    std::uniform_int_distribution<int> side(0, 7);
    WalkMap map = openMap(75, 50);
    litter(map, random, 0.1);
    map.open_sides.resize(map.cost.size());
    for (std::uint8_t& open : map.open_sides)
        open = static_cast<std::uint8_t>((side(random) > 0 ? gpu::OPEN_TO_X : 0u) |
                                         (side(random) > 0 ? gpu::OPEN_TO_Y : 0u));
    expectSameDistances(map, {75 * 25 + 37}, "closed sides");
    map.one_way.assign(map.cost.size(), glm::vec2(0.0f));
    for (std::uint32_t y = 10; y < 20; ++y)
        for (std::uint32_t x = 5; x < 70; ++x)
            map.one_way[y * 75 + x] = {0.8f, 0.6f};
    expectSameDistances(map, {75 * 25 + 37}, "closed sides and a one-way road");
}

TEST_F(FieldSolverTest, ReachesNothingFromABlockedTarget) {
    WalkMap map = openMap(20, 20);
    map.cost[210] = kUnreachable;
    sim::FieldSolver solver(library);
    for (const float distance :
         authoring::solveField(map, std::vector<std::uint32_t>{210}, &solver).reachable)
        ASSERT_EQ(distance, kUnreachable);
}

}  // namespace
}  // namespace throng::test
