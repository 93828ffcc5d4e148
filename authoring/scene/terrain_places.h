// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "authoring/diagnostics.h"
#include "authoring/layout.h"
#include "authoring/storeys/cut.h"

namespace throng::authoring {

/// On which of a terrain's grounds above each other something lies.
///
/// What names a level lies on that of several grounds which is nearest on foot to the level's own place;
/// where nobody gets there from it, on that which is nearest in height. Where a layout names no levels,
/// everything lies on the lowest ground.
class TerrainPlaces {
  public:
    TerrainPlaces(const Layout& layout, const Walkable& ground, const Pieces& pieces);

    /// Finds the ground of each level. @returns whether all have one; else it is told
    bool findLevels(Diagnostics& diagnostics);
    /// The spot in a cell that people get to on foot from a level's place; kNoSpot where they get to none.
    std::uint32_t onFootAt(glm::ivec2 cell, std::size_t level) const;
    /// How many cells that is.
    std::uint32_t stepsTo(std::uint32_t spot, std::size_t level) const { return steps_[level][spot]; }
    /// The spot at a place, or beside it; kNoSpot where there is none.
    std::uint32_t spotAt(glm::dvec2 place, std::size_t level) const;
    /// In the middle of an outline, as far as there is ground.
    std::uint32_t spotIn(const std::vector<glm::dvec2>& outline, std::size_t level) const;
    /// From now on only what is on a chart counts.
    void keepTo(const std::vector<Surface>& surfaces);
    /// By spot, kNoSpot of those that are on no chart.
    const std::vector<std::uint32_t>& chartOf() const { return chart_of_; }
    const std::vector<std::uint32_t>& levelSpots() const { return level_spots_; }

  private:
    std::uint32_t spotOf(glm::ivec2 cell, std::size_t level) const;
    std::uint32_t spotOnLanding(const Level& landing) const;
    bool counts(std::uint32_t spot) const;
    std::vector<std::uint32_t> stepsFrom(std::uint32_t spot) const;

    const Layout& layout_;
    const Walkable& ground_;
    const Pieces& pieces_;
    std::vector<std::uint32_t> level_spots_;
    std::vector<std::vector<std::uint32_t>>
        steps_;                            // by level and spot: cells on foot from the level's place
    std::vector<std::uint32_t> chart_of_;  // empty: not cut yet
};

/// The first and the last cell of the rectangle round an outline, which may be far beyond all ground.
std::pair<glm::ivec2, glm::ivec2> cellsRound(const std::vector<glm::dvec2>& outline);

/// Calls visit for every mention of a place of a layout.
void visitPlaces(Layout& layout, const std::function<void(Place&)>& visit);

}  // namespace throng::authoring
