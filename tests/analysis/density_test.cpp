// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

#include "analysis/measure/voronoi_density.h"

namespace throng::analysis {
namespace {

constexpr double kSide = 12.0;  // m

/// Square by square, as Steffen and Seyfried count them.
double countedDensity(const std::vector<glm::dvec2>& places, std::size_t self) {
    int owned = 0;
    for (int y = -10; y < 10; ++y)
        for (int x = -10; x < 10; ++x) {
            const glm::dvec2 at = 0.1 * glm::dvec2(x + 0.5, y + 0.5);
            bool is_own = glm::length(at) <= 1.0;
            for (std::size_t other = 0; other < places.size(); ++other)
                is_own = is_own && (other == self || glm::distance(places[self] + at, places[other]) >=
                                                         glm::length(at) - 1.0e-9);
            owned += is_own ? 1 : 0;
        }
    return 1.0 / (0.01 * std::max(owned, 1));
}

class VoronoiDensity : public testing::TestWithParam<std::size_t> {};

TEST_P(VoronoiDensity, IsThatOfSquaresCountedOneByOne) {
    std::mt19937 random(static_cast<unsigned>(GetParam()));
    std::uniform_real_distribution<double> anywhere(0.0, kSide);
    std::vector<glm::dvec2> places(GetParam());
    for (glm::dvec2& place : places)
        place = {anywhere(random), anywhere(random)};
    PlaneGrid grid({0.0, 0.0}, {kSide, kSide}, 1.0);
    grid.sort(places);
    for (std::uint32_t self = 0; self < places.size();
         self += 1 + static_cast<std::uint32_t>(places.size() / 97))
        ASSERT_DOUBLE_EQ(voronoiDensity(grid, places, self), countedDensity(places, self)) << self;
}

INSTANTIATE_TEST_SUITE_P(Crowds, VoronoiDensity, testing::Values(1, 2, 63, 500, 1234));

TEST(VoronoiDensity, OfALatticeIsOneOverItsCells) {
    std::vector<glm::dvec2> places;
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 9; ++x)
            places.emplace_back(x, 0.6 * y);
    PlaneGrid grid({0.0, 0.0}, {8.0, 5.0}, 1.0);
    grid.sort(places);
    EXPECT_DOUBLE_EQ(voronoiDensity(grid, places, 40), 1.0 / (1.0 * 0.6));
    // Somebody in the very same place takes nothing away, and who is on another storey neither.
    places.push_back(places[40]);
    places.emplace_back(4.1, 2.4);
    grid.sort(places);
    std::vector<double> heights(places.size(), 0.0);
    heights.back() = 3.0;
    EXPECT_DOUBLE_EQ(voronoiDensity(grid, places, 40, heights), 1.0 / (1.0 * 0.6));
    heights.back() = 0.0;
    EXPECT_GT(voronoiDensity(grid, places, 40, heights), 1.0 / (1.0 * 0.6));
}

}  // namespace
}  // namespace throng::analysis
