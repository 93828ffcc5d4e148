// SPDX-License-Identifier: Apache-2.0
// Brings the listed blocks of a distance field nearer to |grad T| = cost: the fast iterative method of Jeong and
// Whitaker (2008), block by block. A cell takes its value from its better neighbours on the two axes, exactly as fast
// marching does (authoring/scene/eikonal.cpp), so both end in the same distances; but here all cells of a block go at
// once, round after round, until none of them changes, and blocks beside one that has changed come next. Values only
// ever fall.
//
// All blocks read what the last round left and write beside it, so no order of groups shows in the result.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = FIELD_BLOCK_CELLS) in;
layout(std430) readonly buffer Distances { float distances[]; };
layout(std430) readonly buffer CellSteps { float cell_steps[]; };  // m, what crossing costs; FIELD_FAR: nobody can
layout(std430) readonly buffer ListedBlocks { uint listed_blocks[]; };
layout(std430) writeonly buffer NextDistances { float next_distances[]; };
layout(std430) writeonly buffer ChangedBlocks { uint changed_blocks[]; };
#ifdef BOUND
layout(std430) readonly buffer OpenSides { uint open_sides[]; };
layout(std430) readonly buffer OneWay { vec2 one_way[]; };
#endif

#include "shaders/routes/field_blocks.glsl"

/// News crosses a block in about as many rounds as it has cells on a side, and half of them again round corners.
const uint ROUNDS = 24u;
const uint TILE_SIDE = FIELD_BLOCK_SIDE + 2u;
shared float tile[TILE_SIDE * TILE_SIDE];  // the block and one cell round it

uint inTile(uvec2 local) { return (local.y + 1u) * TILE_SIDE + local.x + 1u; }

float distanceAt(ivec2 cell) {
    bool exists = all(greaterThanEqual(cell, ivec2(0))) && isInGrid(uvec2(cell));
    return exists ? distances[uint(cell.y) * grid_size.x + uint(cell.x)] : FIELD_FAR;
}

/// The block's own cells, and the four sides of what is round it; nobody asks for its corners.
void fillTile(uvec2 cell, uvec2 local) {
    tile[inTile(local)] = distanceAt(ivec2(cell));
    if (local.x == 0u) tile[inTile(local) - 1u] = distanceAt(ivec2(cell) - ivec2(1, 0));
    if (local.x == FIELD_BLOCK_SIDE - 1u) tile[inTile(local) + 1u] = distanceAt(ivec2(cell) + ivec2(1, 0));
    if (local.y == 0u) tile[inTile(local) - TILE_SIDE] = distanceAt(ivec2(cell) - ivec2(0, 1));
    if (local.y == FIELD_BLOCK_SIDE - 1u) tile[inTile(local) + TILE_SIDE] = distanceAt(ivec2(cell) + ivec2(0, 1));
}

/// Which neighbours (right, left, above, below) one may go to from here.
bvec4 waysFrom(uvec2 cell, uint index) {
#ifdef BOUND
    if (!isInGrid(cell)) return bvec4(false);
    uint left = cell.x > 0u ? open_sides[index - 1u] : 0u;
    uint below = cell.y > 0u ? open_sides[index - grid_size.x] : 0u;
    bvec4 open = bvec4((open_sides[index] & OPEN_TO_X) != 0u, (left & OPEN_TO_X) != 0u,
                       (open_sides[index] & OPEN_TO_Y) != 0u, (below & OPEN_TO_Y) != 0u);
    vec2 along = one_way[index];
    bvec4 allowed = greaterThanEqual(vec4(along.x, -along.x, along.y, -along.y), vec4(AGAINST_ONE_WAY));
    return bvec4(open.x && allowed.x, open.y && allowed.y, open.z && allowed.z, open.w && allowed.w);
#else
    return bvec4(true);
#endif
}

float solved(uint at, bvec4 ways, float cell_step) {
    float across = min(ways.x ? tile[at + 1u] : FIELD_FAR, ways.y ? tile[at - 1u] : FIELD_FAR);
    float along = min(ways.z ? tile[at + TILE_SIDE] : FIELD_FAR, ways.w ? tile[at - TILE_SIDE] : FIELD_FAR);
    float near = min(across, along), difference = max(across, along) - near;
    if (near >= FIELD_FAR) return FIELD_FAR;
    if (difference >= cell_step) return near + cell_step;
    return near + 0.5 * (difference + sqrt(max(0.0, 2.0 * cell_step * cell_step - difference * difference)));
}

void main() {
    uint block = listed_blocks[gl_WorkGroupID.x];
    uvec2 cell = cellIn(block), local = cell % FIELD_BLOCK_SIDE;
    uint index = cell.y * grid_size.x + cell.x, at = inTile(local);
    bool exists = isInGrid(cell);
    fillTile(cell, local);
    float cell_step = exists ? cell_steps[index] : FIELD_FAR;
    bvec4 ways = waysFrom(cell, index);
    barrier();
    float before = tile[at], value = before;
    for (uint i = 0u; i < ROUNDS; ++i) {
        if (cell_step < FIELD_FAR) value = min(value, solved(at, ways, cell_step));
        barrier();
        tile[at] = value;
        barrier();
    }
    if (!exists) return;
    next_distances[index] = value;
    if (value < before) changed_blocks[block] = 1u;  // several may write, all the same
}
