// SPDX-License-Identifier: Apache-2.0
#include "analysis/between_rows.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/polygon.h"

namespace throng::analysis {
namespace {

/// As authoring/layout/seat_reader.cpp names them.
bool isStandOf(const authoring::Wall& wall, const recording::BakeSeats& seats) {
    const std::string name = seats.id + " stand";
    return wall.closed && wall.id.starts_with(name) &&
           wall.id.find_first_not_of('_', name.size()) == std::string::npos;
}

std::vector<glm::dvec2> around(glm::dvec2 from, glm::dvec2 to, double width) {
    const glm::dvec2 way = glm::normalize(to - from);
    const glm::dvec2 aside = 0.5 * width * glm::dvec2(-way.y, way.x);
    return {from - aside, to - aside, to + aside, from + aside};
}

}  // namespace

BetweenRows::BetweenRows(const io::Bake& bake) {
    for (const recording::BakeSeats& seats : bake.seats) {
        if (seats.aisles.empty()) continue;
        if (seats.aisles.front().passage) {
            addRowsWithPassages(seats);
            continue;
        }
        for (const authoring::Wall& wall : bake.walls)
            if (isStandOf(wall, seats)) add(wall.points, {});
        for (const recording::BakeAisle& aisle : seats.aisles)
            for (std::size_t i = 0; i + 1 < aisle.line.size(); ++i)
                if (aisle.line[i] != aisle.line[i + 1])
                    add(around(aisle.line[i], aisle.line[i + 1], aisle.width), {});
    }
}

void BetweenRows::addWay(const std::vector<glm::dvec2>& line, const std::vector<double>& heights,
                         double width) {
    constexpr double kOff = 0.3;  // m: people are on steps, and ground goes on evenly here
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
        if (line[i] != line[i + 1])
            add(around(line[i], line[i + 1], width),
                {std::min(heights[i], heights[i + 1]) - kOff, std::max(heights[i], heights[i + 1]) + kOff});
}

/// Others may be under the rows, and over the passages.
void BetweenRows::addRowsWithPassages(const recording::BakeSeats& seats) {
    constexpr double kPitches = 1.6;              // of a row: its seats, and where one walks before them
    constexpr double kBeside = 2.5, kRise = 0.1;  // m, from where one flight ends to where the next begins
    for (const recording::BakeSeatRow& row : seats.rows)
        addWay(row.line, std::vector(row.line.size(), row.height), kPitches * seats.pitch);
    for (const recording::BakeAisle& aisle : seats.aisles) {
        std::vector<std::pair<glm::dvec2, double>> ends;
        const auto addFlight = [&](const recording::BakeFlight& flight) {
            addWay(flight.line, flight.heights, flight.width);
            ends.emplace_back(flight.line.front(), flight.heights.front());
            ends.emplace_back(flight.line.back(), flight.heights.back());
        };
        addFlight(*aisle.passage);
        std::ranges::for_each(aisle.flights, addFlight);
        for (const auto& [from, low] : ends)
            for (const auto& [to, high] : ends)
                if (glm::distance(from, to) < kBeside && std::abs(low - high) < kRise)
                    addWay({from, to}, {low, high}, seats.pitch);
    }
}

void BetweenRows::add(std::vector<glm::dvec2> outline, Heights heights) {
    Piece piece{std::move(outline), {}, {}, heights};
    piece.lower = piece.upper = piece.outline.front();
    for (const glm::dvec2 corner : piece.outline) {
        piece.lower = glm::min(piece.lower, corner);
        piece.upper = glm::max(piece.upper, corner);
    }
    pieces_.push_back(std::move(piece));
}

recording::WallWatch watchOf(const io::Bake& bake) {
    std::vector<authoring::Wall> walls;
    std::vector<glm::dvec2> ground;
    for (std::size_t i = 0; i < bake.walls.size(); ++i) {
        const bool is_over_passages = std::ranges::any_of(bake.seats, [&](const recording::BakeSeats& seats) {
            return !seats.aisles.empty() && seats.aisles.front().passage && isStandOf(bake.walls[i], seats);
        });
        if (is_over_passages) continue;
        walls.push_back(bake.walls[i]);
        if (!bake.wall_ground.empty()) ground.push_back(bake.wall_ground[i]);
    }
    return {std::move(walls), bake.minimum, bake.maximum, std::move(ground)};
}

bool BetweenRows::has(glm::dvec2 place, double height) const {
    return std::ranges::any_of(pieces_, [&](const Piece& piece) {
        return height >= piece.heights.low && height <= piece.heights.high && place.x >= piece.lower.x &&
               place.x <= piece.upper.x && place.y >= piece.lower.y && place.y <= piece.upper.y &&
               isWithin(piece.outline, place);
    });
}

}  // namespace throng::analysis
