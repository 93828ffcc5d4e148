// SPDX-License-Identifier: Apache-2.0
// Passing side: two who meet head-on pass on the side that is usual where they live (Moussaid, Helbing, Garnier,
// Johansson, Combe and Theraulaz 2009). In streams that meet, lanes then form on that side.
//
// Two who come to a narrow door from both sides of it walk towards each other, too, and go through it one after the
// other: so who has a body knows who comes the other way by the way through (taking_turns.glsl). Discs, which usually
// have no side, do not ask.

#ifdef BODIES
const bool HAVE_SIDES = PASSING_SIDE_ENABLED;
#else
const bool HAVE_SIDES = PASSING_SIDE_ENABLED && PASSING_SIDE_DISCS_TO_THE_RIGHT != 0.0;
#endif

/// How much of the room that is made for somebody oncoming goes to the right.
/// @param is_met somebody ahead comes the other way, and one has a body
float toTheRight(bool has_body, bool is_met) {
    return has_body ? (is_met ? PASSING_SIDE_TO_THE_RIGHT : 0.0) : PASSING_SIDE_DISCS_TO_THE_RIGHT;
}

/// m/s^2: that part of it.
vec2 passingSide(vec2 way, float to_the_right, float oncoming, vec2 room) {
    return vec2(way.y, -way.x) * (to_the_right * oncoming * length(room));
}
