// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <map>
#include <tuple>
#include <vector>

#include "authoring/layout.h"
#include "authoring/layout/row_line.h"
#include "authoring/layout/seat_rows.h"

// Stands whose aisles do not go out before the first row
//
// Behind the last row, an aisle simply goes on as a passage. At a row in the middle (a vomitory) it comes out
// through an opening that looks to the front: the row before it is its landing, and the rows behind it are
// cut, as wide as the opening and a flight of steps on either side of it, until one is high enough over the
// passage to go on over it. Who comes from further back walks down one of the two flights, turns on the
// landing and goes in; who comes from further in front walks up to the landing.
namespace throng::authoring {

/// m over the floor of a passage, below the first row that goes on over it.
inline constexpr double kPassageHeadroom = 2.1;
/// m, of the flights on either side of an opening.
inline constexpr double kFlightWidth = 0.9;

/// Whether the aisles of a block go out behind it, or through openings.
bool hasPassages(const SeatBlock& block);
/// The row on which people come out, 0 the first.
std::size_t landingRow(const SeatBlock& block);
/// The last row that is cut; the landing itself where there is no opening.
std::size_t lastCutRow(const SeatBlock& block);
/// m between the seats on either side of an aisle.
double gapOfRow(const SeatBlock& block, std::size_t row);
/// m in plan, from the opening to its foot.
double passageLength(const SeatBlock& block);
/// Where people step off the passage.
glm::dvec2 passageFoot(const SeatBlock& block, std::size_t aisle);

/// What nobody else walks through of the level on which the foot is, as far as the passage leaves no headroom
/// over or under it; empty where there is no such part.
std::vector<glm::dvec2> passageOutline(const SeatBlock& block, std::size_t aisle);

/// A place on the way to a seat.
struct AislePoint {
    glm::dvec2 place{0.0};               ///< m
    double height = 0.0;                 ///< m
    double along = 0.0;                  ///< m from the foot
    glm::dvec2 beside{0.0}, alone{0.0};  ///< m, as those of gpu::SeatPoint
};

/// The way from the foot of a passage to before a seat.
struct AisleWay {
    std::vector<AislePoint> points;
    double fork = 0.0, mouth = 0.0;  ///< m along it: where ways part, and where the row begins
    std::uint32_t branch = 0;        ///< 0 to the front, 1 and 2 by the flights beside the opening
    bool beyond = false;             ///< the seat is on the side of the aisle to which the rows go on
};

/// The way up or down an aisle, as far as a row.
struct WayToRow {
    AisleWay way;
    double aside = 0.0;  ///< m from the aisle's middle, where it ends
};

/// The ways to the seats of one block. All who sit in a row walk the same way as far as that, which is made
/// once.
class BlockWays {
  public:
    /// @param block outlives this
    explicit BlockWays(const SeatBlock& block);
    AisleWay to(std::size_t aisle, const Seat& seat);

  private:
    void addRow(AisleWay& way, std::size_t aisle, double aside, const Seat& seat);

    const SeatBlock& block_;
    RowLines lines_;
    double length_;                                                           ///< m, of the middle row
    std::map<std::tuple<std::size_t, bool, std::size_t>, WayToRow> to_rows_;  ///< by aisle, side and row
};

/// What people walk on, for whoever shows it: a point before each row.
struct Flight {
    std::vector<glm::dvec2> line;
    std::vector<double> heights;
    double width = 0.0;
};
std::vector<Flight> flightsOf(const SeatBlock& block, std::size_t aisle);
/// From the foot to the landing.
Flight passageOf(const SeatBlock& block, std::size_t aisle);

}  // namespace throng::authoring
