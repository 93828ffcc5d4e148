// SPDX-License-Identifier: Apache-2.0
// Lists the pages of a whole picture that somebody looks at in this build, each once. In whatever order: every pixel is
// worked out by itself.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std430) readonly buffer Sites { DiagramSite sites[]; };
layout(std430) buffer PageStamps { uint page_stamps[]; };  // the last build that listed the page
layout(std430) buffer PageCount { uint page_groups[3]; uint page_count; };
layout(std430) writeonly buffer PageList { uint page_list[]; };
uniform vec2 diagram_size;  // whole pixels
uniform float look;         // px: how far people look
uniform uint pages_per_line;
uniform uint pages_per_group;  // of the pass that fills them
uniform uint stamp;            // of this build

#include "shaders/diagram/band_slots.glsl"
#include "shaders/diagram/near.glsl"

void main() {
    uint index;
    if (!findSlot(index)) return;
    uvec2 lower, upper;
    pagesNear(sites[index].position, max(look, sites[index].radius), lower, upper);
    for (uint y = lower.y; y <= upper.y; ++y)
        for (uint x = lower.x; x <= upper.x; ++x) {
            uint page = y * pages_per_line + x;
            if (page_stamps[page] == stamp || atomicExchange(page_stamps[page], stamp) == stamp) continue;
            uint place = atomicAdd(page_count, 1u);
            page_list[place] = page;
            if (place % pages_per_group == 0u) atomicAdd(page_groups[0], 1u);
        }
}
