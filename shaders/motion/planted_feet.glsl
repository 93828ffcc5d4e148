// SPDX-License-Identifier: Apache-2.0
// Planted feet: legs walk forwards.
//
// In a crush, bodies push each other to and fro by centimetres. A push takes somebody back, and its velocity with it,
// which would then be walked on backwards for half a second: seen from outside, a crowd that paddles. People meet a
// small push with their feet in place, and only a large one with a step (Horak and Nashner 1986). So who is under way
// among others who are neither keeps the small velocity backwards that a push has left it with nor walks backwards
// slowly by itself, and where it cannot get on, it turns on the spot (shaders/motion/turning.glsl).
//
// Feet in place alone would be a vice: two streams that have locked stay locked, because nobody yields any more. People
// who are pushed head-on turn a shoulder and let the other slip past. So what is taken from walking backwards is walked
// aside instead, to the side to which one is moving already, and streams get through each other sooner than without
// planted feet. To the side where one would like to go does worse: before a passage all of them like its middle, and
// they wedge each other.
//
// Who waits for its turn in a stream that goes one way has nobody to slip past, and its feet give more: planted firmly,
// they break the stream up into waves of stopping and going. So do those who wait in a line, where all others stand and
// places are steps apart. Who is among people who only stand otherwise is pushed by nobody: it is itself that presses,
// and steps back where it has gone astray among them.
// Needs shaders/motion/under_way.glsl.

/// m/s: as slowly as the first nobody walks backwards; from the second on one cannot but go along.
const vec2 FIRM = vec2(PLANTED_FEET_FIRM_FROM, PLANTED_FEET_FIRM_TO);
const vec2 WAITING = vec2(PLANTED_FEET_WAITING_FROM, PLANTED_FEET_WAITING_TO);

/// m/s: what feet take from walking backwards.
float takenBack(vec2 velocity, vec2 facing, vec2 feet) {
    float back = max(-dot(velocity, facing), 0.0);
    return back * (1.0 - smoothstep(feet.x, feet.y, back));
}

/// @param feet FEET_*
/// @param wanted the velocity that it is to have next
/// @param legs the velocity that legs start from
void plantFeet(Body self, Walker walker, uint feet, inout vec2 wanted, inout vec2 legs) {
    bool in_line = ticketOf(walker) != NO_INDEX;
    if (!PLANTED_FEET_ENABLED || (!in_line && ((feet & FEET_IN_TRAFFIC) == 0u || !isUnderWay(walker)))) return;
    bool waits = in_line || (feet & FEET_WAIT) != 0u;
    vec2 facing = vec2(cos(self.heading), sin(self.heading));
    float back = takenBack(wanted, facing, waits ? WAITING : FIRM);
    wanted += facing * back;
    if (waits) return;
    legs += facing * takenBack(legs, facing, FIRM);
    vec2 aside = vec2(-facing.y, facing.x);
    wanted += aside * (dot(self.velocity, aside) >= 0.0 ? PLANTED_FEET_SLIP : -PLANTED_FEET_SLIP) * back;
}
