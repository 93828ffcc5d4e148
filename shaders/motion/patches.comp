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

#include "shaders/shared/outline.glsl"

bool isIn(Patch ground, vec2 place) {
    if (any(lessThan(place, ground.lower)) || any(greaterThan(place, ground.upper))) return false;
    bool inside = false;
    vec2 before = patch_points[ground.first_point + ground.point_count - 1u];
    for (uint i = 0u; i < ground.point_count; ++i) {
        vec2 point = patch_points[ground.first_point + i];
        if (rayGoesOver(point, before, place)) inside = !inside;
        before = point;
    }
    return inside;
}

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= live_count) return;
    vec2 place = bodies[slot].position;
    float pace = 1.0;
    for (uint i = 0u; i < patch_count; ++i)
        if (now >= patches[i].from && now < patches[i].until && isIn(patches[i], place)) pace *= patches[i].pace;
    if (pace != 1.0) preferred_velocities[slot] *= pace;
}
