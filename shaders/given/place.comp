// SPDX-License-Identifier: Apache-2.0
// Ends a step of those whose ways are given: they come when these begin, and leave when they end.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std430) buffer States { AgentState states[]; };
#ifdef BODIES
layout(std430) buffer Chests { Chest chests[]; };
#endif
uniform uint given_count;
uniform uint steps_done;     // counted with this one
uniform float until;         // s: when the step ends
uniform float step_seconds;  // s

#include "shaders/shared/alive.glsl"
#include "shaders/shared/snap.glsl"
#include "shaders/given/ways.glsl"
#ifdef BELTS
layout(std140) uniform ParametersBlock { Parameters parameters; };
#include "shaders/shared/charts.glsl"
#include "shaders/charts/moving_ground.glsl"
#endif

/// s
vec2 timesOf(uint row) {
    GivenWay way = given_ways[row - first_given];
    return vec2(given_places[way.first_place].time, given_places[way.first_place + way.place_count - 1u].time);
}

void come(uint row, inout AgentState state) {
    state.status = STATUS_WALKING;
    state.spawn_step = steps_done;
#ifdef CHARTS
    state.rest = given_ways[row - first_given].shift;
#endif
#ifdef BODIES
    chests[row].angle = state.heading;
    chests[row].rate = 0.0;
#endif
}

void main() {
    if (gl_GlobalInvocationID.x >= given_count) return;
    uint row = first_given + gl_GlobalInvocationID.x;
    vec2 times = timesOf(row);
    AgentState state = states[row];
    if (until < times.x || state.status == STATUS_GONE && state.arrival_step != steps_done) return;
    vec2 home = givenPlace(row, until);
    bool is_over = until > times.y;
    if (state.spawn_step == NO_INDEX) {
        if (is_over) return;
        come(row, state);
    }
    // Whatever its row was told by those passes that others go by.
    state.status = is_over ? STATUS_GONE : STATUS_WALKING;
    state.arrival_step = is_over ? steps_done : NO_INDEX;
    state.leave_step = 0u;
    state.ticket = NO_INDEX;
    state.nervousness = 0.0;
#ifndef CHARTS
    state.rest = vec2(0.0);
#endif
    state.position = inPlane(home, state.rest);
    state.velocity = (home - givenPlace(row, until - step_seconds)) / step_seconds;
#ifdef BELTS
    state.velocity -= groundVelocity(state.position);
#endif
    states[row] = state;
}
