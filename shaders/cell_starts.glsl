// SPDX-License-Identifier: Apache-2.0
// Where the people of a cell start. In a wide world nearly all cells are empty, and yet where an empty cell starts
// changes whenever somebody before it comes or goes. So a cell only knows where it starts within its strip of
// CELLS_PER_STRIP cells (0 where nobody is, for good), and the strip knows where it starts: a step touches every
// strip once and only the cells where somebody is.

layout(std430) readonly buffer StripStarts { uint strip_starts[]; };
layout(std430) readonly buffer CellOffsets { uint cell_offsets[]; };

/// The first slot of a cell; of one past the last cell, how many people there are.
uint cellStart(uint cell) { return strip_starts[cell / CELLS_PER_STRIP] + cell_offsets[cell]; }
