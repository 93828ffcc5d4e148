// SPDX-License-Identifier: Apache-2.0
// Second half of a prefix sum over `counts`: needs the blocks Counts and GroupSums (one total per group of threads,
// from counts_sum.comp), and groups of SCAN_GROUP_SIZE.

shared uint thread_sums[SCAN_GROUP_SIZE];

/// The sum of all counts before this thread's first one, `first`; `last` is one past its last.
uint sumBefore(uint first, uint last) {
    uint thread = gl_LocalInvocationID.x;
    // What stands before this group, added up by all its threads together.
    uint before = 0u;
    for (uint group = thread; group < gl_WorkGroupID.x; group += SCAN_GROUP_SIZE) before += group_sums[group];
    thread_sums[thread] = before;
    barrier();
    uint start = 0u;
    for (uint i = 0u; i < SCAN_GROUP_SIZE; ++i) start += thread_sums[i];
    barrier();

    uint sum = 0u;
    for (uint i = first; i < last; ++i) sum += counts[i];
    thread_sums[thread] = sum;
    barrier();
    for (uint i = 0u; i < thread; ++i) start += thread_sums[i];
    return start;
}
