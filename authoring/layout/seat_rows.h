// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

#include "authoring/layout.h"

namespace throng::authoring {

/// One seat of a block.
struct Seat {
    glm::dvec2 place{0.0};  ///< m, world
    double height = 0.0;    ///< m, of the floor before it
    glm::dvec2 ahead{0.0};  ///< unit: which way one looks
    std::size_t row = 0;
    std::size_t section = 0;  ///< between two aisles
    double along = 0.0;       ///< m along the middle row
};

/// All seats, row by row from the first, and in each along it.
std::vector<Seat> seatsOf(const SeatBlock& block);

/// m, along the middle row.
double lengthOf(const SeatBlock& block);

/// How many seats there are.
std::size_t countSeats(const SeatBlock& block);

/// What nobody walks through: convex polygons, of each section by itself.
std::vector<std::vector<glm::dvec2>> standOutlines(const SeatBlock& block);

/// Of each row, from aisle to aisle: where its seats are, as a line in their middle.
struct SeatRow {
    std::vector<glm::dvec2> line;
    double height = 0.0;               ///< m; on a terrain the lowest of them
    std::vector<double> heights = {};  ///< m, on a terrain, of each point
};
std::vector<SeatRow> seatRows(const SeatBlock& block);

/// m from the middle of a seat: where its people stand before it, and where others pass.
inline constexpr double kStandsAhead = 0.1;
double passingAhead(const SeatBlock& block);

/// Aisles by which people come to the seats: those through the block, or, where there are none, its two ends.
std::size_t countAisles(const SeatBlock& block);
/// Where one goes through the rows, as a share of each.
double aisleShare(const SeatBlock& block, std::size_t aisle);
/// The one that is nearest to a seat.
std::size_t aisleOf(const SeatBlock& block, const Seat& seat);
/// The middle of an aisle: before the first row, where people step off the ground, and then before each row.
std::vector<glm::dvec2> aisleLine(const SeatBlock& block, std::size_t aisle);
/// A place on the way to a seat, and its height, m.
struct RowPoint {
    glm::dvec2 place{0.0};
    double height = 0.0;
};
/// The way along a row from an aisle to before a seat. @returns its points, the first in the aisle
std::vector<RowPoint> wayAlongRow(const SeatBlock& block, std::size_t aisle, const Seat& seat);
/// m, of each point of that.
std::vector<double> aisleHeights(const SeatBlock& block, std::size_t aisle);
/// m
double aisleWidth(const SeatBlock& block);
/// Where people wait until they can go in, a square before an aisle.
std::vector<glm::dvec2> footOf(const SeatBlock& block, std::size_t aisle);
/// The aisles as outlines that keep others out.
std::vector<std::vector<glm::dvec2>> aisleOutlines(const SeatBlock& block);

/// The first row of an arc. @param from, to: degrees, counter-clockwise
std::vector<glm::dvec2> arcFront(glm::dvec2 centre, double radius, double from, double to);

/// Whether rows behind the first one would turn back on themselves.
bool foldsBack(const SeatBlock& block);

}  // namespace throng::authoring
