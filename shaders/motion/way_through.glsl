// SPDX-License-Identifier: Apache-2.0
// The way through a narrow passage: where one's route leads after so many metres, which for everybody who is before
// a passage is beyond it.
// Needs shaders/routes/route.glsl.

const uint STEPS_THROUGH = 6u;

/// A unit vector, or less at one's goal.
vec2 wayThrough(Stage stage, vec2 position, RouteAhead ahead) {
    float stride = NEAREST_FIRST_THROUGH / float(STEPS_THROUGH);
    for (uint i = 0u; i < STEPS_THROUGH && ahead.remaining > stride; ++i) {
        position += ahead.direction * stride;
        ahead = routeAhead(stage, position);
    }
    return ahead.direction;
}
