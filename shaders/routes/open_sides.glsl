// SPDX-License-Identifier: Apache-2.0
// Where one gets from a cell of the coarse map to the cells beside it. Needs detour_blocks.glsl and detour_maps.glsl.

/// Left, right, below, above. @param ground_first of the field's ground; @param own open sides of the cell
bvec4 openBeside(uint ground_first, CellsBeside at, uint own) {
    uint left = groundAt(ground_first + at.cells.x).open_sides, below = groundAt(ground_first + at.cells.z).open_sides;
    uvec4 sides = uvec4(left, own, below, own);
    bvec4 open = notEqual(sides & uvec4(OPEN_TO_X, OPEN_TO_X, OPEN_TO_Y, OPEN_TO_Y), uvec4(0u));
    return mix(bvec4(false), open, at.exist);
}
