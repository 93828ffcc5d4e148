// SPDX-License-Identifier: Apache-2.0
// Second pass of the diagram: of the sites at the smallest distance, the smallest id.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) readonly buffer Sites { DiagramSite sites[]; };
layout(std430) readonly buffer Distances { uint distances[]; };
layout(std430) buffer Owners { uint owners[]; };
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
            if (squared <= limit && floatBitsToUint(squared) == distances[line + x])
                atomicMin(owners[line + x], site.id);
        }
    }
}
