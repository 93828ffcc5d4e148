// SPDX-License-Identifier: Apache-2.0
// What somebody wants on a belt, and before it (shaders/motion/riding.glsl).
// Needs shaders/shared/charts.glsl, shaders/charts/belts.glsl and shaders/motion/riding.glsl.

/// Whether somebody before a belt is about to step on: its way leads there.
bool makesFor(Ride ride, vec2 way) {
    if (ride.along > 0.0) return false;
    vec2 to = belts[ride.chart].along * (RIDING_STEPS_ON - ride.along) +
              vec2(belts[ride.chart].along.y, -belts[ride.chart].along.x) * ride.aside;
    float far = length(to);
    return far < RIDING_SEES && dot(way, to) > RIDING_TOWARDS * far;
}

/// @param way unit vector: where it wants to go
Ride rideAt(vec2 position, vec2 way) {
    ChartCell cell = chartCellAt(position);
    uint own = chartOf(cell);
    if (own == NO_CHART) return Ride(NO_CHART, false, 0.0, 0.0);
    vec2 home = position - chart_shifts[own];
    if (isBelt(own)) return rideOn(own, true, home);
    for (uint image = 0u; image < MOST_IMAGES; ++image) {  // whoever is near a belt has an image on it
        uint chart = (cell.images >> (8u * image)) & NO_CHART;
        if (!isBelt(chart)) continue;
        Ride ride = rideOn(chart, false, home);
        if (makesFor(ride, way)) return ride;
    }
    return Ride(NO_CHART, false, 0.0, 0.0);
}

/// For a walker's flags.
uint flagsOf(Ride ride) {
    if (ride.chart == NO_CHART) return 0u;
    return ride.chart << WALKER_CHART_AT | WALKER_RIDES | (ride.on ? WALKER_IS_CARRIED : 0u);
}

vec2 onBelt(Ride ride, float along, float aside) {
    vec2 forward = belts[ride.chart].along;
    return forward * along + vec2(-forward.y, forward.x) * aside;
}

/// Along a belt; before it, to where it rides, if it gets there between the railings; otherwise `way`.
vec2 wayOnBelt(Ride ride, bool walks, vec2 way) {
    if (ride.on) return belts[ride.chart].along;
    const float WITHIN = 0.5;  // m: on the belt
    float ahead = WITHIN - ride.along, aside = laneOf(ride, walks) - ride.aside;
    float crosses = ride.aside + aside * (-ride.along / ahead);
    return abs(crosses) > belts[ride.chart].half_width - RIDING_CLEAR ? way : normalize(onBelt(ride, ahead, aside));
}

/// m/s, relative to the ground: what somebody on a belt wants. @param speed m/s: as fast as it would walk there
vec2 wishOnBelt(Ride ride, bool walks, float speed) {
    const float WITHIN = 0.5;  // s: it gets there
    float aside = laneOf(ride, walks) - ride.aside;
    float over = abs(aside) > RIDING_THERE ? clamp(aside / WITHIN, -RIDING_ASIDE, RIDING_ASIDE) : 0.0;
    if (stepsOff(ride)) return onBelt(ride, speed, 0.0);
    return onBelt(ride, walks || ride.along < RIDING_STEPS_ON ? speed : 0.0, over);
}
