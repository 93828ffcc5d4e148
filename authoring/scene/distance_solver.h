// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <limits>
#include <memory>
#include <vector>

#include "authoring/scene.h"

/// Ground to walk on as a grid, and who works distances out on it.
namespace throng::authoring {

/// Per metre into what is blocked, so that "downhill" points out of it.
inline constexpr float kFillCost = 10.0f;

/// What a grid's cells have to do with charts (authoring/storeys/charts.h).
struct SeamCells {
    std::vector<std::uint8_t> blocked;  ///< 1: nobody's ground, or another chart's; per cell
    /// A cell that shows another chart's ground, and the cell that it shows: these are one place.
    struct Shown {
        std::uint32_t image, owner;
    };
    std::vector<Shown> shown;             ///< in the order of their owners
    std::vector<std::uint32_t> owner_of;  ///< per cell: itself, or what it shows
    std::vector<Detours::Ride> rides;     ///< of lifts, from the middle of one cabin to that of another
};

/// How hard it is to walk, cell by cell.
struct WalkMap {
    FieldGrid grid;
    std::vector<float> cost;  ///< per metre walked, 1 on open ground; infinity where nobody can stand
    std::vector<glm::vec2>
        one_way;  ///< unit direction that may not be walked against, or zero; empty when there is none
    std::vector<std::uint8_t>
        open_sides;  ///< gpu::OPEN_TO_X, OPEN_TO_Y: where one may go to the next cell; empty = all

    std::shared_ptr<const SeamCells> seams = {};  ///< null: there are no charts

    /// Whether there are closed sides or one-way roads.
    bool isBound() const { return !open_sides.empty() || !one_way.empty(); }
};

/// Marks a distance that no path leads to, before blocked cells are filled in.
inline constexpr float kUnreachable = std::numeric_limits<float>::infinity();

/// Something else that solves the Eikonal equation: a device. Not for several threads at once.
class DistanceSolver {
  public:
    virtual ~DistanceSolver() = default;
    /// @param start distances at and around the target, kUnreachable elsewhere
    /// @returns the distance everywhere, kUnreachable where no path leads to the target
    virtual std::vector<float> solve(const WalkMap& map, const std::vector<float>& start) = 0;
};

}  // namespace throng::authoring
