// SPDX-License-Identifier: Apache-2.0
// Where each cell's people start within their strip. Only strips where somebody is or was a step ago are touched:
// the cells of all others keep the zeros they have.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = SCAN_GROUP_SIZE) in;
layout(std430) readonly buffer FillDispatch { uint fill_groups[3]; uint fill_total; };
layout(std430) readonly buffer StripList { uint strip_list[]; };
layout(std430) writeonly buffer StripCounts { uint strip_counts[]; };
layout(std430) writeonly buffer StripMarks { uint strip_marks[]; };
layout(std430) readonly buffer CellCounts { uint cell_counts[]; };
layout(std430) writeonly buffer CellOffsets { uint cell_offsets[]; };

const uint BATCH = 16u;  // a divisor of CELLS_PER_STRIP

void main() {
    if (gl_GlobalInvocationID.x >= fill_total) return;
    uint strip = strip_list[gl_GlobalInvocationID.x];
    strip_counts[strip] = 0u;  // ready to count the next step
    strip_marks[strip] = 0u;
    uint offset = 0u;
    uint first = strip * CELLS_PER_STRIP;
    for (uint batch = first; batch < first + CELLS_PER_STRIP; batch += BATCH) {
        uint people[BATCH];  // loaded together: one wait for memory instead of one for each
        for (uint i = 0u; i < BATCH; ++i) people[i] = cell_counts[batch + i];
        for (uint i = 0u; i < BATCH; ++i) {
            cell_offsets[batch + i] = offset;
            offset += people[i];
        }
    }
}
