// SPDX-License-Identifier: Apache-2.0
// What each lift does next. It goes on in one direction as long as somebody wants to go further that way, or waits
// there, and stops for those who get off and for those who wait to go its way; then it turns round. With nobody to
// serve it stays where it is, doors closed. People come in one after another, the nearest first, once the last who
// wants to has got off. In between, doors and cabins move (shaders/lifts/move.comp).
#include "shaders/shared/simulation_types.h"
#include "shaders/shared/lift_types.h"

layout(local_size_x = LIFT_GROUP_SIZE) in;

#include "shaders/charts/lifts.glsl"
layout(std430) buffer LiftStates { LiftState lift_states[]; };
layout(std430) readonly buffer LiftWishesBlock { LiftWishes lift_wishes[]; };
layout(std430) buffer Riders { uint riders[]; };
layout(std430) readonly buffer States { AgentState states[]; };
layout(std430) readonly buffer ChartShifts { vec2 chart_shifts[]; };  // m, by chart

const float NEARNESS = 0.01;      // of spots that are as far from the middle, the nearest
const uint MOST_AT_ONCE = 3u;     // who have been asked in and are not in yet
const float GIVES_UP = 12.0;      // s: doors close on those who do not come in or get off
const float CLOSES_FULL = 1.0;    // s

uint stopsBeyond(uint stop, int way) { return way > 0 ? ~0u << (stop + 1u) : (1u << stop) - 1u; }

/// Where somebody is wanted in one direction. @returns -1: nowhere
int nextStop(uint stop, int way, LiftWishes wishes) {
    uint beyond = stopsBeyond(stop, way);
    uint on_the_way = (wishes.goals | (way > 0 ? wishes.up : wishes.down)) & beyond;
    if (on_the_way != 0u) return way > 0 ? findLSB(on_the_way) : findMSB(on_the_way);
    uint turning = (way > 0 ? wishes.down : wishes.up) & beyond;
    if (turning != 0u) return way > 0 ? findMSB(turning) : findLSB(turning);
    return -1;
}

float heightOf(LiftPlan plan, int stop) { return lift_stops[plan.first_stop + uint(stop)].height; }

/// @returns -1: it stays
int whereTo(LiftState lift, LiftPlan plan, LiftWishes wishes) {
    int up = nextStop(lift.stop, 1, wishes), down = nextStop(lift.stop, -1, wishes);
    if (up < 0 || down < 0) return max(up, down);
    if (lift.heading != 0) return lift.heading > 0 ? up : down;
    return heightOf(plan, up) - lift.height <= lift.height - heightOf(plan, down) ? up : down;
}

void enter(inout LiftState lift, uint phase) {
    lift.phase = phase;
    lift.since = 0.0;
    lift.idle = 0.0;
    lift.given_up = 0u;
}

void openDoors(inout LiftState lift, LiftPlan plan) {
    enter(lift, LIFT_OPENS);
    lift.since = lift.open * plan.door_time;
}

void setOut(inout LiftState lift, LiftPlan plan, LiftWishes wishes) {
    bool wanted = ((wishes.goals | wishes.up | wishes.down) >> lift.stop & 1u) != 0u;
    bool gets_off = (wishes.goals >> lift.stop & 1u) != 0u;
    if (gets_off || (wanted && wishes.aboard == 0u)) {
        openDoors(lift, plan);
        return;
    }
    int to = whereTo(lift, plan, wishes);
    if (to < 0) {
        lift.heading = 0;
        return;
    }
    lift.heading = to > int(lift.stop) ? 1 : -1;
    lift.from = lift.height;
    lift.stop = uint(to);
    enter(lift, LIFT_RIDES);
}

/// Of the free spots in the row that is furthest from the doors, the one nearest to a place in the cabin. Where several
/// come in at once, nobody has to get past anybody. In the row at the doors, the middle is taken last: the last ones
/// have to get by who stands there already.
uint freeSpot(LiftState lift, LiftPlan plan, uint taken, vec2 home) {
    LiftStop stop = lift_stops[plan.first_stop + lift.stop];
    bool backwards = dot(stop.along, lift_stops[plan.first_stop].along) < 0.0;
    uint row_at_doors = backwards ? 0u : (plan.capacity - 1u) / plan.columns;
    uint best = NO_SPOT, best_row = NO_SPOT;
    float least = 1.0e30;
    for (uint i = 0u; i < plan.capacity; ++i) {
        uint spot = backwards ? plan.capacity - 1u - i : i, at_row = spot / plan.columns;
        if ((taken >> spot & 1u) != 0u) continue;
        if (best != NO_SPOT && at_row != best_row) break;
        vec2 place = spotPlace(plan, spot);
        float away = distance(home, place);
        if (at_row == row_at_doors) away = NEARNESS * away - abs(throughDoors(stop, place).y);
        if (away >= least) continue;
        least = away;
        best = spot;
        best_row = at_row;
    }
    return best;
}

/// @returns whether somebody has been asked in
bool askIn(inout LiftState lift, LiftPlan plan, LiftWishes wishes) {
    if (wishes.first == 0u || wishes.leaving > 0u || wishes.boarding >= MOST_AT_ONCE) return false;
    if (wishes.aboard + wishes.boarding >= plan.capacity) return false;
    uint row = ~wishes.first & 0xffffffu;
    uint rider = riders[row];
    riders[row] = riderFor(RIDER_BOARDS, liftOf(rider), waitsAt(rider), goalOf(rider), NO_SPOT);
    if (lift.heading == 0) lift.heading = goalOf(rider) > lift.stop ? 1 : -1;
    return true;
}

/// Who comes in goes to the free spot that is furthest from the doors.
void giveSpot(LiftState lift, LiftPlan plan, LiftWishes wishes) {
    if (wishes.entering == 0u) return;
    uint row = ~wishes.entering, rider = riders[row];
    vec2 home = states[row].position - chart_shifts[lift_stops[plan.first_stop + lift.stop].chart];
    uint spot = freeSpot(lift, plan, wishes.spots, home);
    if (spot == NO_SPOT) return;
    riders[row] = riderFor(RIDER_RIDES, liftOf(rider), waitsAt(rider), goalOf(rider), spot);
}

void serve(inout LiftState lift, LiftPlan plan, LiftWishes wishes) {
    giveSpot(lift, plan, wishes);
    bool full = wishes.aboard + wishes.boarding >= plan.capacity;
    if ((!hasGivenUp(lift) && askIn(lift, plan, wishes)) || wishes.aboard != lift.aboard) lift.idle = 0.0;
    lift.aboard = wishes.aboard;
    if (wishes.in_doors > 0u && lift.idle >= GIVES_UP) lift.given_up = 1u;
    bool is_waited_for = wishes.leaving > 0u || wishes.boarding > 0u || wishes.in_doors > 0u;
    float patience = is_waited_for ? GIVES_UP : full ? min(CLOSES_FULL, plan.dwell) : plan.dwell;
    bool closes = lift.idle >= patience || hasGivenUp(lift);
    if (closes && wishes.in_doors == 0u) enter(lift, LIFT_CLOSES);
}

void stepDoors(inout LiftState lift, LiftPlan plan, LiftWishes wishes) {
    if (lift.phase == LIFT_CLOSES && wishes.in_doors > 0u) {
        openDoors(lift, plan);
        return;
    }
    if (lift.open != (lift.phase == LIFT_OPENS ? 1.0 : 0.0)) return;
    if (lift.phase == LIFT_OPENS && nextStop(lift.stop, lift.heading == 0 ? 1 : lift.heading, wishes) < 0)
        lift.heading = 0;  // nobody wants to go further that way: whoever comes in first may choose
    enter(lift, lift.phase == LIFT_OPENS ? LIFT_IS_OPEN : LIFT_WAITS);
}

void ride(inout LiftState lift, LiftPlan plan) {
    if (lift.height == heightOf(plan, int(lift.stop))) openDoors(lift, plan);
}

void main() {
    for (uint number = gl_LocalInvocationID.x; number < LIFTS; number += LIFT_GROUP_SIZE) {
        LiftState lift = lift_states[number];
        LiftPlan plan = lift_plans[number];
        LiftWishes wishes = lift_wishes[number];
        if (lift.phase == LIFT_WAITS)
            setOut(lift, plan, wishes);
        else if (lift.phase == LIFT_IS_OPEN)
            serve(lift, plan, wishes);
        else if (lift.phase == LIFT_RIDES)
            ride(lift, plan);
        else
            stepDoors(lift, plan, wishes);
        lift_states[number] = lift;
    }
}
