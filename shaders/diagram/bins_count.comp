// SPDX-License-Identifier: Apache-2.0
// Counts the sites of every bin. The place that a site gets within its bin depends on the order in which the device
// happens to run; the diagram does not, because it compares distances and ids.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) readonly buffer Sites { DiagramSite sites[]; };
layout(std430) buffer Counts { uint counts[]; };
layout(std430) writeonly buffer SitePlaces { uvec2 site_places[]; };  // bin, and place in the bin
#include "shaders/diagram/bins.glsl"

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= live_count) return;
    uvec2 bin = binOf(sites[index].position);
    uint number = bin.y * uint(bin_count.x) + bin.x;
    site_places[index] = uvec2(number, atomicAdd(counts[number], 1u));
}
