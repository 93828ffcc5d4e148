// SPDX-License-Identifier: Apache-2.0
// One look at what is closed says what marching along a ray says.
#include "authoring/scene/sight.h"

#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <random>

namespace throng::authoring {
namespace {

constexpr FieldGrid kGrid{.minimum = {-7.0f, 3.0f}, .cell_size = 0.25f, .width = 61, .height = 45};

/// Open but for some cells at random.
Sight scattered(int closed, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<bool> is_closed(std::size_t{kGrid.width} * kGrid.height, false);
    for (int i = 0; i < closed; ++i)
        is_closed[random() % is_closed.size()] = true;
    Sight sight(kGrid);
    for (std::uint32_t y = 0; y < kGrid.height; ++y)
        for (std::uint32_t x = 0; x < kGrid.width; ++x)
            if (!is_closed[y * kGrid.width + x]) {
                sight.setFree(x, y);
                sight.setRoomy(x, y);
            }
    return sight;
}

glm::vec2 somewhere(std::mt19937& random) {
    std::uniform_real_distribution<float> share(0.0f, 1.0f);
    return kGrid.minimum + glm::vec2(share(random) * 61.0f, share(random) * 45.0f) * kGrid.cell_size;
}

class SightTest : public testing::TestWithParam<std::size_t> {};

TEST_P(SightTest, WhereABoxIsOpenEveryWayAcrossItIsClear) {
    std::mt19937 random(4);
    int open = 0, clear = 0;
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        Sight sight = scattered(12, seed);
        sight.finish(GetParam());
        for (int i = 0; i < 500; ++i) {
            const glm::vec2 from = somewhere(random), to = somewhere(random);
            const bool is_open = sight.isOpen(glm::min(from, to), glm::max(from, to));
            const bool is_clear = sight.isClear(from, to, 0.0f);
            EXPECT_TRUE(is_clear || !is_open) << from.x << ", " << from.y << " to " << to.x << ", " << to.y;
            open += is_open ? 1 : 0;
            clear += is_clear ? 1 : 0;
        }
    }
    EXPECT_GT(open, clear / 200);  // even in large pieces
    EXPECT_LT(open, clear);
}

TEST_P(SightTest, ABoxRoundAClosedCellIsNotOpen) {
    Sight sight(kGrid);
    for (std::uint32_t y = 0; y < kGrid.height; ++y)
        for (std::uint32_t x = 0; x < kGrid.width; ++x) {
            sight.setFree(x, y);
            if (x != 30 || y != 22) sight.setRoomy(x, y);
        }
    sight.finish(GetParam());
    const glm::vec2 closed = kGrid.minimum + glm::vec2(30.5f, 22.5f) * kGrid.cell_size;
    EXPECT_FALSE(sight.isOpen(closed - 0.5f, closed + 0.5f));
    EXPECT_FALSE(sight.isOpen(closed, closed));
    EXPECT_TRUE(sight.isOpen(closed - 4.0f, closed - 2.5f));
    EXPECT_TRUE(sight.isOpen(closed + glm::vec2(2.5f, -3.0f), closed + glm::vec2(4.0f, 3.0f)));
    EXPECT_FALSE(sight.isOpen(kGrid.minimum - 1.0f, closed));  // what is not on the ground
}

INSTANTIATE_TEST_SUITE_P(CellsAndPieces, SightTest, testing::Values(std::size_t{1} << 22, 700, 180));

}  // namespace
}  // namespace throng::authoring
