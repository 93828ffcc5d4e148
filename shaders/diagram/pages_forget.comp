// SPDX-License-Identifier: Apache-2.0
// Takes the pages of the last build out of the table again: cheaper than clearing a table of mostly empty squares.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std430) readonly buffer PageCount { uint page_groups[3]; uint page_count; };
layout(std430) readonly buffer PageList { uint page_list[]; };
layout(std430) writeonly buffer PageTable { uint page_table[]; };

void main() {
    uint place = gl_GlobalInvocationID.x;
    if (place == 0u || place >= page_count) return;  // place 0 is the empty page's
    page_table[page_list[place]] = 0u;
}
