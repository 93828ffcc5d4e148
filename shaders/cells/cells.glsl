// SPDX-License-Identifier: Apache-2.0
// The grid of cells that exact short-range queries go through.
//
// Cells are numbered along x first, and people are stored in that order, so the three cells around a person in one
// line of cells are one run of slots: a query over 3 x 3 cells reads three runs.

ivec2 cellOf(vec2 position) {
    ivec2 cell = ivec2(floor((position - parameters.cells_minimum) / parameters.cell_size));
    return clamp(cell, ivec2(0), ivec2(parameters.cells_width, parameters.cells_height) - 1);
}

uint cellIndex(ivec2 cell) { return uint(cell.y) * parameters.cells_width + uint(cell.x); }
