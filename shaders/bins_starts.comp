// SPDX-License-Identifier: Apache-2.0
// Where each bin's sites start.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = SCAN_GROUP_SIZE) in;
layout(std430) readonly buffer CellCounts { uint cell_counts[]; };
layout(std430) readonly buffer GroupSums { uint group_sums[]; };
layout(std430) writeonly buffer BinStarts { uint bin_starts[]; };  // and one past the last
uniform uint cell_count;

#include "shaders/prefix_sum.glsl"

void main() {
    uint first = gl_GlobalInvocationID.x * CELLS_PER_THREAD;
    uint last = min(first + CELLS_PER_THREAD, cell_count);
    uint start = sumBefore(first, last);
    for (uint bin = first; bin < last; ++bin) {
        bin_starts[bin] = start;
        start += cell_counts[bin];
    }
    if (first < cell_count && last == cell_count) bin_starts[cell_count] = start;
}
