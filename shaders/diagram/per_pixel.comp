// SPDX-License-Identifier: Apache-2.0
// The definition of the diagram as a program: every pixel compares all sites.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = PIXEL_GROUP_SIZE) in;
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) writeonly buffer Owners { uint owners[]; };
uniform usamplerBuffer sites;  // a DiagramSite each, as bits
uniform uvec2 diagram_size;
uniform uint first_pixel;  // of this piece
uniform uint fixed_first;
uniform uint fixed_end;

#include "shaders/diagram/distance.glsl"
#include "shaders/shared/flat_index.glsl"

float nearest = 3.0e38;
uint nearest_id = NO_INDEX;

void compare(ivec2 pixel, uint index) {
    uvec4 words = texelFetch(sites, int(index));
    float squared = squaredDistance(uintBitsToFloat(words.xy), pixel);
    bool wins = squared < nearest || (squared == nearest && words.w < nearest_id);
    wins = wins && squared <= squaredRadius(uintBitsToFloat(words.z));
    nearest = wins ? squared : nearest;
    nearest_id = wins ? words.w : nearest_id;
}

void main() {
    uint index = first_pixel + flatIndex();
    if (index >= diagram_size.x * diagram_size.y) return;
    ivec2 pixel = ivec2(index % diagram_size.x, index / diagram_size.x);
    for (uint i = 0u; i < live_count; ++i) compare(pixel, i);
    for (uint i = fixed_first; i < fixed_end; ++i) compare(pixel, i);
    owners[index] = nearest_id;
}
