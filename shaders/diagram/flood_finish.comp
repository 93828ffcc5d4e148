// SPDX-License-Identifier: Apache-2.0
// Truncates a flooded diagram and names the owners.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = PIXEL_GROUP_SIZE) in;
layout(std430) readonly buffer Seeds { uint seeds[]; };
layout(std430) writeonly buffer Owners { uint owners[]; };
uniform usamplerBuffer sites;  // a DiagramSite each, as bits
uniform uvec2 diagram_size;

#include "shaders/diagram/distance.glsl"
#include "shaders/shared/flat_index.glsl"

void main() {
    uint index = flatIndex();
    if (index >= diagram_size.x * diagram_size.y) return;
    uint owner = NO_INDEX;
    uint seed = seeds[index];
    if (seed != NO_INDEX) {
        uvec4 words = texelFetch(sites, int(seed));
        float squared = squaredDistance(uintBitsToFloat(words.xy),
                                        ivec2(index % diagram_size.x, index / diagram_size.x));
        if (squared <= squaredRadius(uintBitsToFloat(words.z))) owner = words.w;
    }
    owners[index] = owner;
}
