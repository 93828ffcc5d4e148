// SPDX-License-Identifier: Apache-2.0
#include "analysis/between_rows.h"

#include <algorithm>
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
        for (const authoring::Wall& wall : bake.walls)
            if (isStandOf(wall, seats)) add(wall.points);
        for (const recording::BakeAisle& aisle : seats.aisles)
            for (std::size_t i = 0; i + 1 < aisle.line.size(); ++i)
                if (aisle.line[i] != aisle.line[i + 1])
                    add(around(aisle.line[i], aisle.line[i + 1], aisle.width));
    }
}

void BetweenRows::add(std::vector<glm::dvec2> outline) {
    Piece piece{std::move(outline), {}, {}};
    piece.lower = piece.upper = piece.outline.front();
    for (const glm::dvec2 corner : piece.outline) {
        piece.lower = glm::min(piece.lower, corner);
        piece.upper = glm::max(piece.upper, corner);
    }
    pieces_.push_back(std::move(piece));
}

bool BetweenRows::has(glm::dvec2 place) const {
    return std::ranges::any_of(pieces_, [&](const Piece& piece) {
        return place.x >= piece.lower.x && place.x <= piece.upper.x && place.y >= piece.lower.y &&
               place.y <= piece.upper.y && isWithin(piece.outline, place);
    });
}

}  // namespace throng::analysis
