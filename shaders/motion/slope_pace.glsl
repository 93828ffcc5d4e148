// SPDX-License-Identifier: Apache-2.0
// How much slower people walk uphill, and faster or slower downhill, as a factor on their speed in plan.

/// Tobler's hiking function (1993), 6 exp(-3.5 |slope + 0.05|) km/h, over its value on flat ground: fastest at 5 % down.
float hikingPace(float slope) { return exp(-3.5 * (abs(slope + 0.05) - 0.05)); }

/// Weidmann (1993): people climb stairs at 0.610 m/s in plan and go down at 0.694 m/s, where they walk at 1.34 m/s on flat
/// ground. Stairs that rise less than one in two slow people down by less.
float stairPace(float slope) {
    float least = slope > 0.0 ? 0.610 / 1.34 : 0.694 / 1.34;
    return mix(1.0, least, min(abs(slope) / 0.5, 1.0));
}

float slopePace(vec2 position, vec2 direction) {
    const float REACH = 0.35;  // m, half a step
    float slope = smoothSlope(position, direction, REACH);
    return mix(hikingPace(slope), stairPace(slope), smoothstep(0.3, 0.8, smoothGround(position).y));
}
