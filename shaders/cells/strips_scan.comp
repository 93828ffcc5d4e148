// SPDX-License-Identifier: Apache-2.0
// Where each strip's people start, and how many groups passes over people and over listed strips need.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = SCAN_GROUP_SIZE) in;
layout(std430) readonly buffer Counts { uint counts[]; };  // per strip
layout(std430) readonly buffer GroupSums { uint group_sums[]; };
layout(std430) writeonly buffer StripStarts { uint strip_starts[]; };
layout(std430) buffer StripListEnd { uint strip_list_end; };
layout(std430) writeonly buffer FillDispatch { uint fill_groups[3]; uint fill_total; };
layout(std430) writeonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) writeonly buffer TouchDispatch { uint touch_groups[3]; uint touch_count; };
uniform uint count_total;  // how many strips there are

#include "shaders/cells/prefix_sum.glsl"

void main() {
    uint first = gl_GlobalInvocationID.x * COUNTS_PER_THREAD;
    uint last = min(first + COUNTS_PER_THREAD, count_total);
    uint start = sumBefore(first, last);
    for (uint strip = first; strip < last; ++strip) {
        strip_starts[strip] = start;
        start += counts[strip];
    }
    if (first < count_total && last == count_total) {
        fill_groups[0] = (strip_list_end + SCAN_GROUP_SIZE - 1u) / SCAN_GROUP_SIZE;
        fill_groups[1] = 1u;
        fill_groups[2] = 1u;
        fill_total = strip_list_end;
        strip_list_end = 0u;
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
