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
layout(std430) readonly buffer Paces { float paces[]; };
layout(std430) readonly buffer Targets { vec2 targets[]; };
layout(std430) readonly buffer Stages { Stage stages[]; };
uniform usamplerBuffer field_cells;  // FieldCell
layout(std430) readonly buffer DetourSlopes { vec2 detour_slopes[]; };
layout(std430) readonly buffer PlanChanges { PlanChange plan_changes[]; };
layout(std430) buffer WaitingLines { WaitingLine waiting_lines[]; };
layout(std430) readonly buffer LinePoints { vec2 line_points[]; };
layout(std430) buffer States { AgentState states[]; };
uniform uint steps_done;  // counted with this one

#include "shaders/routes/route.glsl"
#include "shaders/motion/waiting_line.glsl"
#include "shaders/motion/feet.glsl"

const float PI = 3.14159265358979;
const float TURN_TIME = 0.22;          // s: the heading closes in on the velocity's direction with this time constant
const float TURN_LIMIT = 2.6;          // rad/s, about 150 degrees per second

const float SIGHT = 0.15;              // m: nothing nearer is looked at
const float STEPPING_ASIDE = 0.4;      // m/s: who stands somewhere does not look away for less
const float JOINING = 0.8;             // m: this near its end, one joins a line
const float GIVE_UP = 0.6;             // nervousness: where there are too many, one stops where one is
const float NEAR_BY = 5.0;             // m: even before the place itself

const float PATIENCE_TIME = 2.0;       // s: nervousness follows what happens with this time constant

/// 1 where somebody does not get on at all, 0 where it walks as it wishes or wants to stand
/// (Helbing, Farkas and Vicsek 2000).
/// Walking behind others at their pace is not being held up.
float heldUp(vec2 wish, float pace, vec2 velocity) {
    float speed = length(wish);
    return speed > STANDING_SPEED ? clamp(1.0 - dot(velocity, wish) / (speed * pace), 0.0, 1.0) : 0.0;
}

float wrapAngle(float angle) { return angle - 2.0 * PI * floor((angle + PI) / (2.0 * PI)); }

float turnTowards(float heading, vec2 direction) {
    float turn = wrapAngle(atan(direction.y, direction.x) - heading);
    float most = TURN_LIMIT * parameters.step_seconds;
    return wrapAngle(heading + clamp(turn * (1.0 - exp(-parameters.step_seconds / TURN_TIME)), -most, most));
}

/// What somebody in a line looks at: the place before its own, and in front what the stop is about.
vec2 nextInLine(AgentState state, Stage stage) {
    WaitingLine line = waiting_lines[stage.line];
    if (state.ticket == NO_INDEX || state.ticket == line.served) return stage.facing;
    return placeInLine(line, state.ticket - line.served - 1u);
}

/// Who walks looks where it goes; who has stopped, at what there is to see.
float turned(AgentState state, Stage stage, Walker walker, vec2 wish, float speed) {
    bool stops = !isUnderWay(walker);
    if (speed >= (stops ? STEPPING_ASIDE : STANDING_SPEED)) return turnTowards(state.heading, state.velocity);
    if (!stops && length(wish) > STANDING_SPEED) return turnTowards(state.heading, wish);
    vec2 sight = (stage.line != NO_INDEX ? nextInLine(state, stage) : stage.facing) - state.position;
    return stops && length(sight) > SIGHT ? turnTowards(state.heading, sight) : state.heading;
}

/// Whether somebody is where its stage leads.
bool isThere(AgentState state, Stage stage) {
    RouteAhead ahead = routeAhead(stage, state.position);
    if (stage.line != NO_INDEX && (state.ticket == NO_INDEX || state.ticket != waiting_lines[stage.line].served)) return false;
    if (ahead.remaining <= stage.tolerance) return true;
    bool in_area = (stage.flags & STAGE_IN_AREA) != 0u && ahead.straight;
    return (stage.flags & STAGE_ANYWHERE) != 0u && (in_area || ahead.remaining < NEAR_BY) && state.nervousness > GIVE_UP;
}

/// Who comes to the end of a line joins it at the end of the step; of several, the smallest row.
void askToJoin(AgentState state, Stage stage, uint row) {
    if (stage.line == NO_INDEX || state.ticket != NO_INDEX || state.leave_step != 0u) return;
    if (distance(stage.point, state.position) < JOINING) atomicMin(waiting_lines[stage.line].candidate, row);
}

void goOn(inout AgentState state) {
    state.stage += 1u;
    state.leave_step = 0u;
    state.ticket = NO_INDEX;
    if (state.stage < state.stage_end) return;
    state.stage = state.stage_end - 1u;
    state.status = STATUS_GONE;
    state.arrival_step = steps_done;
}

/// Stops, waits, goes on, arrives.
void followRoute(inout AgentState state, Stage stage, uint row) {
    if (state.status != STATUS_WALKING) return;
    askToJoin(state, stage, row);
    if (state.leave_step != 0u) {
        if (steps_done >= state.leave_step) goOn(state);
        return;
    }
    if (!isThere(state, stage)) return;
    if (stage.dwell <= 0.0) {
        goOn(state);
    } else if (stage.dwell >= DWELL_FOR_GOOD) {
        state.status = STATUS_ARRIVED;
        state.arrival_step = steps_done;
    } else {
        state.leave_step = steps_done + max(uint(stage.dwell / parameters.step_seconds), 1u);
    }
}

/// @returns whether plans have changed
bool changePlans(inout AgentState state, uint change_count, uint row) {
    if (state.changes >= change_count) return false;
    PlanChange change = plan_changes[people[row].first_change + state.changes];
    if (change.start_step > steps_done) return false;
    state.changes += 1u;
    state.stage = change.first_stage;
    state.stage_end = change.first_stage + change.stage_count;
    state.status = STATUS_WALKING;
    state.arrival_step = NO_INDEX;
    state.leave_step = 0u;
    state.ticket = NO_INDEX;
    return true;
}

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= live_count) return;
    Body self = bodies[slot];
    AgentState state = states[self.row];
    Stage stage = stageOf(state.stage, state.ticket);

    vec2 moved = targets[slot] - self.position;
    float distance_moved = length(moved);
    state.position = targets[slot];
    state.velocity = moved / parameters.step_seconds;
    float speed = length(state.velocity);
    // A push may be faster than legs are; the next step does not build on it.
    if (speed > self.maximum_speed) state.velocity *= self.maximum_speed / speed;
    state.nervousness += (heldUp(preferred_velocities[slot], paces[slot], state.velocity) - state.nervousness) *
                         min(parameters.step_seconds / PATIENCE_TIME, 1.0);
    state.heading = turned(state, stage, walkers[slot], preferred_velocities[slot], speed);
    state.walked += distance_moved;
    if (state.shortest_way <= 0.0) state.shortest_way = routeAhead(stage, self.position).remaining + stage.beyond;
    if (changePlans(state, walkers[slot].change_count, self.row)) {
        stage = stageOf(state.stage, state.ticket);
        state.shortest_way = state.walked + routeAhead(stage, state.position).remaining + stage.beyond;
    } else {
        followRoute(state, stage, self.row);
    }
    states[self.row] = state;
}
