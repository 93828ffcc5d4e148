// SPDX-License-Identifier: Apache-2.0
// Whatever people are pushed to: only those who have been asked in go through the doors of a lift, and only those who
// get off come out. Who stands in a cabin or waits for one turns to its doors.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) readonly buffer Bodies { Body bodies[]; };
layout(std430) readonly buffer Walkers { Walker walkers[]; };
layout(std430) buffer States { AgentState states[]; };
layout(std430) buffer Targets { TARGET targets[]; };

#include "shaders/charts/lifts.glsl"
layout(std430) readonly buffer LiftStates { LiftState lift_states[]; };
layout(std430) readonly buffer Riders { uint riders[]; };

#include "shaders/shared/charts.glsl"
#include "shaders/shared/images.glsl"
#include "shaders/shared/snap.glsl"
#include "shaders/motion/turn_towards.glsl"

const float HAIR = 0.02;  // m

bool isBeforeDoors(LiftPlan plan, vec2 at, float radius) { return abs(at.y) < plan.half_door + radius; }

/// From the cabin at a stop: nearer to its doors than a body is thick, nobody gets but those who get off.
vec2 keptIn(LiftStop stop, float radius, vec2 from, vec2 to) {
    float least = min(radius + HAIR, throughDoors(stop, from).x), at = throughDoors(stop, to).x;
    return at < least ? to + snapped(stop.along * (least - at)) : to;
}

vec2 keptOut(LiftStop stop, LiftPlan plan, float radius, vec2 from, vec2 to) {
    vec2 before = throughDoors(stop, from), at = throughDoors(stop, to);
    // Floors end about at the doors, as finely as cells are: further in than a body is thick they are behind the cabin.
    if (before.x > radius || !isBeforeDoors(plan, at, radius)) return to;
    float most = max(-radius - HAIR, before.x);
    return at.x > most ? to - snapped(stop.along * (at.x - most)) : to;
}

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= live_count || isImage(walkers[slot].flags)) return;
    Body self = bodies[slot];
    uint chart = chartOf(chartCellAt(self.position));
    if (chart == NO_CHART) return;
    uint rider = riders[self.row], phase = rider & RIDER_PHASE;
    vec2 shift = chart_shifts[chart];
    vec2 from = self.position - shift, target = targets[slot].xy - shift, to = target;
    if (cabin_stops[chart] != NO_INDEX) {
        LiftStop stop = lift_stops[cabin_stops[chart]];
        LiftState lift = lift_states[stop.lift];
        bool here = cabin_stops[chart] == lift_plans[stop.lift].first_stop + lift.stop;
        bool gets_off = phase == RIDER_RIDES && here && doorsAreOpen(lift) &&
                        (goalOf(rider) == lift.stop || stepsBack(lift, stop, from));
        if (!gets_off) to = keptIn(stop, self.radius, from, to);
    } else if (phase != RIDER_BOARDS) {
        for (uint i = 0u; i < LIFT_STOPS; ++i)
            if (lift_stops[i].landing == chart)
                to = keptOut(lift_stops[i], lift_plans[lift_stops[i].lift], self.radius, from, to);
    }
    if (to != target) targets[slot].xy = to + shift;
    if (phase != RIDER_WAITS && phase != RIDER_RIDES) return;
    if ((walkers[slot].flags & WALKER_AT_REST) == 0u) return;
    LiftPlan plan = lift_plans[liftOf(rider)];
    LiftStop doors = lift_stops[plan.first_stop + (phase == RIDER_RIDES ? goalOf(rider) : waitsAt(rider))];
    vec2 look = phase == RIDER_RIDES ? -doors.along : doors.begin - from;
    states[self.row].heading = turnTowards(states[self.row].heading, look);
}
