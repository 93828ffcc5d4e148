// SPDX-License-Identifier: Apache-2.0
// How long strides are at what speed, and when they change.
//
// People who walk faster take longer steps and more of them, both in the same proportion: the ratio of step length to step rate, the
// walk ratio, stays at about 0.0065 m per step/min over all speeds of free walking (Sekiya, Nagasaki, Ito and Furuna 1996). A stride of
// two steps is then as long as the root of the speed: 1.249 m at 1 m/s.
//
// A renderer has clips of a few strides, not of all: the gaits, a fixed ratio apart, each walked with its own stride, so that the phase
// always follows the way and feet do not slide. Changing the stride would move a planted foot, except where it is under the body:
// that is where strides change.

float strideOf(uint gait) { return GAIT_NORMAL_STRIDE * pow(GAIT_RATIO, float(gait) - float(GAIT_NORMAL)); }

/// Where among the gaits somebody of this speed (more than zero) would be.
float gaitScale(float speed) {
    return float(GAIT_NORMAL) + log(GAIT_STRIDE_AT_ONE * sqrt(speed) / GAIT_NORMAL_STRIDE) / log(GAIT_RATIO);
}

/// The gait to go on with. Speeds jitter: one that is nearly as good stays.
uint nextGait(uint gait, float speed, float phase_before, float phase_after) {
    const float STAYS = 0.6;
    if (speed < STANDING_SPEED) return GAIT_SETTING_OFF;
    bool under_the_body = floor(2.0 * (phase_before - GAIT_UNDER_BODY)) != floor(2.0 * (phase_after - GAIT_UNDER_BODY));
    float scale = gaitScale(speed);
    if (!under_the_body || abs(scale - float(gait)) < STAYS) return gait;
    return uint(clamp(round(scale), 0.0, float(GAIT_COUNT - 1u)));
}
