// SPDX-License-Identifier: Apache-2.0
// Puts every site into the pixel that it stands in, those outside into the nearest one. Of several in one pixel the
// first in memory stays and the others are lost: that is where most of jump flooding's error comes from.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) readonly buffer Sites { DiagramSite sites[]; };
layout(std430) buffer Seeds { uint seeds[]; };
uniform uvec2 diagram_size;
uniform uint fixed_first;
uniform uint fixed_end;

#include "shaders/shared/flat_index.glsl"

void main() {
    uint index = flatIndex();
    if (index >= fixed_end || (index >= live_count && index < fixed_first)) return;
    vec2 inside = clamp(sites[index].position, vec2(0.0), vec2(diagram_size) - 1.0);
    if (distance(inside, sites[index].position) > sites[index].radius + 1.0) return;
    uvec2 pixel = uvec2(inside);
    atomicMin(seeds[pixel.y * diagram_size.x + pixel.x], index);
}
