// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "authoring/scene/raster.h"

namespace throng::authoring {

/// The segments of walls by place, so that very many of them are not all asked about every person.
class WallGrid {
  public:
    /// What lies within so many metres of a place is found there.
    static constexpr float kReach = 3.0f;

    WallGrid(std::span<const gpu::WallSegment> walls, glm::vec2 minimum, glm::vec2 maximum);

    /// Indices of the segments whose surface may lie within kReach of a point.
    std::span<const std::uint32_t> near(glm::vec2 point) const;
    /// Calls visit(indices) for pieces of the line from a to b, with the segments that may lie within kReach
    /// of it.
    template <class Visit>
    void along(glm::vec2 a, glm::vec2 b, Visit visit) const {
        visitAlong(grid_, a, b, 0.75f * grid_.cell_size,
                   [&](std::uint32_t cell, glm::vec2) { visit(inCell(cell)); });
    }

  private:
    std::span<const std::uint32_t> inCell(std::size_t cell) const {
        return std::span(items_).subspan(starts_[cell], starts_[cell + 1] - starts_[cell]);
    }

    FieldGrid grid_;
    std::vector<std::uint32_t> starts_, items_;
};

}  // namespace throng::authoring
