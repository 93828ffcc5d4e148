// SPDX-License-Identifier: Apache-2.0
// One round of jump flooding (Rong and Tan 2006): a pixel takes the best of the sites known to itself and to the eight
// pixels `jump` away. Rounds with jumps halving to 1 carry every site far, but not past all others, so some pixels
// never hear of their nearest site; a round of jump 1 before (1+JFA) or after (JFA+1; both Rong and Tan 2007) mends
// many of them.
//
// Best is the nearest of those whose tile reaches the pixel, and where none does, the nearest at all: tiles differ in
// radius, and a site must also travel through pixels that it does not own.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = PIXEL_GROUP_SIZE) in;
layout(std430) readonly buffer Seeds { uint seeds[]; };
layout(std430) writeonly buffer SeedsAfter { uint seeds_after[]; };
uniform usamplerBuffer sites;  // a DiagramSite each, as bits
uniform uvec2 diagram_size;
uniform uint jump;

#include "shaders/diagram/distance.glsl"
#include "shaders/shared/flat_index.glsl"

void main() {
    uint index = flatIndex();
    if (index >= diagram_size.x * diagram_size.y) return;
    ivec2 pixel = ivec2(index % diagram_size.x, index / diagram_size.x);
    const float OUT_OF_REACH = 1.0e12;
    float best = 3.0e38;
    uint best_id = NO_INDEX;
    uint best_seed = NO_INDEX;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            ivec2 from = pixel + ivec2(x, y) * int(jump);
            if (any(lessThan(from, ivec2(0))) || any(greaterThanEqual(from, ivec2(diagram_size)))) continue;
            uint seed = seeds[uint(from.y) * diagram_size.x + uint(from.x)];
            if (seed == NO_INDEX) continue;
            uvec4 words = texelFetch(sites, int(seed));
            float squared = squaredDistance(uintBitsToFloat(words.xy), pixel);
            if (squared > squaredRadius(uintBitsToFloat(words.z))) squared += OUT_OF_REACH;
            if (squared > best || (squared == best && words.w >= best_id)) continue;
            best = squared;
            best_id = words.w;
            best_seed = seed;
        }
    seeds_after[index] = best_seed;
}
