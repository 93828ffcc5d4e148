// SPDX-License-Identifier: Apache-2.0
// Shoulders: which way a chest points. It follows the heading, no faster than a trunk turns. Before a gap between walls
// that is narrower than about 1.3 shoulder breadths people turn their shoulders (Warren and Whang 1987), the further
// the narrower it is, and go sideways through one that just takes their chest. Where others or walls push a shoulder,
// it gives way (shaders/motion/capsules_apart.glsl).
// Needs the block ParametersBlock and shaders/shared/body_shape.glsl.

#ifdef BODIES

const float QUARTER_TURN = 1.5707963;
const float HALF_TURN = 3.14159265358979;

/// m^2, of a body of mass one about its middle: that of an ellipse as broad and as deep.
float inertiaOf(float radius, float thickness) {
    return SHOULDERS_INERTIA * 0.5 * 0.5 * (radius * radius + thickness * thickness);
}

/// `axis`, as long as `start` and turned from it by no more than a chest turns in a step (a quarter turn at most).
/// Without angles, as this is asked in every round, and of every wall.
vec2 withinATurn(vec2 axis, vec2 start) {
    float most = min(SHOULDERS_FASTEST * parameters.step_seconds, QUARTER_TURN);
    float along = dot(start, axis), aside = crossOf(start, axis);
    if (along > 0.0 && abs(aside) * cos(most) <= along * sin(most))
        return axis * sqrt(dot(start, start) / dot(axis, axis));
    return turnedBy(start, aside == 0.0 ? 0.0 : aside > 0.0 ? most : -most);
}

/// rad: how far shoulders are turned for a gap.
float twistFor(float gap, float radius, float thickness) {
    float begins = SHOULDERS_CRITICAL * 2.0 * radius;
    float ends = 2.0 * thickness + SHOULDERS_MARGIN;
    return QUARTER_TURN * clamp((begins - gap) / max(begins - ends, 1.0e-3), 0.0, 1.0);
}

/// rad/s, after one more step: shoulders close in on where they are to be without swinging past it.
float chestRate(float angle, float rate, float wanted) {
    float left = wanted - angle;
    left -= 2.0 * HALF_TURN * floor((left + HALF_TURN) / (2.0 * HALF_TURN));
    float soon = SHOULDERS_STIFFNESS * parameters.step_seconds;
    float next = (rate + SHOULDERS_STIFFNESS * soon * left) / ((1.0 + soon) * (1.0 + soon));
    return clamp(next, -SHOULDERS_FASTEST, SHOULDERS_FASTEST);
}

/// rad: which way shoulders that are to be turned by `twist` point. On the side to which they are turned already; who
/// has not begun turns as its row says.
float chestWanted(float heading, float angle, float twist, uint row) {
    const float BEGUN = 5.0e-2;
    float turned = sin(angle - heading);
    bool left = abs(turned) > BEGUN ? turned > 0.0 : (row & 1u) == 0u;
    return heading + (left ? twist : -twist);
}

#endif
