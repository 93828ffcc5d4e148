// SPDX-License-Identifier: Apache-2.0
// Second half of the prefix sum: where each cell's people start, and how many groups a pass over people needs.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = SCAN_GROUP_SIZE) in;
layout(std430) readonly buffer CellCounts { uint cell_counts[]; };
layout(std430) readonly buffer GroupSums { uint group_sums[]; };
layout(std430) writeonly buffer CellStarts { uint cell_starts[]; };
layout(std430) writeonly buffer CellCursors { uint cell_cursors[]; };
layout(std430) writeonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) writeonly buffer TouchDispatch { uint touch_groups[3]; uint touch_count; };
uniform uint cell_count;

#include "shaders/prefix_sum.glsl"

void main() {
    uint first = gl_GlobalInvocationID.x * CELLS_PER_THREAD;
    uint last = min(first + CELLS_PER_THREAD, cell_count);
    uint start = sumBefore(first, last);
    for (uint cell = first; cell < last; ++cell) {
        cell_starts[cell] = start;
        cell_cursors[cell] = start;
        start += cell_counts[cell];
    }
    if (first < cell_count && last == cell_count) {
        cell_starts[cell_count] = start;
        live_groups[0] = (start + AGENT_GROUP_SIZE - 1u) / AGENT_GROUP_SIZE;
        live_groups[1] = 1u;
        live_groups[2] = 1u;
        live_count = start;
        // Sensing counts up to what the contact pass needs.
        touch_groups[0] = 0u;
        touch_groups[1] = 1u;
        touch_groups[2] = 1u;
        touch_count = 0u;
    }
}
