// SPDX-License-Identifier: Apache-2.0
// A grid of cells in square blocks, one for each group: see sim/field_solver.h.
uniform uvec2 grid_size;  // cells

uvec2 blockGrid() { return (grid_size + FIELD_BLOCK_SIDE - 1u) / FIELD_BLOCK_SIDE; }

/// The cell of this invocation in a block.
uvec2 cellIn(uint block) {
    uvec2 corner = uvec2(block % blockGrid().x, block / blockGrid().x) * FIELD_BLOCK_SIDE;
    return corner + uvec2(gl_LocalInvocationID.x % FIELD_BLOCK_SIDE, gl_LocalInvocationID.x / FIELD_BLOCK_SIDE);
}

bool isInGrid(uvec2 cell) { return all(lessThan(cell, grid_size)); }
