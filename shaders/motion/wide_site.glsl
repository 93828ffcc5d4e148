// SPDX-License-Identifier: Apache-2.0
// Steps on wide sites, where single precision is too coarse to add a step to a place: what rounding drops is kept
// beside the place, and added to the next step (compensated summation, Kahan 1965).

/// The place `way` metres on, rounded.
vec2 placeAfter(vec2 position, vec2 way) {
    precise vec2 place = position + way;
    return place;
}

/// What rounding dropped from it.
vec2 droppedFrom(vec2 position, vec2 way) {
    precise vec2 dropped = way - (placeAfter(position, way) - position);
    return dropped;
}

/// Moves somebody to its target. Where nobody and nothing pushed it off its way, the step is what was meant, to the
/// last bit; contact works on rounded places, and its noise of a rounding or two is no push.
/// @returns how far it has gone
vec2 goFinely(inout AgentState state, vec2 before, vec2 way, vec2 target) {
    const float NOISE = 3.0e-7;
    vec2 meant = placeAfter(before, way);
    bool pushed = any(greaterThan(abs(target - meant), NOISE * abs(meant)));
    vec2 moved = pushed ? target - before : way - state.rest;
    state.position = pushed ? target : meant;
    state.rest = pushed ? vec2(0.0) : droppedFrom(before, way);
    return moved;
}

void addFinely(inout float sum, inout float rest, float more) {
    precise float whole = more + rest;
    precise float after = sum + whole;
    precise float dropped = whole - (after - sum);
    sum = after;
    rest = dropped;
}
