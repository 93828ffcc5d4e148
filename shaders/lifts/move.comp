// SPDX-License-Identifier: Apache-2.0
// Doors and cabins move in every step, as evenly as pictures show them; what each lift does next is decided where
// people decide (shaders/lifts/control.comp).
#include "shaders/shared/simulation_types.h"
#include "shaders/shared/lift_types.h"

layout(local_size_x = LIFT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };

#include "shaders/charts/lifts.glsl"
layout(std430) buffer LiftStates { LiftState lift_states[]; };

/// s that a way takes: it sets out and comes to rest evenly.
float travelTime(LiftPlan plan, float way) {
    float needed = plan.speed * plan.speed / LIFT_ACCELERATION;
    return way < needed ? 2.0 * sqrt(way / LIFT_ACCELERATION)
                        : way / plan.speed + plan.speed / LIFT_ACCELERATION;
}

/// m of a way after so many seconds.
float travelled(LiftPlan plan, float way, float seconds) {
    float whole = travelTime(plan, way), left = max(whole - seconds, 0.0);
    float rise = min(min(seconds, left), min(plan.speed / LIFT_ACCELERATION, 0.5 * whole));
    float at_speed = max(min(seconds, whole - rise) - rise, 0.0);
    float ramp = 0.5 * LIFT_ACCELERATION * rise * rise;
    if (seconds <= 0.5 * whole) return ramp + at_speed * plan.speed;
    return way - ramp - max(left - rise, 0.0) * plan.speed;
}

float doorsAfter(LiftState lift, LiftPlan plan) {
    float share = clamp(lift.since / plan.door_time, 0.0, 1.0);
    return lift.phase == LIFT_OPENS ? share : 1.0 - share;
}

/// It is exactly at its stop once it is there.
float heightAfter(LiftState lift, LiftPlan plan) {
    float to = lift_stops[plan.first_stop + lift.stop].height, way = abs(to - lift.from);
    if (lift.since >= travelTime(plan, way)) return to;
    return lift.from + sign(to - lift.from) * travelled(plan, way, lift.since);
}

void main() {
    for (uint number = gl_LocalInvocationID.x; number < LIFTS; number += LIFT_GROUP_SIZE) {
        LiftState lift = lift_states[number];
        lift.since += parameters.step_seconds;
        lift.idle += parameters.step_seconds;
        if (lift.phase == LIFT_OPENS || lift.phase == LIFT_CLOSES) lift.open = doorsAfter(lift, lift_plans[number]);
        if (lift.phase == LIFT_RIDES) lift.height = heightAfter(lift, lift_plans[number]);
        lift_states[number] = lift;
    }
}
