// SPDX-License-Identifier: Apache-2.0
// To a seat and away from it, between rows that nobody else walks in: up the aisle, along the row, turn, sit down;
// stand up to let somebody pass, sit down again; and the same way back. Who is on it is led, and out of the plane in
// which people avoid each other; it leaves that plane, and comes back to it, where the aisle ends on the ground.
//
// One thread for each who has a seat: it reads what all did before, and writes what it does itself.
#include "shaders/shared/simulation_types.h"
#include "shaders/shared/behaviour_types.h"
#include "shaders/shared/seat_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer People { Person people[]; };
layout(std430) buffer States { AgentState states[]; };
layout(std430) readonly buffer Bodies { Body bodies[]; };
layout(std430) readonly buffer BehaviourStates { BehaviourState behaviour_states[]; };
layout(std430) readonly buffer Minds { Mind minds[]; };
layout(std430) readonly buffer SeatWays { SeatWay seat_ways[]; };
layout(std430) readonly buffer SeatPoints { SeatPoint seat_points[]; };
layout(std430) readonly buffer SeatLanes { SeatLane seat_lanes[]; };
layout(std430) readonly buffer LaneMates { uint lane_mates[]; };
layout(std430) readonly buffer AisleCounts { uint aisle_counts[]; };  // where those begin who share an aisle
layout(std430) readonly buffer Sitters { Sitter sitters[]; };
layout(std430) writeonly buffer SittersNext { Sitter sitters_next[]; };
uniform usamplerBuffer aisle_walkers;  // two texels each: all look at all of them
uniform uint sitter_count;
uniform uint steps_done;  // counted with this one
uniform uint may_cross;   // 1: people decide in this step, and who steps into their plane is seen at once

#ifdef BODIES
layout(std430) writeonly buffer Chests { Chest chests[]; };
#endif

#include "shaders/shared/alive.glsl"
#include "shaders/cells/cells.glsl"
#include "shaders/cells/cell_runs.glsl"
#include "shaders/motion/turn_towards.glsl"
#include "shaders/seats/ways.glsl"
#include "shaders/seats/on_its_way.glsl"
#include "shaders/seats/others.glsl"
#include "shaders/seats/pace.glsl"
#include "shaders/seats/plane.glsl"
#include "shaders/seats/in_seat.glsl"

/// Somebody's seat is wanted as long as its state says so.
bool wantsSeat(Mind mind) { return mind.state != NO_INDEX && behaviour_states[mind.state].does == DOES_SIT; }

void begin(inout Sitter self, uint mode) {
    self.mode = mode;
    self.since = steps_done;
}

float secondsIn(Sitter self) { return float(steps_done - self.since) * parameters.step_seconds; }

void walkOnWay(inout Sitter self, inout AgentState state, SeatWay way, Others seen, float preferred) {
    uint file = fileOf(self);
    vec2 before = state.position;
    // Nobody walks into those who stand where the aisle ends.
    float radius = people[way.row].radius;
    bool near_end = self.mode == SITTER_LEAVES && self.along < BEFORE_END + THERE;
    bool may_go = !near_end || hasRoom(placeOnWay(way, 0.0, file), radius, self);
    if (!may_go) seen.halt = max(seen.halt, min(BEFORE_END, self.along));
    walk(self, way, seen, preferred);
    state.position = placeOnWay(way, self.along, file) + self.off;
    takeSteps(state, before);
    bool inwards = self.mode == SITTER_ENTERS;
    if (inwards && way.length - self.along < THERE) begin(self, SITTER_TURNS);
    if (!inwards && self.along < THERE && may_cross != 0u && may_go)
        stepOut(self, state, minds[way.row].first_stage);
}

void goToSeat(uint index, inout Sitter self, inout AgentState state, SeatWay way, Others seen) {
    Mind mind = minds[way.row];
    vec2 foot = seat_points[way.first_point].place;
    bool comes = wantsSeat(mind) && may_cross != 0u && isBefore(state, mind, foot, self.mode == SITTER_ASKS) &&
                 hasClearWay(way, state.position, people[way.row].radius);
    if (self.mode == SITTER_WALKS && comes) begin(self, SITTER_ASKS);
    if (self.mode != SITTER_ASKS || may_cross == 0u) return;
    if (!comes)
        self.mode = SITTER_WALKS;
    else if (self.since != steps_done && !seen.comes_first && !seen.against &&
             seen.gap > AISLE_GAP &&
             !(seen.comes_out && way.mouth < BEFORE_ROW + 0.1))
        stepIn(self, state, way);
}

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= sitter_count) return;
    Sitter self = sitters[index];
    SeatWay way = seat_ways[index];
    AgentState state = states[way.row];
    Mind mind = minds[way.row];
    bool in_plane = self.mode <= SITTER_ASKS;
    if (in_plane && !isAlive(state.status)) {  // not here yet, or gone
        self.mode = SITTER_WALKS;
        sitters_next[index] = self;
        return;
    }
    Others seen = lookAround(index, self, way);
    if (in_plane)
        goToSeat(index, self, state, way, seen);
    else if (self.mode == SITTER_ENTERS || self.mode == SITTER_LEAVES)
        walkOnWay(self, state, way, seen, people[way.row].preferred_speed);
    else
        stayInSeat(self, state, way, seen, wantsSeat(mind));
    if (self.mode == SITTER_SITS && wantsSeat(mind)) sitAsTold(self, state, behaviour_states[mind.state]);
    sitters_next[index] = self;
    if (in_plane && self.mode <= SITTER_ASKS) return;  // moved by others
    states[way.row] = state;
#ifdef BODIES
    chests[way.row].angle = state.heading;
    chests[way.row].rate = 0.0;
#endif
}
