// SPDX-License-Identifier: Apache-2.0
// Lists the blocks that the next round of field_relax.comp has to look at: those that changed, and those beside them.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std430) readonly buffer ChangedBlocks { uint changed_blocks[]; };
layout(std430) buffer BlockDispatch { uint block_groups[3]; };
layout(std430) writeonly buffer ListedBlocks { uint listed_blocks[]; };

#include "shaders/routes/field_blocks.glsl"

bool hasChanged(ivec2 block) {
    uvec2 blocks = blockGrid();
    if (any(lessThan(block, ivec2(0))) || any(greaterThanEqual(uvec2(block), blocks))) return false;
    return changed_blocks[uint(block.y) * blocks.x + uint(block.x)] != 0u;
}

void main() {
    uint index = gl_GlobalInvocationID.x;
    uvec2 blocks = blockGrid();
    if (index >= blocks.x * blocks.y) return;
    ivec2 block = ivec2(index % blocks.x, index / blocks.x);
    if (hasChanged(block) || hasChanged(block + ivec2(1, 0)) || hasChanged(block - ivec2(1, 0)) ||
        hasChanged(block + ivec2(0, 1)) || hasChanged(block - ivec2(0, 1)))
        listed_blocks[atomicAdd(block_groups[0], 1u)] = index;  // in whatever order: blocks do not meet
}
