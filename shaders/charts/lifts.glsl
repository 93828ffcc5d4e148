// SPDX-License-Identifier: Apache-2.0
// Lifts: where their cabins are, and what each person has to do with one. Only with LIFTS.
//
// A lift has a chart for each of its stops: the cabin, as it stands there. Who is in it when it sets out goes on on the
// chart of the stop to which it goes (shaders/charts/cross_seams.comp); how high it is on the way only the recording
// knows. People keep out of cabins that are not there (shaders/lifts/keep_out.comp).
#include "shaders/shared/lift_types.h"

layout(std430) readonly buffer LiftPlans { LiftPlan lift_plans[]; };
layout(std430) readonly buffer LiftStops { LiftStop lift_stops[]; };  // lift after lift
layout(std430) readonly buffer CabinStops { uint cabin_stops[]; };    // by chart: which of them, or NO_INDEX

uint liftOf(uint rider) { return rider & 0xffu; }
uint waitsAt(uint rider) { return rider >> 8u & 0xfu; }
uint goalOf(uint rider) { return rider >> 12u & 0xfu; }
uint spotOf(uint rider) { return rider >> 16u & 0x3fu; }
uint riderFor(uint phase, uint lift, uint waits_at, uint goal, uint spot) {
    return phase | lift | waits_at << 8u | goal << 12u | spot << 16u;
}

/// Where somebody is before the doors of a stop (negative) or in its cabin, and how far to the left. m
vec2 throughDoors(LiftStop stop, vec2 home) {
    vec2 offset = home - stop.begin;
    return vec2(dot(offset, stop.along), stop.along.x * offset.y - stop.along.y * offset.x);
}

/// The place of these, at home.
vec2 atDoors(LiftStop stop, vec2 along_and_aside) {
    return stop.begin + stop.along * along_and_aside.x + vec2(-stop.along.y, stop.along.x) * along_and_aside.y;
}

/// m, at home: a spot in a cabin.
vec2 spotPlace(LiftPlan plan, uint spot) {
    return plan.corner + plan.across * float(spot % plan.columns) + plan.forward * float(spot / plan.columns);
}

/// m to either side of the middle of the doors: as far as somebody fits through.
float roomInDoors(LiftPlan plan, float radius) { return max(plan.half_door - radius - 0.05, 0.0); }

/// People walk through doors that are open so far.
bool doorsAreOpen(LiftState lift) { return lift.phase == LIFT_IS_OPEN; }

const float LIFT_BETWEEN_DOORS = 0.25;  // m before and behind them: doors do not close on anybody

/// Whoever is not past the doors yet has to wait for the next ride.
bool hasGivenUp(LiftState lift) { return doorsAreOpen(lift) && lift.given_up != 0u; }

/// Somebody who rides has not got past the doors by then, and gets out again.
bool stepsBack(LiftState lift, LiftStop stop, vec2 home) {
    return hasGivenUp(lift) && throughDoors(stop, home).x < LIFT_BETWEEN_DOORS;
}
