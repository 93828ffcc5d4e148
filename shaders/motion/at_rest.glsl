// SPDX-License-Identifier: Apache-2.0
// At rest: who has come to rest where it waits stays there, with its feet still.
//
// People who stand are brushed by those who pass, and by those who stand beside them. Who walked back to its spot after
// each touch would paddle to and fro for as long as it stands, mostly backwards. So who has stopped in an area wants
// nothing any more, and neither does who is near enough to a place of its own or its place in a line; small pushes are
// met with feet in place, as by those under way (shaders/motion/planted_feet.glsl), and only what one cannot but go
// along with moves them.

/// m/s: what feet hold against, and what they cannot but go along with.
const vec2 STILL = vec2(AT_REST_FIRM_FROM, AT_REST_FIRM_TO);

/// @param feet FEET_*
void keepFeetStill(uint feet, inout vec2 wanted, inout vec2 legs) {
    if (!AT_REST_ENABLED || (feet & FEET_STILL) == 0u) return;
    wanted *= smoothstep(STILL.x, STILL.y, length(wanted));
    legs *= smoothstep(STILL.x, STILL.y, length(legs));
}
