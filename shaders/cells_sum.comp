// SPDX-License-Identifier: Apache-2.0
// First half of the prefix sum over cells: one total per group of threads.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = SCAN_GROUP_SIZE) in;
layout(std430) readonly buffer CellCounts { uint cell_counts[]; };
layout(std430) writeonly buffer GroupSums { uint group_sums[]; };
uniform uint cell_count;

shared uint thread_sums[SCAN_GROUP_SIZE];

void main() {
    uint first = gl_GlobalInvocationID.x * CELLS_PER_THREAD;
    uint last = min(first + CELLS_PER_THREAD, cell_count);
    uint sum = 0u;
    for (uint cell = first; cell < last; ++cell) sum += cell_counts[cell];
    thread_sums[gl_LocalInvocationID.x] = sum;
    barrier();
    if (gl_LocalInvocationID.x == 0u) {
        uint total = 0u;
        for (uint i = 0u; i < SCAN_GROUP_SIZE; ++i) total += thread_sums[i];
        group_sums[gl_WorkGroupID.x] = total;
    }
}
