// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "authoring/scene.h"

namespace throng::authoring {

/// Where bodies can walk straight on: ground as a bitmap in tiles of 8 x 8 cells, so that a look over open
/// ground takes one step a tile and not one a cell.
class Sight {
  public:
    explicit Sight(const FieldGrid& grid);  ///< nothing is free

    void setFree(std::uint32_t x, std::uint32_t y) { free_[tileOf(x, y)] |= bitOf(x, y); }
    void setRoomy(std::uint32_t x, std::uint32_t y) { roomy_[tileOf(x, y)] |= bitOf(x, y); }
    void setNarrow(std::uint32_t x, std::uint32_t y) { roomy_[tileOf(x, y)] &= ~bitOf(x, y); }
    void setTileOpen(std::uint32_t tile_x, std::uint32_t tile_y);
    /// All is set; before the first question.
    /// @param most_pieces counted, a cell each or as many cells as it takes; 4 bytes each
    void finish(std::size_t most_pieces = std::size_t{1} << 22);

    /// Nothing in the box or beside it is closed: from anywhere in it the straight way to anywhere in it is
    /// clear. It may say no where that is so, too.
    bool isOpen(glm::vec2 lower, glm::vec2 upper) const;

    /// Somebody can stand there, however small.
    bool isFree(std::uint32_t x, std::uint32_t y) const { return (free_[tileOf(x, y)] & bitOf(x, y)) != 0; }
    const FieldGrid& grid() const { return grid_; }

    /// Whether the straight way has room for everybody's body; for the last `close` metres free ground will
    /// do.
    bool isClear(glm::vec2 from, glm::vec2 to, float close) const;

  private:
    static constexpr std::uint32_t kSide = 8;
    using Tiles = std::vector<std::uint64_t>;

    std::size_t tileOf(std::uint32_t x, std::uint32_t y) const {
        return std::size_t{y / kSide} * across_ + x / kSide;
    }
    bool isPieceOpen(std::uint32_t first_x, std::uint32_t first_y) const;
    static std::uint64_t bitOf(std::uint32_t x, std::uint32_t y) {
        return std::uint64_t{1} << (y % kSide * kSide + x % kSide);
    }

    FieldGrid grid_;
    std::uint32_t across_;
    Tiles free_, roomy_;
    std::uint32_t piece_ = 1;  ///< cells along a side of what is counted
    glm::uvec2 pieces_{0};
    std::vector<std::uint32_t> closed_before_;  ///< closed pieces left of a corner and below it, line by line
};

}  // namespace throng::authoring
