// SPDX-License-Identifier: Apache-2.0
#include "authoring/layout/row_floor.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "authoring/layout/seat_rows.h"

namespace throng::authoring {
namespace {

constexpr double kAlong = 0.5;  // m, from one height along a row to the next

}  // namespace

RowFloor::RowFloor(const SeatBlock& block, std::size_t row)
    : over_(block.height + static_cast<double>(row) * block.rise), block_(block) {
    if (!block.on_terrain || !block.ground) return;
    const double middle = static_cast<double>(row) * block.pitch;
    for (const double behind : {0.5 * block.pitch, 0.0, -passingAhead(block), -0.5 * block.pitch})
        across_.emplace_back(block, middle + behind);
}

double RowFloor::at(double share) const {
    if (across_.empty()) return over_;
    double highest = std::numeric_limits<double>::quiet_NaN();
    for (const RowLine& line : across_)
        highest = std::fmax(highest, block_.ground(line.at(share)));
    return over_ + highest;
}

std::vector<double> sharesOnFloor(const SeatBlock& block, const RowLine& line, double from, double to) {
    constexpr double kHair = 1.0e-9;
    std::vector<double> shares{from, to};
    for (const double corner : line.corners())
        if (corner > from + kHair && corner < to - kHair) shares.push_back(corner);
    if (block.on_terrain && block.ground) {
        const double length = line.lengthBetween(from, to);
        const auto pieces = static_cast<int>(std::ceil(length / kAlong));
        for (int i = 1; i < pieces; ++i)
            shares.push_back(line.advance(from, length * i / pieces));
    }
    std::ranges::sort(shares);
    const auto same = std::ranges::unique(shares, [](double a, double b) { return b - a < kHair; });
    shares.erase(same.begin(), same.end());
    return shares;
}

double heightOfFoot(const SeatBlock& block, glm::dvec2 foot) {
    return block.ground ? block.ground(foot) : block.mouths.height;
}

std::optional<double> lowestGround(const SeatBlock& block) {
    if (!block.ground) return std::nullopt;
    constexpr double kStep = 1.0;  // m
    double lowest = std::numeric_limits<double>::infinity();
    for (std::uint64_t edge = 0; edge <= block.rows; ++edge) {
        const RowLine line(block, (static_cast<double>(edge) - 0.5) * block.pitch);
        const double length = line.length();
        const auto pieces = std::max(1, static_cast<int>(std::ceil(length / kStep)));
        for (int i = 0; i <= pieces; ++i)
            lowest = std::fmin(lowest, block.ground(line.at(line.advance(0.0, length * i / pieces))));
    }
    return std::isfinite(lowest) ? std::optional(lowest) : std::nullopt;
}

}  // namespace throng::authoring
