// SPDX-License-Identifier: Apache-2.0
// Who waits for which lift, who has been asked in, who rides and where to; and, counted, what that means to each lift.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer States { AgentState states[]; };
layout(std430) readonly buffer Stages { Stage stages[]; };
uniform usamplerBuffer field_cells;  // FieldCell
layout(std430) readonly buffer DetourSlopes { vec2 detour_slopes[]; };
layout(std430) readonly buffer WaitingLines { WaitingLine waiting_lines[]; };
layout(std430) readonly buffer LinePoints { vec2 line_points[]; };

#include "shaders/charts/lifts.glsl"
layout(std430) readonly buffer LiftStates { LiftState lift_states[]; };
layout(std430) buffer LiftWishesBlock { LiftWishes lift_wishes[]; };
layout(std430) buffer LiftQueues { uint lift_queues[]; };  // by stop of all lifts: how many wait
layout(std430) buffer Riders { uint riders[]; };           // by row: RIDER_*

#include "shaders/shared/alive.glsl"
#include "shaders/shared/charts.glsl"
#include "shaders/routes/route.glsl"
#include "shaders/motion/waiting_line.glsl"

const float SEES = 7.0;      // m: from so far off people make for the doors
const float STRAIGHT = 1.2;  // the way to them is hardly longer than the straight line
const float STRIDE = 0.5;    // m along the way
const float AT_DOORS = 0.8;  // m
const float BEFORE = 0.5;    // m: where the way at the doors is asked for

/// The way at the doors of a stop, from the floor before them.
RouteAhead wayAtDoors(LiftStop stop, Stage stage) {
    return freeRouteAhead(stage, atDoors(stop, vec2(-BEFORE, 0.0)) + chart_shifts[stop.landing]);
}

/// Where somebody gets off who gets in at a stop, by its number in the lift: of those at which its way leads away from
/// the doors, the one from which it is the shortest. @returns NO_INDEX: it has no business with the lift
uint stopToGetOff(LiftPlan plan, uint from, Stage stage) {
    uint best = NO_INDEX;
    float least = 1.0e30;
    for (uint i = 0u; i < plan.stop_count; ++i) {
        if (i == from) continue;
        LiftStop stop = lift_stops[plan.first_stop + i];
        RouteAhead ahead = wayAtDoors(stop, stage);
        float ride = abs(stop.height - lift_stops[plan.first_stop + from].height) / plan.speed;
        float way = ahead.remaining + ride;
        if (dot(ahead.direction, stop.along) > 0.0 || way >= least) continue;
        least = way;
        best = i;
    }
    return best;
}

/// Whether one's way leads through the doors soon. @param waits whether it has made up its mind
bool leadsToDoors(LiftStop stop, Stage stage, vec2 position, bool waits) {
    if (stage.field == NO_INDEX || dot(wayAtDoors(stop, stage).direction, stop.along) < 0.5) return false;
    vec2 doors = stop.begin + chart_shifts[stop.landing];
    float most = STRAIGHT * distance(position, doors) + AT_DOORS;  // otherwise something is between
    for (float walked = 0.0; walked < most; walked += STRIDE) {
        if (distance(position, doors) < AT_DOORS) return true;
        RouteAhead ahead = freeRouteAhead(stage, position);
        if (!waits) ahead = heedingJams(stage, position, ahead);
        if (ahead.remaining < STRIDE) return false;
        position += ahead.direction * STRIDE;
    }
    return false;
}

/// In a cabin.
uint ridesOn(uint rider, uint stop_index, Stage stage) {
    LiftStop stop = lift_stops[stop_index];
    LiftPlan plan = lift_plans[stop.lift];
    uint here = stop_index - plan.first_stop;
    bool knows = rider != RIDER_NONE && liftOf(rider) == stop.lift;
    uint goal = knows ? goalOf(rider) : stopToGetOff(plan, here, stage);
    if (goal == NO_INDEX) goal = here;
    if ((rider & RIDER_PHASE) == RIDER_BOARDS) knows = false;  // it finds its spot now
    return riderFor(RIDER_RIDES, stop.lift, here, goal, knows ? spotOf(rider) : NO_SPOT);
}

/// Whether somebody on a floor has been asked in. Who has been pushed out of the cabin again comes back: its place is
/// kept, as more would get in than may otherwise.
bool comesIn(uint rider) {
    uint phase = rider & RIDER_PHASE;
    if (phase != RIDER_BOARDS && phase != RIDER_RIDES) return false;
    LiftState lift = lift_states[liftOf(rider)];
    return doorsAreOpen(lift) && !hasGivenUp(lift) && (phase == RIDER_BOARDS || goalOf(rider) != lift.stop);
}

/// On a floor: what it has to do with the lifts there.
uint waitsOn(uint rider, uint chart, vec2 position, Stage stage) {
    vec2 home = position - chart_shifts[chart];
    if (comesIn(rider)) return riderFor(RIDER_BOARDS, liftOf(rider), waitsAt(rider), goalOf(rider), NO_SPOT);
    for (uint i = 0u; i < LIFT_STOPS; ++i) {
        LiftStop stop = lift_stops[i];
        // Floors may reach a little way in: who steps back goes on from there.
        bool has_to_do = (rider & RIDER_PHASE) != RIDER_NONE && liftOf(rider) == stop.lift;
        float most = has_to_do ? LIFT_BETWEEN_DOORS : 0.0;
        if (stop.landing != chart || distance(home, stop.begin) > SEES || throughDoors(stop, home).x > most) continue;
        LiftPlan plan = lift_plans[stop.lift];
        uint here = i - plan.first_stop;
        bool waits = has_to_do && (rider & RIDER_PHASE) != RIDER_RIDES && waitsAt(rider) == here;
        if (!leadsToDoors(stop, stage, position, waits)) continue;
        uint goal = waits ? goalOf(rider) : stopToGetOff(plan, here, stage);
        if (goal != NO_INDEX) return riderFor(RIDER_WAITS, stop.lift, here, goal, NO_SPOT);
    }
    return RIDER_NONE;
}

void countWaiting(uint rider, uint row, vec2 home) {
    uint lift = liftOf(rider), here = waitsAt(rider), goal = goalOf(rider);
    LiftPlan plan = lift_plans[lift];
    LiftState state = lift_states[lift];
    atomicAdd(lift_queues[plan.first_stop + here], 1u);
    if (goal > here)
        atomicOr(lift_wishes[lift].up, 1u << here);
    else
        atomicOr(lift_wishes[lift].down, 1u << here);
    bool goes_there = state.heading == 0 || (state.heading > 0) == (goal > here);
    if (state.phase != LIFT_IS_OPEN || state.stop != here || !goes_there) return;
    // The nearest comes first, of several the smallest row: the largest of these words.
    uint away = min(uint(distance(home, lift_stops[plan.first_stop + here].begin) * 25.0), 254u);
    atomicMax(lift_wishes[lift].first, ~(away << 24u | (row & 0xffffffu)));
}

void countInCabin(uint rider, uint row) {
    uint lift = liftOf(rider);
    if (spotOf(rider) == NO_SPOT) atomicMax(lift_wishes[lift].entering, ~row);
    atomicAdd(lift_wishes[lift].aboard, 1u);
    atomicOr(lift_wishes[lift].goals, 1u << goalOf(rider));
    if (spotOf(rider) != NO_SPOT) atomicOr(lift_wishes[lift].spots, 1u << spotOf(rider));
    if (goalOf(rider) == lift_states[lift].stop) atomicAdd(lift_wishes[lift].leaving, 1u);
}

/// Doors do not close on anybody.
void countBetweenDoors(uint chart, vec2 home) {
    for (uint lift = 0u; lift < LIFTS; ++lift) {
        LiftPlan plan = lift_plans[lift];
        LiftStop stop = lift_stops[plan.first_stop + lift_states[lift].stop];
        if (chart != stop.chart && chart != stop.landing) continue;
        vec2 at = throughDoors(stop, home);
        if (abs(at.x) < LIFT_BETWEEN_DOORS && abs(at.y) < plan.half_door) atomicAdd(lift_wishes[lift].in_doors, 1u);
    }
}

void main() {
    uint row = gl_GlobalInvocationID.x;
    if (row >= parameters.row_count) return;
    AgentState state = states[row];
    uint chart = isAlive(state.status) ? chartOf(chartCellAt(state.position)) : NO_CHART;
    if (chart == NO_CHART) {
        riders[row] = RIDER_NONE;
        return;
    }
    Stage stage = stageOf(state.stage, state.ticket, state.position);
    vec2 home = state.position - chart_shifts[chart];
    uint stop = cabin_stops[chart];
    uint rider = stop != NO_INDEX ? ridesOn(riders[row], stop, stage)
                                  : waitsOn(riders[row], chart, state.position, stage);
    riders[row] = rider;
    countBetweenDoors(chart, home);
    if ((rider & RIDER_PHASE) == RIDER_RIDES) countInCabin(rider, row);
    if ((rider & RIDER_PHASE) == RIDER_BOARDS) atomicAdd(lift_wishes[liftOf(rider)].boarding, 1u);
    if ((rider & RIDER_PHASE) == RIDER_WAITS) countWaiting(rider, row, home);
}
