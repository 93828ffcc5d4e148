// SPDX-License-Identifier: Apache-2.0
// How many pixels each moving site owns: the area of its truncated cell. Every site counts under its own tile, which
// needs no atomics.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std430) readonly buffer Sites { DiagramSite sites[]; };
layout(std430) writeonly buffer PixelCounts { uint pixel_counts[]; };
uniform vec2 diagram_size;  // whole pixels

#include "shaders/diagram/splat.glsl"
#include "shaders/diagram/owners.glsl"
#include "shaders/diagram/band_slots.glsl"

void main() {
    uint index;
    if (!findSlot(index)) return;
    DiagramSite site = sites[index];
    ivec4 box = tileBox(site.position, site.radius);
    uint owned = 0u;
    for (int y = box.y; y < box.w; ++y)
        for (int x = box.x; x < box.z; ++x) owned += ownerAt(uvec2(x, y)) == site.id ? 1u : 0u;
    pixel_counts[site.id] = owned;
}
