// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "authoring/layout.h"
#include "authoring/layout/row_line.h"

namespace throng::authoring {

/// What is under a row of seats: level, or on a terrain, where it is nowhere below the ground. There it is
/// level from its front to its back, as steps of a hillside are, and goes up and down along the row only.
class RowFloor {
  public:
    RowFloor(const SeatBlock& block, std::size_t row);
    /// m, at a share of the row.
    double at(double share) const;

  private:
    double over_;  ///< m, over the ground or over nothing
    const SeatBlock& block_;
    std::vector<RowLine> across_;  ///< on a terrain: from the front to the back
};

/// The shares from one to another, ends and corners with them; on a terrain so close to each other that a
/// line between them follows it.
std::vector<double> sharesOnFloor(const SeatBlock& block, const RowLine& line, double from, double to);

/// m, of the ground where people step off an aisle before the block.
double heightOfFoot(const SeatBlock& block, glm::dvec2 foot);

/// The lowest ground of a terrain under a block, m; nothing where there is none.
std::optional<double> lowestGround(const SeatBlock& block);

}  // namespace throng::authoring
