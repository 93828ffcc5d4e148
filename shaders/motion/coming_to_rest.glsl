// SPDX-License-Identifier: Apache-2.0
// Coming to rest: those who stop slow down before their place, and close in on the last decimetres instead of
// overshooting. Who has stopped further away, because its place was full, stays where it is.

/// m/s.
float speedBeforeRest(float speed, Stage stage, RouteAhead ahead, bool stopped) {
    if (stopped && (stage.flags & STAGE_ANYWHERE) != 0u && ahead.remaining > COMING_TO_REST_CONTENT) return 0.0;
    if (stage.dwell <= 0.0) return speed;
    return min(speed, min(sqrt(2.0 * COMING_TO_REST_BRAKING * ahead.remaining),
                          ahead.remaining / COMING_TO_REST_SETTLING));
}
