// SPDX-License-Identifier: Apache-2.0
// Who does what next: the first rule of one's state that holds, or what comes when the state is done. One at most in
// each decision. What it takes to do it is told afterwards (goals.comp).
#include "shaders/shared/simulation_types.h"
#include "shaders/shared/behaviour_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) readonly buffer States { AgentState states[]; };
layout(std430) readonly buffer Bodies { Body bodies[]; };
layout(std430) readonly buffer Walkers { Walker walkers[]; };
layout(std430) readonly buffer BehaviourStates { BehaviourState behaviour_states[]; };
layout(std430) readonly buffer BehaviourRules { BehaviourRule behaviour_rules[]; };
layout(std430) readonly buffer BehaviourPoints { vec2 behaviour_points[]; };
layout(std430) readonly buffer Censuses { Census censuses[]; };
layout(std430) readonly buffer Tallies { Tally tallies[]; };
layout(std430) buffer Minds { Mind minds[]; };
uniform float now;        // s
uniform uint steps_done;  // counted with this one

#include "shaders/shared/random.glsl"
#include "shaders/shared/images.glsl"
#include "shaders/cells/cells.glsl"
#include "shaders/cells/cell_starts.glsl"
#include "shaders/behaviour/draws.glsl"
#include "shaders/behaviour/outlines.glsl"
#include "shaders/behaviour/conditions.glsl"

bool isDone(BehaviourState doing, Asking who, bool has_been_there) {
    if (doing.does == DOES_FLEE) return distance(who.position, doing.from) >= doing.distance;
    return has_been_there && who.mind.visits_left == 0u;
}

/// @returns NO_INDEX: goes on as it does
uint nextState(BehaviourState doing, Asking who, bool has_been_there) {
    bool all_hold = true;
    for (uint i = doing.first_rule; i < doing.first_rule + doing.rule_count; ++i) {
        BehaviourRule rule = behaviour_rules[i];
        all_hold = all_hold && holds(rule, i, who);
        if (rule.then == NO_INDEX) continue;
        if (all_hold) return rule.then;
        all_hold = true;
    }
    return doing.then != NO_INDEX && isDone(doing, who, has_been_there) ? doing.then : NO_INDEX;
}

void enterState(inout Mind mind, uint next, uint leader) {
    mind.state = next;
    mind.since = steps_done;
    mind.entered += 1u;
    mind.visited = 0u;
    BehaviourState doing = behaviour_states[next];
    uint choices = doing.most - doing.least + 1u;
    uint extra = min(uint(chanceOf(PURPOSE_COUNT, leader, mind.entered) * float(choices)), choices - 1u);
    mind.visits_left = doing.does == DOES_VISIT ? doing.least + extra : 0u;
    mind.place = NO_INDEX;
    mind.followed = NO_INDEX;
    mind.picks = 0u;
    mind.flags = MIND_NEEDS_GOAL;
}

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= live_count || isImage(walkers[slot].flags)) return;
    uint row = bodies[slot].row;
    Mind mind = minds[row];
    if (mind.state == NO_INDEX) return;
    AgentState state = states[row];
    if (state.stage - mind.first_stage > 1u) return;  // an event has sent it elsewhere
    bool has_been_there = state.stage != mind.first_stage;
    bool arrived = has_been_there || state.leave_step != 0u || state.status == STATUS_ARRIVED;
    Asking who = Asking(row, walkers[slot].party_first, bodies[slot].position, mind, arrived);
    uint next = mind.entered == 0u ? mind.state : nextState(behaviour_states[mind.state], who, has_been_there);
    if (next == NO_INDEX) return;
    enterState(mind, next, who.leader);
    minds[row] = mind;
}
