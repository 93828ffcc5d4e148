// SPDX-License-Identifier: Apache-2.0
// Where people wait for a lift: round its doors, the more of them the further out, and on both sides of the way that
// those take who get off.
// Needs shaders/charts/lifts.glsl, shaders/shared/charts.glsl and random.glsl.

const uint PURPOSE_LIFT = 0x11f7u;
const float ROOM_OF_ONE = 0.5;      // m^2
const float NEAREST = 0.9;          // m from the middle of the doors
const float WAY_OUT = 2.4;          // m before the doors that stay free
const float BESIDE_WAY_OUT = 0.35;  // m from the doors' edge, for bodies' middles
const float FROM_EDGE = 0.4;        // m

/// Whether people can stand at a place before the doors.
bool isFloor(LiftStop stop, vec2 at) {
    ChartCell cell = chartCellAt(atDoors(stop, at) + chart_shifts[stop.landing]);
    return chartOf(cell) == stop.landing && ownerOf(cell) == stop.landing;
}

bool hasRoom(LiftStop stop, vec2 at) {
    return isFloor(stop, at) && isFloor(stop, at - vec2(FROM_EDGE, 0.0)) &&
           isFloor(stop, at + vec2(0.0, at.y > 0.0 ? FROM_EDGE : -FROM_EDGE));
}

/// m, at home. @param waiting how many do
vec2 waitingSpot(LiftStop stop, LiftPlan plan, uint row, uint waiting, vec2 home, float radius) {
    float share = sqrt(randomUnit(parameters.seed, row, PURPOSE_LIFT));
    float angle = (randomUnit(parameters.seed, row, PURPOSE_LIFT + 1u) - 0.5) * 2.8;
    // A sparse queue gathers near the doors; sizes go in steps, so that nobody shifts about as others come and go.
    float crowd = exp2(ceil(log2(float(max(waiting, 2u)))));
    float away = NEAREST + sqrt(0.64 * ROOM_OF_ONE * crowd) * share;
    vec2 at = away * vec2(-cos(angle), sin(angle));
    float beside = plan.half_door + BESIDE_WAY_OUT + max(radius - 0.25, 0.0);
    if (abs(at.y) < beside && -at.x < WAY_OUT)
        at.y = (at.y < 0.0 ? -1.0 : 1.0) * (beside + 0.5 * abs(at.y));
    if (!hasRoom(stop, at)) at.y = -at.y;
    if (!hasRoom(stop, at)) at = vec2(-max(-at.x, WAY_OUT), clamp(at.y, -0.5, 0.5));
    return hasRoom(stop, at) ? atDoors(stop, at) : home;
}
