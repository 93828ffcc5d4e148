// SPDX-License-Identifier: Apache-2.0
// The walls that somebody in a cell could touch or feel (sim/wall_index.h). Few cells have any: 32 cells share a word
// of marks and a place where the starts of those begin that are marked.
// Needs the block WallStarts.

/// Segments of a cell: the first of wall_items, and one past the last.
uvec2 wallsNear(uint cell) {
    uint marks = wall_starts[cell / 32u * 2u], bit = 1u << cell % 32u;
    if ((marks & bit) == 0u) return uvec2(0u);
    uint at = wall_starts[cell / 32u * 2u + 1u] + uint(bitCount(marks & (bit - 1u)));
    return uvec2(wall_starts[at], wall_starts[at + 1u]);
}

bool hasWalls(uint cell) { return (wall_starts[cell / 32u * 2u] >> cell % 32u & 1u) != 0u; }
