// SPDX-License-Identifier: Apache-2.0
// First pass of the diagram: the smallest squared distance (float bits) in every pixel.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) readonly buffer Sites { DiagramSite sites[]; };
layout(std430) buffer Distances { uint distances[]; };
uniform vec2 diagram_size;  // whole pixels

#include "shaders/diagram/splat.glsl"

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= live_count) return;
    DiagramSite site = sites[index];
    float limit = squaredRadius(site.radius);
    ivec4 box = tileBox(site.position, site.radius);
    for (int y = box.y; y < box.w; ++y) {
        int line = y * int(diagram_size.x);
        for (int x = box.x; x < box.z; ++x) {
            float squared = squaredDistance(site.position, ivec2(x, y));
            if (squared <= limit) atomicMin(distances[line + x], floatBitsToUint(squared));
        }
    }
}
