// SPDX-License-Identifier: Apache-2.0
// Patches: ground that people walk on at another pace. Where several lie over each other, their paces are multiplied.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) readonly buffer Bodies { Body bodies[]; };
layout(std430) readonly buffer Patches { Patch patches[]; };
layout(std430) readonly buffer PatchPoints { vec2 patch_points[]; };
layout(std430) buffer PreferredVelocities { vec2 preferred_velocities[]; };
uniform uint patch_count;
uniform float now;  // s

#include "shaders/motion/on_patch.glsl"

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= live_count) return;
    vec2 place = bodies[slot].position;
    float pace = 1.0;
    for (uint i = 0u; i < patch_count; ++i)
        if (holds(patches[i], place, now)) pace *= patches[i].pace;
    if (pace != 1.0) preferred_velocities[slot] *= pace;
}
