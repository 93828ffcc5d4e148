// SPDX-License-Identifier: Apache-2.0
// Gives every page that some tile touches a place in the store: all under the tiles of the given sites, and of those
// under fixed tiles, the ones that somebody looks at. Which place depends on the order in which the device happens to
// run; what the pages hold, and what is read through the table, does not.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) readonly buffer Sites { DiagramSite sites[]; };
layout(std430) readonly buffer FixedTable { uint fixed_table[]; };  // not 0 where a fixed tile touches the page
layout(std430) buffer PageTable { uint page_table[]; };
layout(std430) buffer PageCount { uint page_groups[3]; uint page_count; };
layout(std430) writeonly buffer PageList { uint page_list[]; };
uniform vec2 diagram_size;  // whole pixels
uniform uint pages_per_line;
uniform uint page_capacity;
uniform float look;  // px: how far people look; negative: not at all

#include "shaders/diagram/splat.glsl"
#include "shaders/diagram/near.glsl"

void placePage(uint page) {
    // Place 0 is the empty page, which stands for "none"; NO_INDEX marks a page that somebody is placing.
    if (page_table[page] != 0u || atomicCompSwap(page_table[page], 0u, NO_INDEX) != 0u) return;
    uint place = min(atomicAdd(page_count, 1u), page_capacity - 1u);
    page_list[place] = page;
    page_table[page] = place;
    if (place % AGENT_GROUP_SIZE == 0u) atomicAdd(page_groups[0], 1u);
}

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= live_count) return;
    DiagramSite site = sites[index];
    ivec4 box = tileBox(site.position, site.radius);
    if (box.x < box.z && box.y < box.w) {
        uvec2 lower = uvec2(box.xy) / PAGE_SIDE;
        uvec2 upper = uvec2(box.zw - 1) / PAGE_SIDE;
        for (uint y = lower.y; y <= upper.y; ++y)
            for (uint x = lower.x; x <= upper.x; ++x) placePage(y * pages_per_line + x);
    }
    if (look < 0.0) return;
    uvec2 lower, upper;
    pagesNear(site.position, look, lower, upper);
    for (uint y = lower.y; y <= upper.y; ++y)
        for (uint x = lower.x; x <= upper.x; ++x) {
            uint page = y * pages_per_line + x;
            if (fixed_table[page] != 0u) placePage(page);
        }
}
