// SPDX-License-Identifier: Apache-2.0
// Lists the blocks of this round's fields that have to be worked on: with a crowd, or with changes round about.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = PIXEL_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer ChangedBlocks { uint changed_blocks[]; };
layout(std430) readonly buffer DenseBlocks { uint dense_blocks[]; };
layout(std430) buffer BlockDispatch { uint block_groups[3]; };
layout(std430) writeonly buffer ListedBlocks { uint listed_blocks[]; };
uniform uint first_field;  // of this round
uniform uint field_count;
uniform uint dense_too;    // 1 = also where there is a crowd

#include "shaders/shared/flat_index.glsl"
#include "shaders/routes/detour_blocks.glsl"

bool hasChanged(uint field, int cell) {
    if (cell < 0 || cell >= int(cellsOfMap())) return false;
    return changed_blocks[field * blocksOfMap() + uint(cell) / PIXEL_GROUP_SIZE] != 0u;
}

/// Whether the block or one beside it has changed.
bool hasChangedAround(uint field, uint block) {
    int first = int(block * PIXEL_GROUP_SIZE), last = first + int(PIXEL_GROUP_SIZE) - 1,
        width = int(parameters.detour_width);
    return hasChanged(field, first) || hasChanged(field, first - 1) || hasChanged(field, last + 1) ||
           hasChanged(field, first - width) || hasChanged(field, last - width) ||
           hasChanged(field, first + width) || hasChanged(field, last + width);
}

void main() {
    uint index = flatIndex(), blocks = blocksOfMap();
    if (index >= field_count * blocks) return;
    uvec2 divided = quotientAndRemainder(index, blocks);
    uint field = first_field + divided.x, block = divided.y;
    if ((dense_too != 0u && dense_blocks[block] != 0u) || hasChangedAround(field, block))
        // In whatever order: blocks do not meet.
        listed_blocks[atomicAdd(block_groups[0], 1u)] = field * blocks + block;
}
