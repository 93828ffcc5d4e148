// SPDX-License-Identifier: Apache-2.0
// Copies every site to its place among the sites of its bin.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) readonly buffer Sites { DiagramSite sites[]; };
layout(std430) readonly buffer BinStarts { uint bin_starts[]; };
layout(std430) readonly buffer SitePlaces { uvec2 site_places[]; };
layout(std430) writeonly buffer BinnedSites { DiagramSite binned_sites[]; };

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= live_count) return;
    uvec2 place = site_places[index];
    binned_sites[bin_starts[place.x] + place.y] = sites[index];
}
