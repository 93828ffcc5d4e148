// SPDX-License-Identifier: Apache-2.0
// Needs the block ParametersBlock.

const float PI = 3.14159265358979;

float wrapAngle(float angle) { return angle - 2.0 * PI * floor((angle + PI) / (2.0 * PI)); }

float turnTowards(float heading, vec2 direction) {
    float turn = wrapAngle(atan(direction.y, direction.x) - heading);
    float most = TURNING_FASTEST * parameters.step_seconds;
    return wrapAngle(heading + clamp(turn * (1.0 - exp(-parameters.step_seconds / TURNING_TIME)), -most, most));
}
