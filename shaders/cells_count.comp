// SPDX-License-Identifier: Apache-2.0
// Counts the people of every cell. Counts are integers, so the order of the additions does not matter.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer States { AgentState states[]; };
layout(std430) buffer CellCounts { uint cell_counts[]; };
layout(std430) writeonly buffer RowCells { uint row_cells[]; };

#include "shaders/cells.glsl"
#include "shaders/alive.glsl"

void main() {
    uint row = gl_GlobalInvocationID.x;
    if (row >= parameters.row_count) return;
    uint cell = NO_INDEX;
    if (isAlive(states[row].status)) {
        cell = cellIndex(cellOf(states[row].position));
        atomicAdd(cell_counts[cell], 1u);
    }
    row_cells[row] = cell;
}
