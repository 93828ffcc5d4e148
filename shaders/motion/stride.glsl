// SPDX-License-Identifier: Apache-2.0
// Stride: where a velocity takes somebody in a step, unless bodies touch.
// Needs the blocks ParametersBlock, Targets, TargetsAfter and Ways, and shaders/motion/wide_site.glsl.

/// @param rest m that rounding has dropped from the position; wide sites only
void stride(uint slot, vec2 position, vec2 velocity, vec2 rest) {
    vec2 way = velocity * parameters.step_seconds;
    vec2 target = position + way;
    if (parameters.is_wide != 0u) {
        way += rest;
        ways[slot] = way;
        target = placeAfter(position, way);
    }
    targets[slot] = target;
    targets_after[slot] = target;
}
