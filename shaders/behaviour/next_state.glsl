// SPDX-License-Identifier: Apache-2.0
// Which state comes next, and how one begins.
// Needs the blocks BehaviourStates and BehaviourRules, the uniform steps_done, and shaders/behaviour/draws.glsl and
// conditions.glsl.

bool isDone(BehaviourState doing, Asking who, bool has_been_there) {
    if (doing.does == DOES_FLEE && doing.row_count > 0u) return (who.mind.flags & MIND_IS_SAFE) != 0u;
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
    mind.let_go = 0u;
    mind.next = NO_INDEX;
}
