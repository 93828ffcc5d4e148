// SPDX-License-Identifier: Apache-2.0
// What others see of people whose ways are given: that they go on as they will.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) readonly buffer Bodies { Body bodies[]; };
layout(std430) buffer Walkers { Walker walkers[]; };
layout(std430) writeonly buffer PreferredVelocities { vec2 preferred_velocities[]; };
uniform float now, until;  // s: of this decision, and of the next

#include "shaders/shared/images.glsl"
#include "shaders/shared/snap.glsl"
#include "shaders/given/ways.glsl"
#ifdef BELTS
layout(std140) uniform ParametersBlock { Parameters parameters; };
#include "shaders/charts/belts.glsl"
#endif

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= live_count || (walkers[slot].flags & PERSON_IS_GIVEN) == 0u || isImage(walkers[slot].flags)) return;
    uint row = bodies[slot].row;
    vec2 velocity = (givenPlace(row, until) - givenPlace(row, now)) / (until - now);
#ifdef BELTS
    velocity -= groundUnder(walkers[slot].flags);
#endif
    float speed = length(velocity);
    preferred_velocities[slot] = velocity;
    walkers[slot].flags &= ~WALKER_AT_REST;
    walkers[slot].way_through = packSnorm2x16(speed > STANDING_SPEED ? velocity / speed : vec2(0.0));
}
