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
    void setTileOpen(std::uint32_t tile_x, std::uint32_t tile_y);

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
    static std::uint64_t bitOf(std::uint32_t x, std::uint32_t y) {
        return std::uint64_t{1} << (y % kSide * kSide + x % kSide);
    }

    FieldGrid grid_;
    std::uint32_t across_;
    Tiles free_, roomy_;
};

}  // namespace throng::authoring
