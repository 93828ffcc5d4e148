// SPDX-License-Identifier: Apache-2.0
// From blended keys back to ids.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = PIXEL_GROUP_SIZE) in;
layout(std430) readonly buffer Keys { uint keys[]; };
layout(std430) writeonly buffer Owners { uint owners[]; };
uniform uint pixel_count;
uniform uint id_mask;
uniform float nobody;  // what the target is cleared to

#include "shaders/shared/flat_index.glsl"

void main() {
    uint pixel = flatIndex();
    if (pixel >= pixel_count) return;
    uint key = keys[pixel];
    owners[pixel] = key == floatBitsToUint(nobody) ? NO_INDEX : (key - SMALLEST_NORMAL) & id_mask;
}
