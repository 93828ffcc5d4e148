// SPDX-License-Identifier: Apache-2.0
// Where the people of a cell start. In a wide world nearly all cells are empty, and yet where an empty cell starts
// changes whenever somebody before it comes or goes. So a cell only knows how many people of its strip of
// CELLS_PER_STRIP cells stand before it (0 in all cells of a strip without people), and the strip knows where it
// starts: a step adds up the strips, and writes only the cells of those that have or had people.

layout(std430) readonly buffer StripStarts { uint strip_starts[]; };
layout(std430) readonly buffer CellOffsets { uint cell_offsets[]; };

/// The first slot of a cell; of one past the last cell, how many people there are.
uint cellStart(uint cell) { return strip_starts[cell / CELLS_PER_STRIP] + cell_offsets[cell]; }
