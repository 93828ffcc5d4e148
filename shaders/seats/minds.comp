// SPDX-License-Identifier: Apache-2.0
// Who does what next of those between the rows, as shaders/behaviour/transitions.comp has it for all others: these are
// in nobody's way, and so in no cell.
#include "shaders/shared/simulation_types.h"
#include "shaders/shared/behaviour_types.h"
#include "shaders/shared/seat_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer People { Person people[]; };
layout(std430) readonly buffer States { AgentState states[]; };
layout(std430) readonly buffer Bodies { Body bodies[]; };
layout(std430) readonly buffer BehaviourStates { BehaviourState behaviour_states[]; };
layout(std430) readonly buffer BehaviourRules { BehaviourRule behaviour_rules[]; };
layout(std430) readonly buffer BehaviourPoints { vec2 behaviour_points[]; };
layout(std430) readonly buffer Censuses { Census censuses[]; };
layout(std430) readonly buffer Tallies { Tally tallies[]; };
layout(std430) buffer Minds { Mind minds[]; };
layout(std430) readonly buffer SeatWays { SeatWay seat_ways[]; };
layout(std430) readonly buffer Sitters { Sitter sitters[]; };
uniform uint sitter_count;
uniform float now;        // s
uniform uint steps_done;  // counted with this one

#include "shaders/shared/random.glsl"
#include "shaders/cells/cells.glsl"
#include "shaders/cells/cell_starts.glsl"
#include "shaders/behaviour/draws.glsl"
#include "shaders/behaviour/outlines.glsl"
#include "shaders/behaviour/conditions.glsl"
#include "shaders/behaviour/next_state.glsl"

/// Whether somebody has sat for as long as it was to.
bool hasSat(Sitter sitter, Mind mind, BehaviourState doing, uint leader) {
    if (doing.does != DOES_SIT || sitter.seated == NO_INDEX) return false;
    float seconds = float(steps_done - max(sitter.seated, mind.since)) * parameters.step_seconds;
    return seconds >= drawnNumber(doing.lasts, PURPOSE_STAY, leader, mind.entered * 64u);
}

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= sitter_count) return;
    Sitter sitter = sitters[index];
    if (sitter.mode <= SITTER_ASKS) return;
    uint row = seat_ways[index].row;
    uint leader = people[row].party_first;
    Mind mind = minds[row];
    BehaviourState doing = behaviour_states[mind.state];
    bool sits = doing.does == DOES_SIT && sitter.seated != NO_INDEX;
    Asking who = Asking(row, leader, states[row].position, mind, sits, false);
    uint next = mind.entered == 0u ? mind.state : nextState(doing, who, hasSat(sitter, mind, doing, leader));
    if (next == NO_INDEX) return;
    enterState(mind, next, leader);
    minds[row] = mind;
}
