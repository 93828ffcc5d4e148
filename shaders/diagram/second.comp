// SPDX-License-Identifier: Apache-2.0
// The second-nearest site of every pixel, of those whose tile reaches it: with the owner, the second-order diagram
// (Sud, Andersen, Curtis, Lin and Manocha 2007). Gathers from the bins like binned.comp, leaving the owner out.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = PIXEL_GROUP_SIZE) in;
layout(std430) readonly buffer Owners { uint owners[]; };
layout(std430) readonly buffer BinStarts { uint bin_starts[]; };
layout(std430) writeonly buffer Seconds { uint seconds[]; };
uniform usamplerBuffer binned_sites;  // a DiagramSite each, as bits
uniform uvec2 diagram_size;
uniform float largest_radius;  // px

#ifdef FIXED_SITES
layout(std430) readonly buffer FixedBinStarts { uint fixed_bin_starts[]; };
uniform usamplerBuffer fixed_binned_sites;
#endif

#include "shaders/diagram/bins.glsl"
#include "shaders/diagram/distance.glsl"
#include "shaders/shared/flat_index.glsl"

float nearest = 3.0e38;
uint nearest_id = NO_INDEX;

void compare(ivec2 pixel, uint owner, uvec4 words) {
    float squared = squaredDistance(uintBitsToFloat(words.xy), pixel);
    bool wins = squared < nearest || (squared == nearest && words.w < nearest_id);
    wins = wins && words.w != owner && squared <= squaredRadius(uintBitsToFloat(words.z));
    nearest = wins ? squared : nearest;
    nearest_id = wins ? words.w : nearest_id;
}

void main() {
    uint index = flatIndex();
    if (index >= diagram_size.x * diagram_size.y) return;
    uint owner = owners[index];
    if (owner != NO_INDEX) {
        ivec2 pixel = ivec2(index % diagram_size.x, index / diagram_size.x);
        uvec2 lower = binOf(vec2(pixel) - largest_radius);
        uvec2 upper = binOf(vec2(pixel) + 1.0 + largest_radius);
        for (uint line = lower.y; line <= upper.y; ++line) {
            uint bins = line * uint(bin_count.x);
            uint last = bin_starts[bins + upper.x + 1u];
            for (uint i = bin_starts[bins + lower.x]; i < last; ++i)
                compare(pixel, owner, texelFetch(binned_sites, int(i)));
#ifdef FIXED_SITES
            last = fixed_bin_starts[bins + upper.x + 1u];
            for (uint i = fixed_bin_starts[bins + lower.x]; i < last; ++i)
                compare(pixel, owner, texelFetch(fixed_binned_sites, int(i)));
#endif
        }
    }
    seconds[index] = nearest_id;
}
