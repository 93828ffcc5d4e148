// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <vector>

#include "base/plane_grid.h"
#include "base/storeys.h"

namespace throng::analysis {

/// persons/m^2: one over the area of a person's Voronoi cell, truncated at a metre and counted in squares of
/// 0.1 m around it (Steffen and Seyfried 2010).
/// @param heights m, of all places; empty: there is one storey
/// @param grid holds `places`; the person is `places[self]`
inline double voronoiDensity(const PlaneGrid& grid, const std::vector<glm::dvec2>& places, std::uint32_t self,
                             const std::vector<double>& heights = {}) {
    constexpr double kRadius = 1.0, kSquare = 0.1;
    constexpr int kReach = 10;
    struct Other {
        glm::dvec2 at;   // m, from the person
        double squared;  // m^2, how far that is
    };
    std::vector<Other> others;
    grid.near(places[self], 2.0 * kRadius, [&](std::uint32_t other) {
        const glm::dvec2 offset = places[other] - places[self];
        if (!heights.empty() && !areOnOneGround(heights[self], heights[other])) return;
        if (other != self && glm::dot(offset, offset) < 4.0 * kRadius * kRadius)
            others.push_back({offset, glm::dot(offset, offset)});
    });
    std::ranges::sort(others, {}, &Other::squared);
    // Who is more than twice as far away as a square is not nearer to it; a hair more, for rounding.
    constexpr double kTwiceSquared = 4.0 * (1.0 + 1.0e-9);
    const auto isAnothers = [&](glm::dvec2 at, double own) {
        for (const Other& other : others) {
            if (other.squared > kTwiceSquared * own) return false;
            if (glm::dot(at - other.at, at - other.at) < own) return true;
        }
        return false;
    };
    int owned = 0;
    for (int y = -kReach; y < kReach; ++y)
        for (int x = -kReach; x < kReach; ++x) {
            const glm::dvec2 at = glm::dvec2(x + 0.5, y + 0.5) * kSquare;
            const double own = glm::dot(at, at);
            owned += own <= kRadius * kRadius && !isAnothers(at, own);
        }
    return 1.0 / (std::max(owned, 1) * kSquare * kSquare);
}

}  // namespace throng::analysis
