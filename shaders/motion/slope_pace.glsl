// SPDX-License-Identifier: Apache-2.0
// Slopes: how much slower people walk uphill, and faster or slower downhill, as a factor on their speed in plan.
// Needs shaders/shared/terrain.glsl and shaders/motion/climbing.glsl, and where ground moves shaders/charts/belts.glsl.

/// Tobler's hiking function (1993), 6 exp(-3.5 |slope + 0.05|) km/h, over its value on flat ground: fastest at 5 %
/// down.
float hikingPace(float slope) {
    return exp(-SLOPE_PACE_HIKING * (abs(slope + SLOPE_PACE_FASTEST_DOWN) - SLOPE_PACE_FASTEST_DOWN));
}

/// Weidmann (1993): how fast people climb stairs and go down, where on flat ground they walk at 1.34 m/s. Stairs that
/// rise less than those slow people down by less.
float stairPace(float slope) {
    const float FLAT = 1.34;  // m/s
    float least = slope > 0.0 ? SLOPE_PACE_STAIRS_UP / FLAT : SLOPE_PACE_STAIRS_DOWN / FLAT;
    return mix(1.0, least, min(abs(slope) / SLOPE_PACE_STAIRS_RISE, 1.0));
}

/// The ground in a direction.
struct Incline {
    float slope;   // rise over run
    float stairs;  // 0: a ramp, 1: stairs
    bool is_belt;
};

/// How much of the smooth ground at a position is stairs, 0 to 1.
float stairsOf(vec2 ground) { return smoothstep(SLOPE_PACE_STAIRS_BEGIN, SLOPE_PACE_STAIRS_COMPLETE, ground.y); }

bool mostlyStairs(float stairs) { return stairs >= 0.5; }

/// @param ground the smooth one at the position
Incline inclineAt(vec2 position, vec2 direction, vec2 ground) {
    Incline incline;
    incline.slope = smoothSlope(position, direction, SLOPE_PACE_REACH, ground.x);
    incline.stairs = stairsOf(ground);
    incline.is_belt = false;
#ifdef BELTS
    uint chart = chartOf(chartCellAt(position));
    incline.is_belt = isBelt(chart);
    if (incline.is_belt) incline.stairs = float(belts[chart].has_steps);
#endif
    return incline;
}

float paceOn(Incline incline) { return mix(hikingPace(incline.slope), stairPace(incline.slope), incline.stairs); }

/// WALKER_CLIMBS, WALKER_DESCENDS or none: how people walk on belts is a rule of its own.
uint climbingFlags(Incline incline) {
    if (incline.is_belt || !mostlyStairs(incline.stairs)) return 0u;
    return incline.slope > 0.0 ? WALKER_CLIMBS : WALKER_DESCENDS;
}
