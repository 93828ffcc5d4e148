// SPDX-License-Identifier: Apache-2.0
// Held at red: whose way leads onto a crossing that is red goes to a spot of its own before the nearest edge that one
// comes in by, and stands there. Who is on the crossing goes on. Only with TRAFFIC.
// Needs shaders/traffic/crossings.glsl, shaders/shared/random.glsl and shaders/routes/route.glsl.
#include "shaders/traffic/held.glsl"

const float LOOK_FOR_RED = 7.0;         // m along the way
const float STRIDE_TO_RED = 0.7;        // m
const vec2 BEFORE_EDGE = vec2(0.2, 2.4);  // m between bodies and the edge, from the first to the last
const vec2 ALONG_EDGE = vec2(0.06, 0.94);  // of its length
const float BRAKING_FOR_RED = 0.8;      // m/s^2
const float SETTLING_AT_RED = 0.7;      // s
const float AT_SPOT = 0.25;             // m: near enough
const uint PURPOSE_KERB = 0x7edu;

struct Hold {
    bool is_held;
    vec2 direction;
    float speed;  // m/s, at most
};

/// Whether one's way leads onto a crossing soon.
bool leadsOnto(TrafficCrossing crossing, Stage stage, vec2 position, RouteAhead ahead) {
    float walked = 0.0;
    while (walked < LOOK_FOR_RED && ahead.remaining > STRIDE_TO_RED) {
        position += ahead.direction * STRIDE_TO_RED;
        walked += STRIDE_TO_RED;
        if (isOnCrossing(crossing, position)) return true;
        ahead = routeAhead(stage, position);
    }
    return false;
}

/// Where somebody waits, before the nearest edge that one comes in by.
vec2 spotBefore(TrafficCrossing crossing, vec2 position, float radius, uint row) {
    float along = mix(ALONG_EDGE.x, ALONG_EDGE.y, randomUnit(parameters.seed, row, PURPOSE_KERB));
    float depth = randomUnit(parameters.seed, row, PURPOSE_KERB + 1u);
    float least = 1.0e30;
    vec2 spot = position;
    for (uint i = 0u; i < min(crossing.point_count, MOST_ENTRIES); ++i) {
        if ((crossing.entries >> i & 1u) == 0u) continue;
        vec2 a = crossing_points[crossing.first_point + i];
        vec2 edge = crossing_points[crossing.first_point + (i + 1u) % crossing.point_count] - a;
        float share = clamp(dot(position - a, edge) / dot(edge, edge), 0.0, 1.0);
        vec2 off = position - (a + edge * share);
        if (dot(off, off) >= least) continue;
        least = dot(off, off);
        vec2 outward = normalize(vec2(-edge.y, edge.x));
        if (isOnCrossing(crossing, a + 0.5 * edge + 0.05 * outward)) outward = -outward;
        spot = a + edge * along + outward * (radius + mix(BEFORE_EDGE.x, BEFORE_EDGE.y, depth * depth));
    }
    return least < 4.0 * LOOK_FOR_RED * LOOK_FOR_RED ? spot : position;
}

Hold heldAtRed(Stage stage, vec2 position, RouteAhead ahead, float radius, uint row) {
    for (uint i = 0u; i < CROSSINGS; ++i) {
        TrafficCrossing crossing = crossings[i];
        if (!isRed(crossing.light) || isOnCrossing(crossing, position) || !leadsOnto(crossing, stage, position, ahead))
            continue;
        vec2 way = spotBefore(crossing, position, radius, row) - position;
        float left = length(way);
        if (left <= AT_SPOT) return Hold(true, ahead.direction, 0.0);
        return Hold(true, way / left, min(sqrt(2.0 * BRAKING_FOR_RED * left), left / SETTLING_AT_RED));
    }
    return Hold(false, vec2(0.0), 0.0);
}
