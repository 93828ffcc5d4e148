// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
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

/// The starts for those scenes, most of them, in which few cells are near walls
/// (shaders/cells/walls_near.glsl): for every 32 cells a word with a bit for each that has segments, and the
/// place in the whole of the first one's start; then the starts of those that have any, and where the last
/// one's end.
std::vector<std::uint32_t> startsOfMarked(const WallIndex& index);

/// The segments of a cell, by such starts: the first of the items, and one past the last.
glm::uvec2 wallsNear(std::span<const std::uint32_t> starts, std::size_t cell);

/// One bit for every cell, 32 in a word: whether some point of it may lie within `reach` (m) of a place.
std::vector<std::uint32_t> markCells(std::span<const glm::vec2> places, const gpu::Parameters& cells,
                                     float reach);

}  // namespace throng::sim
