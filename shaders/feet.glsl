// SPDX-License-Identifier: Apache-2.0
// Legs walk forwards.
//
// In a crush, bodies push each other to and fro by centimetres. A push takes somebody back, and its velocity with it, which
// would then be walked on backwards for half a second: seen from outside, a crowd that paddles. People meet a small push with
// their feet in place, and only a large one with a step (Horak and Nashner 1986). So who is under way does not walk on
// backwards slowly, and where it cannot get on, it turns on the spot to where it wants to go before it walks there.
//
// Only those who keep a headway do: they wait for their turn, and space opens in front of them. Who presses on meets others
// who press on the other way, and where such streams have locked, somebody has to yield: with firmly planted feet, the jam of
// four sides of `scenarios/annulus.json` stood still for good with one of three seeds.

/// m/s: as slowly as the first nobody walks backwards; from the second on one cannot but go along. Feet planted more firmly (0.3
/// and 0.6) break a dense stream that walks one way into waves of stopping and going.
const float FEET_STAY = 0.1;
const float FEET_YIELD = 0.25;

/// Neither stands somewhere nor waits in a line.
bool isUnderWay(Walker walker) {
    return walker.status == STATUS_WALKING && walker.leave_step == 0u && walker.ticket == NO_INDEX;
}

/// Who stands somewhere shuffles back to its place as it likes.
bool walksForwards(Walker walker) { return walker.headway > 0.0 && isUnderWay(walker); }

vec2 withPlantedFeet(vec2 wanted, float heading) {
    vec2 facing = vec2(cos(heading), sin(heading));
    float back = max(-dot(wanted, facing), 0.0);
    return wanted + facing * back * (1.0 - smoothstep(FEET_STAY, FEET_YIELD, back));
}
