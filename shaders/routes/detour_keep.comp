// SPDX-License-Identifier: Apache-2.0
// Keeps what a round has found.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = PIXEL_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer ListedBlocks { uint listed_blocks[]; };
layout(std430) readonly buffer NextDistances { float next_distances[]; };  // of the fields of this round
layout(std430) writeonly buffer DetourDistances { float detour_distances[]; };
uniform uint first_field;  // of this round

#include "shaders/routes/detour_blocks.glsl"

void main() {
    ListedCell mine = cellOfBlock(listed_blocks[gl_WorkGroupID.x]);
    if (mine.cell >= cellsOfMap()) return;
    detour_distances[mine.field * cellsOfMap() + mine.cell] =
        next_distances[(mine.field - first_field) * cellsOfMap() + mine.cell];
}
