// SPDX-License-Identifier: Apache-2.0
// Keeps what a round of field_relax.comp has found, so that the next one reads it.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = FIELD_BLOCK_CELLS) in;
layout(std430) readonly buffer ListedBlocks { uint listed_blocks[]; };
layout(std430) readonly buffer NextDistances { float next_distances[]; };
layout(std430) writeonly buffer Distances { float distances[]; };

#include "shaders/routes/field_blocks.glsl"

void main() {
    uvec2 cell = cellIn(listed_blocks[gl_WorkGroupID.x]);
    uint index = cell.y * grid_size.x + cell.x;
    if (isInGrid(cell)) distances[index] = next_distances[index];
}
