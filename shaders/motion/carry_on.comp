// SPDX-License-Identifier: Apache-2.0
// A step between two decisions: legs go on changing their velocity as was decided, and what contact and walls have done
// to it stays, but for what feet take of a push. Nobody looks round, and everybody keeps the slot of the last decision.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) readonly buffer States { AgentState states[]; };
layout(std430) readonly buffer Decisions { Decision decisions[]; };
layout(std430) buffer Bodies { Body bodies[]; };
layout(std430) buffer Walkers { Walker walkers[]; };
layout(std430) writeonly buffer Targets { TARGET targets[]; };
layout(std430) writeonly buffer TargetsAfter { TARGET targets_after[]; };
layout(std430) writeonly buffer Ways { vec2 ways[]; };

#include "shaders/shared/alive.glsl"
#include "shaders/shared/at_most.glsl"
#include "shaders/shared/images.glsl"
#include "shaders/shared/snap.glsl"
#include "shaders/motion/drive.glsl"
#include "shaders/motion/under_way.glsl"
#include "shaders/motion/planted_feet.glsl"
#include "shaders/motion/at_rest.glsl"
#include "shaders/motion/wide_site.glsl"
#include "shaders/shared/body_shape.glsl"
#ifdef BODIES
layout(std430) readonly buffer Chests { Chest chests[]; };
#include "shaders/motion/shoulders.glsl"
#define TWIST decisions[slot].twist
#else
#define TWIST 0.0
#endif
#ifdef BELTS
#include "shaders/charts/belts.glsl"
#endif
#include "shaders/motion/stride.glsl"

/// What the last step has changed.
void takeOver(uint slot, AgentState state) {
    bodies[slot].position = state.position;
    bodies[slot].velocity = state.velocity;
    bodies[slot].heading = state.heading;
    walkers[slot].status = state.status;
    walkers[slot].stage = state.stage;
    walkers[slot].stage_end = state.stage_end;
    walkers[slot].leave_step = state.leave_step;
#ifdef WAITING_LINES
    walkers[slot].ticket = state.ticket;
#endif
    walkers[slot].nervousness = state.nervousness;
#ifdef BODIES
    Chest chest = chests[bodies[slot].row];
    vec2 axis = axisAt(chest.angle, chest.half_axis);
    walkers[slot].chest = chest.angle;
    walkers[slot].chest_rate = chest.rate;
    walkers[slot].axis_x = axis.x;
    walkers[slot].axis_y = axis.y;
#endif
}

vec2 asDecided(Body self, Walker walker, Decision decision) {
    vec2 wanted = self.velocity + decision.change;
    vec2 legs = self.velocity;
    plantFeet(self, walker, decision.feet, wanted, legs);
    keepFeetStill(decision.feet, wanted, legs);
    vec2 velocity = limitChange(legs, wanted, parameters.maximum_acceleration * parameters.step_seconds);
    return atMost(velocity, self.maximum_speed);
}

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= live_count || isImage(walkers[slot].flags)) return;
    AgentState state = states[bodies[slot].row];
    takeOver(slot, state);
    // Who has left stays where it was last, for a step.
    vec2 velocity = isAlive(state.status) ? asDecided(bodies[slot], walkers[slot], decisions[slot]) : vec2(0.0);
    stride(slot, state.position, velocity, state.rest, TWIST);
}
