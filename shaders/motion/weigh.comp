// SPDX-License-Identifier: Apache-2.0
// What the rounds of contact ask of everybody's neighbours, worked out once a step: how hard it is to move who is
// carried off its way, and how impatient who is held up has become.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) readonly buffer Bodies { Body bodies[]; };
layout(std430) readonly buffer Walkers { Walker walkers[]; };
layout(std430) readonly buffer PreferredVelocities { vec2 preferred_velocities[]; };
layout(std430) readonly buffer TouchWords { uint touch_words[]; };
layout(std430) writeonly buffer Weights { vec2 weights[]; };

#include "shaders/motion/climbing.glsl"
#include "shaders/motion/walking_behind.glsl"
#include "shaders/motion/headway.glsl"
#include "shaders/motion/impatience.glsl"
#include "shaders/motion/standing_fast.glsl"
#include "shaders/motion/taking_turns.glsl"
#include "shaders/motion/urgency.glsl"

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= live_count) return;
    // On stairs nobody is pushed on by those behind.
    bool in_turn = (touch_words[slot] & TOUCH_IN_NARROWS) != 0u;
    bool climbs = CLIMBING_ENABLED && in_turn && isOnStairs(walkers[slot].flags);
    weights[slot] = vec2(weightAgainst(preferred_velocities[slot], bodies[slot].velocity),
                         urgencyOf(climbs || takesTurns(walkers[slot], touch_words[slot]),
                                   climbs ? 1.0 : impatienceOf(walkers[slot].nervousness)));
}
