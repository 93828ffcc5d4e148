// SPDX-License-Identifier: Apache-2.0
// Where each cell's people start within their strip. Only strips where somebody is or was a step ago are touched:
// the cells of all others keep the zeros they have.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = SCAN_GROUP_SIZE) in;
layout(std430) readonly buffer FillDispatch { uint fill_groups[3]; uint fill_total; };
layout(std430) readonly buffer StripList { uint strip_list[]; };
layout(std430) readonly buffer StripStarts { uint strip_starts[]; };
layout(std430) writeonly buffer StripCounts { uint strip_counts[]; };
layout(std430) writeonly buffer StripMarks { uint strip_marks[]; };
layout(std430) buffer CellCounts { uint cell_counts[]; };
layout(std430) writeonly buffer CellOffsets { uint cell_offsets[]; };
layout(std430) writeonly buffer CellCursors { uint cell_cursors[]; };

void main() {
    if (gl_GlobalInvocationID.x >= fill_total) return;
    uint strip = strip_list[gl_GlobalInvocationID.x];
    strip_counts[strip] = 0u;  // ready to count the next step
    strip_marks[strip] = 0u;
    uint start = strip_starts[strip];
    uint offset = 0u;
    for (uint cell = strip * CELLS_PER_STRIP; cell < (strip + 1u) * CELLS_PER_STRIP; ++cell) {
        cell_offsets[cell] = offset;
        uint people = cell_counts[cell];
        if (people == 0u) continue;
        cell_counts[cell] = 0u;
        cell_cursors[cell] = start + offset;
        offset += people;
    }
}
