// SPDX-License-Identifier: Apache-2.0
// What those want who have to do with a lift, in place of what their routes say: to wait beside the way out of its
// doors, to come in when they have been asked, to stand at their spot, and to get off.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) readonly buffer Bodies { Body bodies[]; };
layout(std430) buffer Walkers { Walker walkers[]; };
layout(std430) writeonly buffer PreferredVelocities { vec2 preferred_velocities[]; };

#include "shaders/charts/lifts.glsl"
layout(std430) readonly buffer LiftStates { LiftState lift_states[]; };
layout(std430) readonly buffer LiftQueues { uint lift_queues[]; };
layout(std430) readonly buffer Riders { uint riders[]; };

#include "shaders/shared/charts.glsl"
#include "shaders/shared/images.glsl"
#include "shaders/shared/random.glsl"
#include "shaders/lifts/waiting_spot.glsl"

const float THERE = 0.12;       // m from its spot in a cabin
const float NEAR_SPOT = 0.35;   // m from where it waits
const float STROLL = 0.9;       // m/s, in and before cabins
const float SETTLING = 0.5;     // s
const float OUTSIDE = 1.2;      // m before the doors: who gets off makes for there
const float WITHIN = 0.4;       // m behind them
const float PAST_JAMBS = 0.06;  // m

struct Way {
    vec2 to;      // m, at home
    float there;  // m: near enough to stand
};

/// Through the doors: first to before them, where one fits between them.
vec2 throughTo(LiftStop stop, LiftPlan plan, float radius, vec2 at, float side, float end) {
    float room = roomInDoors(plan, radius), aside = clamp(at.y, -room, room);
    bool fits = abs(at.y) <= room + 0.1;
    return atDoors(stop, vec2(fits ? end : side * (radius + 0.25), aside));
}

Way wayOf(uint rider, uint row, vec2 home, float radius) {
    uint lift = liftOf(rider);
    LiftPlan plan = lift_plans[lift];
    LiftState state = lift_states[lift];
    uint phase = rider & RIDER_PHASE;
    if (phase == RIDER_WAITS) {
        uint stop = plan.first_stop + waitsAt(rider);
        return Way(waitingSpot(lift_stops[stop], plan, row, lift_queues[stop], home, radius), NEAR_SPOT);
    }
    LiftStop stop = lift_stops[plan.first_stop + state.stop];
    vec2 at = throughDoors(stop, home);
    if (phase == RIDER_BOARDS) return Way(throughTo(stop, plan, radius, at, -1.0, WITHIN), 0.0);
    if (goalOf(rider) == state.stop && doorsAreOpen(state))
        return Way(throughTo(stop, plan, radius, at, 1.0, -OUTSIDE), 0.0);
    if (stepsBack(state, stop, home)) return Way(throughTo(stop, plan, radius, at, 1.0, -OUTSIDE), 0.0);
    if (at.x < radius + PAST_JAMBS) {  // beside the doors there are walls
        float room = roomInDoors(plan, radius);
        return Way(atDoors(stop, vec2(radius + WITHIN, clamp(at.y, -room, room))), 0.01);
    }
    // Once doors close, everybody stands where it is.
    bool settles = state.phase != LIFT_IS_OPEN && state.phase != LIFT_OPENS;
    return Way(spotOf(rider) == NO_SPOT ? home : spotPlace(plan, spotOf(rider)), settles ? plan.depth : THERE);
}

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= live_count || isImage(walkers[slot].flags)) return;
    uint row = bodies[slot].row, rider = riders[row];
    if ((rider & RIDER_PHASE) == RIDER_NONE) return;
    vec2 home = bodies[slot].position - chart_shifts[chartOf(chartCellAt(bodies[slot].position))];
    Way way = wayOf(rider, row, home, bodies[slot].radius);
    vec2 offset = way.to - home;
    float left = length(offset);
    bool walks_through = way.there == 0.0;
    if (!walks_through) walkers[slot].flags |= WALKER_HELD;
    bool stands = left <= way.there;
    if (stands) walkers[slot].flags |= WALKER_AT_REST;
    float speed = min(walkers[slot].preferred_speed, STROLL);
    if (!walks_through) speed = min(speed, left / SETTLING);
    preferred_velocities[slot] = stands ? vec2(0.0) : offset * (speed / max(left, 1.0e-6));
}
