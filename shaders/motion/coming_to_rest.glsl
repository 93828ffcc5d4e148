// SPDX-License-Identifier: Apache-2.0
// Coming to rest: those who stop slow down before their place, and close in on the last decimetres instead of
// overshooting. Who has stopped further away, because its place was full, stays where it is.
#include "shaders/shared/walker.glsl"

/// m/s.
float speedBeforeRest(float speed, Stage stage, RouteAhead ahead, bool stopped) {
    if (stopped && (stage.flags & STAGE_ANYWHERE) != 0u && ahead.remaining > COMING_TO_REST_CONTENT) return 0.0;
    if (stage.dwell <= 0.0) return speed;
    return min(speed, min(sqrt(2.0 * COMING_TO_REST_BRAKING * ahead.remaining),
                          ahead.remaining / COMING_TO_REST_SETTLING));
}

/// Somebody who stands in an area, or has its place in a line; or is a little past that, and waits for the line to move
/// up instead of stepping back.
bool hasComeToRest(Walker walker, Stage stage, RouteAhead ahead, bool stopped, float heading) {
    if (!AT_REST_ENABLED) return false;
    if (stopped && (stage.flags & STAGE_IN_AREA) != 0u) return true;
    if (stopped && stage.dwell > 0.0 && ahead.remaining <= AT_REST_CONTENT) return true;
    bool past = dot(ahead.direction, vec2(cos(heading), sin(heading))) < 0.0;
    return ticketOf(walker) != NO_INDEX && ahead.remaining <= (past ? AT_REST_PAST : AT_REST_CONTENT);
}
