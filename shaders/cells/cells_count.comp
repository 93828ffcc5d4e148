// SPDX-License-Identifier: Apache-2.0
// Counts the people of every cell and of every strip of cells, and lists the strips where somebody is or was a step
// ago. Counts are integers, so the order of the additions does not matter, nor does that of the list.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer States { AgentState states[]; };
layout(std430) buffer CellCounts { uint cell_counts[]; };
layout(std430) buffer StripCounts { uint strip_counts[]; };
layout(std430) buffer StripMarks { uint strip_marks[]; };  // 1: listed
layout(std430) buffer StripListEnd { uint strip_list_end; };
layout(std430) writeonly buffer StripList { uint strip_list[]; };
layout(std430) buffer RowCells { uint row_cells[]; };

#include "shaders/cells/cells.glsl"
#include "shaders/shared/alive.glsl"
#include "shaders/shared/charts.glsl"

void list(uint strip) {
    if (strip_marks[strip] == 0u && atomicExchange(strip_marks[strip], 1u) == 0u)
        strip_list[atomicAdd(strip_list_end, 1u)] = strip;
}

void main() {
    uint row = gl_GlobalInvocationID.x;
    if (row >= parameters.site_rows) return;
    uint before = row_cells[row];
    if (before != NO_INDEX) list(before / CELLS_PER_STRIP);
    uint cell = NO_INDEX;
    uint person = personOf(row);
    vec2 shift;
    if (isAlive(states[person].status) && imageShift(row, states[person].position, shift)) {
        cell = cellIndex(cellOf(states[person].position + shift));
        atomicAdd(cell_counts[cell], 1u);
        atomicAdd(strip_counts[cell / CELLS_PER_STRIP], 1u);
        list(cell / CELLS_PER_STRIP);
    }
    row_cells[row] = cell;
}
