// SPDX-License-Identifier: Apache-2.0
// Blending keeps the smallest value (Strzodka and Telea 2004). Only float targets blend, so ids travel as the bits of
// positive floats, which order like unsigned integers, from the smallest normal number on.
//   BLEND_DISTANCE  first exact pass: the squared distance
//   BLEND_SITE      second exact pass: of the sites at that distance, the id
//   BLEND_PACKED    both in one pass, with as many bits for the distance as the id leaves
#include "shaders/shared/simulation_types.h"

flat in vec2 site_position;
flat in float site_radius;
flat in uint site_id;
layout(location = 0) out float key;
uniform float margin;
#ifdef BLEND_SITE
uniform sampler2D smallest_distance;
#endif
#ifdef BLEND_PACKED
uniform float distance_steps;  // of the quantised distance, per squared pixel
uniform uint id_bits;
#endif

#include "shaders/diagram/distance.glsl"

void main() {
    float squared = squaredDistance(site_position, ivec2(gl_FragCoord.xy) - ivec2(margin));
    if (squared > squaredRadius(site_radius)) discard;
#if defined(BLEND_DISTANCE)
    key = squared;
#elif defined(BLEND_SITE)
    if (squared != texelFetch(smallest_distance, ivec2(gl_FragCoord.xy), 0).r) discard;
    key = uintBitsToFloat(SMALLEST_NORMAL + site_id);
#else
    key = uintBitsToFloat(SMALLEST_NORMAL + ((uint(squared * distance_steps) << id_bits) | site_id));
#endif
}
