// SPDX-License-Identifier: Apache-2.0
// Passing side, usually off: two who meet head-on pass on the side that is usual where they live (Moussaid, Helbing,
// Garnier, Johansson, Combe and Theraulaz 2009). In crowds, lanes then form on that side of a street.

/// m/s^2: how much of the room that is made for somebody oncoming goes to that side.
vec2 passingSide(vec2 way, float oncoming, vec2 room) {
    return vec2(way.y, -way.x) * (PASSING_SIDE_TO_THE_RIGHT * oncoming * length(room));
}
