// SPDX-License-Identifier: Apache-2.0
#include "analysis/measure/voronoi_density.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/storeys.h"

namespace throng::analysis {
namespace {

constexpr double kRadius = 1.0, kSquare = 0.1;  // m
constexpr int kLines = 20;                      // of squares, from one end of the cell to the other

struct Other {
    glm::dvec2 at;   // m, from the person
    double squared;  // m^2, how far that is
};

/// A cell around the origin. It is convex: of each line of squares it has those between two bounds.
class Cell {
  public:
    Cell() {
        for (std::size_t i = 0; i < kLines; ++i) {
            y_[i] = (static_cast<double>(i) - 0.5 * (kLines - 1)) * kSquare;
            to_[i] = std::sqrt(kRadius * kRadius - y_[i] * y_[i]);
            from_[i] = -to_[i];
        }
    }

    /// Takes away what is nearer to somebody else: x ox + y oy > |o|^2 / 2.
    void cut(const Other& other) {
        if (other.at.x == 0.0) {
            for (std::size_t i = 0; i < kLines; ++i)
                if (y_[i] * other.at.y > 0.5 * other.squared) to_[i] = from_[i] - kSquare;
            return;
        }
        const double across = 0.5 * other.squared / other.at.x, slope = other.at.y / other.at.x;
        if (other.at.x > 0.0)
            for (std::size_t i = 0; i < kLines; ++i)
                to_[i] = std::min(to_[i], across - y_[i] * slope);
        else
            for (std::size_t i = 0; i < kLines; ++i)
                from_[i] = std::max(from_[i], across - y_[i] * slope);
    }

    /// m^2, to what of it is furthest away.
    double furthestSquared() const {
        double furthest = 0.0;
        for (std::size_t i = 0; i < kLines; ++i) {
            const double aside = std::max(std::abs(from_[i]), std::abs(to_[i]));
            const double squared = y_[i] * y_[i] + aside * aside;
            furthest = from_[i] <= to_[i] ? std::max(furthest, squared) : furthest;
        }
        return furthest;
    }

    /// Those whose middles it has; on a bound, too.
    int squares() const {
        constexpr double kHair = 1.0e-9;
        int all = 0;
        for (std::size_t i = 0; i < kLines; ++i) {
            const double first = std::ceil(from_[i] / kSquare - 0.5 - kHair),
                         last = std::floor(to_[i] / kSquare - 0.5 + kHair);
            all += static_cast<int>(std::max(last - first + 1.0, 0.0));
        }
        return all;
    }

  private:
    std::array<double, kLines> y_, from_, to_;  // m: of squares' middles, and the bounds on their line
};

}  // namespace

double voronoiDensity(const PlaneGrid& grid, const std::vector<glm::dvec2>& places, std::uint32_t self,
                      const std::vector<double>& heights) {
    std::vector<Other> others;
    grid.near(places[self], 2.0 * kRadius, [&](std::uint32_t other) {
        const glm::dvec2 offset = places[other] - places[self];
        if (!heights.empty() && !areOnOneGround(heights[self], heights[other])) return;
        const double squared = glm::dot(offset, offset);
        if (other != self && squared < 4.0 * kRadius * kRadius) others.push_back({offset, squared});
    });
    std::ranges::sort(others, {}, &Other::squared);
    Cell cell;
    double furthest = kRadius * kRadius;
    for (std::size_t i = 0; i < others.size(); ++i) {
        // Who is more than twice as far away as all of a cell is nearer to none of it.
        if (others[i].squared > 4.0 * furthest) break;
        cell.cut(others[i]);
        if (i % 4 == 3) furthest = cell.furthestSquared();
    }
    return 1.0 / (std::max(cell.squares(), 1) * kSquare * kSquare);
}

}  // namespace throng::analysis
