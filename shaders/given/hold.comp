// SPDX-License-Identifier: Apache-2.0
// Nobody pushes people whose ways are given off these.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) readonly buffer Bodies { Body bodies[]; };
layout(std430) readonly buffer Walkers { Walker walkers[]; };
layout(std430) readonly buffer States { AgentState states[]; };
layout(std430) buffer Targets { TARGET targets[]; };
uniform float until;  // s: when the step ends

#include "shaders/shared/images.glsl"
#include "shaders/shared/snap.glsl"
#include "shaders/given/ways.glsl"

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= live_count || (walkers[slot].flags & PERSON_IS_GIVEN) == 0u || isImage(walkers[slot].flags)) return;
    uint row = bodies[slot].row;
    targets[slot].xy = inPlane(givenPlace(row, until), states[row].rest);
}
