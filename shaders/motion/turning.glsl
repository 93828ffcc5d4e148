// SPDX-License-Identifier: Apache-2.0
// Turning: who walks looks where it goes, who has stopped at what there is to see, and who cannot get on turns on the
// spot to where it wants to go before it walks there.
// Needs the blocks ParametersBlock and WaitingLines, and shaders/motion/waiting_line.glsl, under_way.glsl and
// facing_ahead.glsl.

#include "shaders/motion/turn_towards.glsl"

/// What somebody who stops looks at: what the stop is about; in a line, the place before its own.
vec2 toLookAt(AgentState state, Stage stage) {
#ifdef WAITING_LINES
    if (stage.line == NO_INDEX) return stage.facing;
    WaitingLine line = waiting_lines[stage.line];
    if (state.ticket == NO_INDEX || state.ticket == line.served) return stage.facing;
    return placeInLine(line, state.ticket - line.served - 1u).point;
#else
    return stage.facing;
#endif
}

/// The heading after one more step.
float turned(AgentState state, Stage stage, Walker walker, vec2 wish, bool takes_turns, float speed) {
    bool stops = !isUnderWay(walker);
    vec2 look = state.velocity;
    if (takes_turns && !stops) look += aheadWhereStuck(wish, state.nervousness);
    if (speed >= (stops ? TURNING_STEPPING_ASIDE : STANDING_SPEED)) return turnTowards(state.heading, look);
    if (TURNING_ON_THE_SPOT && !stops && length(wish) > STANDING_SPEED) return turnTowards(state.heading, wish);
    vec2 sight = toLookAt(state, stage) - state.position;
    return stops && length(sight) > TURNING_SIGHT ? turnTowards(state.heading, sight) : state.heading;
}
