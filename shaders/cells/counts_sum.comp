// SPDX-License-Identifier: Apache-2.0
// First half of a prefix sum: one total per group of threads.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = SCAN_GROUP_SIZE) in;
layout(std430) readonly buffer Counts { uint counts[]; };
layout(std430) writeonly buffer GroupSums { uint group_sums[]; };
uniform uint count_total;  // how many counts there are

shared uint thread_sums[SCAN_GROUP_SIZE];

void main() {
    uint first = gl_GlobalInvocationID.x * COUNTS_PER_THREAD;
    uint last = min(first + COUNTS_PER_THREAD, count_total);
    uint sum = 0u;
    for (uint i = first; i < last; ++i) sum += counts[i];
    thread_sums[gl_LocalInvocationID.x] = sum;
    barrier();
    if (gl_LocalInvocationID.x == 0u) {
        uint total = 0u;
        for (uint i = 0u; i < SCAN_GROUP_SIZE; ++i) total += thread_sums[i];
        group_sums[gl_WorkGroupID.x] = total;
    }
}
