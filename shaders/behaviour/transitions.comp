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
layout(std430) buffer Stages { Stage stages[]; };
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
#include "shaders/shared/walker.glsl"
#include "shaders/cells/cell_starts.glsl"
#include "shaders/behaviour/draws.glsl"
#include "shaders/behaviour/outlines.glsl"
#include "shaders/behaviour/conditions.glsl"
#include "shaders/behaviour/next_state.glsl"
#include "shaders/behaviour/letting_go.glsl"

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
    if (behaviour_states[mind.state].does == DOES_SIT) arrived = false;  // it is before the aisle
    Asking who = Asking(row, partyFirstOf(walkers[slot], row), bodies[slot].position, mind, arrived, true);
    BehaviourState doing = behaviour_states[mind.state];
    uint next = mind.state;
    if (mind.let_go != 0u && mind.next != NO_INDEX)
        next = mind.next;
    else if (mind.entered > 0u)
        next = nextState(doing, who, has_been_there);
    if (next == NO_INDEX) return;
    bool goes_on = goesOnWithHands(behaviour_states[next]);
    if (mind.entered > 0u && !goes_on && isLettingGo(mind, doing, arrived)) {
        mind.next = next;
        minds[row] = mind;
        return;
    }
    enterState(mind, next, who.leader);
    minds[row] = mind;
}
