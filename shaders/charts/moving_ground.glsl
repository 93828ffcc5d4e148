// SPDX-License-Identifier: Apache-2.0
// How the ground moves at a place, and what of it a velocity has on another chart. Only with BELTS.
// Needs shaders/shared/charts.glsl.
#include "shaders/charts/belts.glsl"

/// m/s: of the ground of the chart in whose part of the plane somebody is.
vec2 groundVelocity(vec2 position) {
    uint chart = chartOf(chartCellAt(position));
    return isBelt(chart) ? belts[chart].velocity : vec2(0.0);
}

/// m/s: what a velocity is more, seen from the ground of an image, than from that of its person.
vec2 velocitySeenFrom(vec2 image, vec2 person) { return groundVelocity(person) - groundVelocity(image); }
