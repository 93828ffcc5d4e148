// SPDX-License-Identifier: Apache-2.0
// How many groups fill the pages of each range of the store.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = 1) in;
layout(std430) readonly buffer PageCount { uint listed_groups[3]; uint page_count; };
layout(std430) writeonly buffer PageDispatch { uint page_groups[]; };  // three words a range
uniform uint ranges;
uniform uint pages_per_range;
uniform uint blocks_per_page;

void main() {
    for (uint range = 0u; range < ranges; ++range) {
        uint before = range * pages_per_range;
        uint pages = page_count > before ? min(page_count - before, pages_per_range) : 0u;
        page_groups[3u * range] = (pages * blocks_per_page + PIXEL_GROUP_SIZE - 1u) / PIXEL_GROUP_SIZE;
        page_groups[3u * range + 1u] = 1u;
        page_groups[3u * range + 2u] = 1u;
    }
}
