// SPDX-License-Identifier: Apache-2.0
// Where each bin's sites start.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = SCAN_GROUP_SIZE) in;
layout(std430) readonly buffer Counts { uint counts[]; };
layout(std430) readonly buffer GroupSums { uint group_sums[]; };
layout(std430) writeonly buffer BinStarts { uint bin_starts[]; };  // and one past the last
uniform uint count_total;

#include "shaders/cells/prefix_sum.glsl"

void main() {
    uint first = gl_GlobalInvocationID.x * COUNTS_PER_THREAD;
    uint last = min(first + COUNTS_PER_THREAD, count_total);
    uint start = sumBefore(first, last);
    for (uint bin = first; bin < last; ++bin) {
        bin_starts[bin] = start;
        start += counts[bin];
    }
    if (first < count_total && last == count_total) bin_starts[count_total] = start;
}
