// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shaders/shared/simulation_types.h"

namespace throng::sim {

/// For every cell, the wall segments that somebody in it could touch or feel: segments of cell c are
/// items[starts[c] .. starts[c + 1]), in ascending order.
struct WallIndex {
    std::vector<std::uint32_t> starts;
    std::vector<std::uint32_t> items;
};

/// @param reach m: segments whose surface is within this distance of some point of the cell are listed
WallIndex indexWalls(std::span<const gpu::WallSegment> segments, const gpu::Parameters& cells, float reach);

/// One bit for every cell, 32 in a word: whether some point of it may lie within `reach` (m) of a place.
std::vector<std::uint32_t> markCells(std::span<const glm::vec2> places, const gpu::Parameters& cells,
                                     float reach);

}  // namespace throng::sim
