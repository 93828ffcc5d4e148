// SPDX-License-Identifier: Apache-2.0
// Facing ahead: who is stuck at a narrow passage is pushed about by those round it. Its feet follow the pushes, but it
// keeps looking where it wants to go, as people before a door do: there they stand turned to it.

/// m/s: what is added to one's velocity to tell where one looks.
vec2 aheadWhereStuck(vec2 wish, float nervousness) {
    if (!FACING_AHEAD_ENABLED) return vec2(0.0);
    return wish * smoothstep(FACING_AHEAD_BEGINS, FACING_AHEAD_COMPLETE, nervousness);
}
