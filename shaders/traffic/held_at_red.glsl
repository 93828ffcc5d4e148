// SPDX-License-Identifier: Apache-2.0
// Held at red: whose way leads onto a crossing that is red slows down and stands at its edge, each at a distance of
// their own. Who is on it goes on. Only with TRAFFIC.
// Needs shaders/traffic/crossings.glsl and shaders/shared/random.glsl.
#include "shaders/traffic/held.glsl"

const float FREE_OF_RED = 7.0;                  // m: who is further away walks on
const float AT_KERB = 0.05;                     // m
const vec2 BEFORE_KERB = vec2(0.15, 0.8);       // m between bodies and the edge, from the first to the last
const float BRAKING_FOR_RED = 0.8;              // m/s^2
const uint PURPOSE_KERB = 0x7edu;
const float SETTLING_AT_RED = 0.6;              // s

/// m that somebody may go yet; FREE_OF_RED: no red is ahead.
float wayToRed(vec2 position, float radius, uint row, vec2 ahead) {
    float least = FREE_OF_RED;
    for (uint i = 0u; i < CROSSINGS; ++i) {
        TrafficCrossing crossing = crossings[i];
        if (!isRed(crossing.light) || isOnCrossing(crossing, position)) continue;
        float to_edge = distanceToCrossing(crossing, position, ahead, FREE_OF_RED);
        float own = mix(BEFORE_KERB.x, BEFORE_KERB.y, randomUnit(parameters.seed, row, PURPOSE_KERB));
        least = min(least, max(to_edge - radius - own, 0.0));
    }
    return least;
}

/// m/s.
float speedBeforeRed(float free_way) { return min(sqrt(2.0 * BRAKING_FOR_RED * free_way), free_way / SETTLING_AT_RED); }
