// SPDX-License-Identifier: Apache-2.0
// Ends a step: positions become real, the heading follows, routes advance, people arrive.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) readonly buffer People { Person people[]; };
layout(std430) readonly buffer Bodies { Body bodies[]; };
layout(std430) readonly buffer Walkers { Walker walkers[]; };
layout(std430) readonly buffer PreferredVelocities { vec2 preferred_velocities[]; };
layout(std430) readonly buffer TouchWords { uint touch_words[]; };
layout(std430) readonly buffer Decisions { Decision decisions[]; };
layout(std430) readonly buffer Ways { vec2 ways[]; };
layout(std430) readonly buffer Targets { TARGET targets[]; };
layout(std430) readonly buffer Stages { Stage stages[]; };
uniform usamplerBuffer field_cells;  // FieldCell
layout(std430) readonly buffer DetourSlopes { vec2 detour_slopes[]; };
layout(std430) readonly buffer PlanChanges { PlanChange plan_changes[]; };
layout(std430) buffer WaitingLines { WaitingLine waiting_lines[]; };
layout(std430) readonly buffer LinePoints { vec2 line_points[]; };
layout(std430) buffer States { AgentState states[]; };
uniform uint steps_done;  // counted with this one

#include "shaders/shared/alive.glsl"
#include "shaders/shared/images.glsl"
#include "shaders/routes/route.glsl"
#include "shaders/motion/waiting_line.glsl"
#include "shaders/motion/under_way.glsl"
#include "shaders/motion/impatience.glsl"
#include "shaders/motion/walking_behind.glsl"
#include "shaders/motion/headway.glsl"
#include "shaders/motion/taking_turns.glsl"
#include "shaders/motion/facing_ahead.glsl"
#include "shaders/motion/turning.glsl"
#include "shaders/motion/plans.glsl"
#include "shaders/motion/wide_site.glsl"
#ifdef BELTS
#include "shaders/shared/snap.glsl"
#include "shaders/charts/belts.glsl"
#endif
#ifdef BODIES
layout(std430) writeonly buffer Chests { Chest chests[]; };
#include "shaders/shared/body_shape.glsl"

/// The chest is as contact has left it.
void turnChest(uint row, Walker walker, vec2 axis) {
    vec2 start = vec2(walker.axis_x, walker.axis_y);
    float turn = walker.half_axis != 0.0 ? atan(crossOf(start, axis), dot(start, axis)) : 0.0;
    chests[row].angle = wrapAngle(walker.chest + turn);
    chests[row].rate = turn / parameters.step_seconds;
}
#endif

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= live_count || isImage(walkers[slot].flags)) return;
    Body self = bodies[slot];
    AgentState state = states[self.row];
    if (!isAlive(state.status)) return;  // it left after the last decision
    Stage stage = stageOf(state.stage, state.ticket, self.position);

    vec2 target = targets[slot].xy;
    vec2 moved = target - self.position;
    state.position = target;
#ifdef WIDE_SITE
    moved = goFinely(state, self.position, ways[slot], target);
#endif
#ifdef BELTS
    moved -= carriedInStep(walkers[slot].flags);
#endif
#ifdef BODIES
    turnChest(self.row, walkers[slot], targets[slot].zw);
#endif
    float distance_moved = length(moved);
    state.velocity = moved / parameters.step_seconds;
    float speed = length(state.velocity);
    // A push may be faster than legs are; the next step does not build on it.
    if (speed > self.maximum_speed) state.velocity *= self.maximum_speed / speed;
    float held_up = heldUp(preferred_velocities[slot], decisions[slot].pace, state.velocity);
    state.nervousness = grownNervous(state.nervousness, held_up, parameters.step_seconds);
    bool takes_turns = takesTurns(walkers[slot], touch_words[slot]);
#ifdef BELTS
    vec2 ground = groundUnder(walkers[slot].flags);
    bool rides = ground != vec2(0.0);  // facing ahead
    if (rides) state.heading = turnTowards(state.heading, ground);
    if (!rides)
#endif
        state.heading = turned(state, stage, walkers[slot], preferred_velocities[slot], takes_turns, speed);
#ifdef WIDE_SITE
    addFinely(state.walked, state.walked_rest, distance_moved);
#else
    state.walked += distance_moved;
#endif
    bool has_new_plans = changePlans(state, walkers[slot], self.row);
    if (has_new_plans) stage = stageOf(state.stage, state.ticket, state.position);
    RouteAhead ahead = freeRouteAhead(stage, state.position);
    if (has_new_plans || state.shortest_way <= 0.0)
        state.shortest_way = state.walked + ahead.remaining + stage.beyond;
    if (!has_new_plans) followRoute(state, stage, ahead, self.row);
    states[self.row] = state;
}
