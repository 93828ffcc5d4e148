// SPDX-License-Identifier: Apache-2.0
// The coarse map in blocks of one group of invocations each. Where the crowd is thin and nothing has changed round
// about, nothing will: only the other blocks are listed and worked on, so that a jam costs as much as it is large, and
// not as the map is. A listed block has the number field * blocksOfMap() + block.

#include "shaders/shared/quotient.glsl"

uint cellsOfMap() { return parameters.detour_width * parameters.detour_height; }
uint blocksOfMap() { return (cellsOfMap() + PIXEL_GROUP_SIZE - 1u) / PIXEL_GROUP_SIZE; }

/// An invocation's cell of a listed block.
struct ListedCell {
    uint field;
    uint cell;
};

ListedCell cellOfBlock(uint listed) {
    uvec2 divided = quotientAndRemainder(listed, blocksOfMap());
    return ListedCell(divided.x, divided.y * PIXEL_GROUP_SIZE + gl_LocalInvocationID.x);
}

/// Cells beside a cell: left, right, below, above; where the map ends, the cell itself, and no way leads there.
struct CellsBeside {
    uvec4 cells;
    bvec4 exist;
};

CellsBeside cellsBeside(uint cell) {
    uint width = parameters.detour_width;
    uint x = quotientAndRemainder(cell, width).y;
    bvec4 exist = bvec4(x > 0u, x + 1u < width, cell >= width, cell + width < cellsOfMap());
    uvec4 beside = uvec4(cell - 1u, cell + 1u, cell - width, cell + width);
    return CellsBeside(mix(uvec4(cell), beside, exist), exist);
}
