// SPDX-License-Identifier: Apache-2.0
// Gives every page that some tile touches a place in the store. Which place depends on the order in which the device
// happens to run; what the pages hold, and what is read through the table, does not.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) readonly buffer Sites { DiagramSite sites[]; };
layout(std430) buffer PageTable { uint page_table[]; };
layout(std430) buffer PageCount { uint page_count; };
layout(std430) writeonly buffer PageList { uint page_list[]; };
uniform vec2 diagram_size;  // whole pixels
uniform uint pages_per_line;
uniform uint page_capacity;

#include "shaders/diagram/splat.glsl"

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= live_count) return;
    DiagramSite site = sites[index];
    ivec4 box = tileBox(site.position, site.radius);
    if (box.x >= box.z || box.y >= box.w) return;
    uvec2 lower = uvec2(box.xy) / PAGE_SIDE;
    uvec2 upper = uvec2(box.zw - 1) / PAGE_SIDE;
    for (uint y = lower.y; y <= upper.y; ++y)
        for (uint x = lower.x; x <= upper.x; ++x) {
            uint page = y * pages_per_line + x;
            // Place 0 is the empty page, which stands for "none"; NO_INDEX marks a page that somebody is placing.
            if (page_table[page] != 0u || atomicCompSwap(page_table[page], 0u, NO_INDEX) != 0u) continue;
            uint place = atomicAdd(page_count, 1u);
            page_list[min(place, page_capacity - 1u)] = page;
            page_table[page] = min(place, page_capacity - 1u);
        }
}
