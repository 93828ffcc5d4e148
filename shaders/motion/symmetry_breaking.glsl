// SPDX-License-Identifier: Apache-2.0
// Two people who walk straight at each other, and rings of people who all aim at the centre, are in an unstable balance
// that nobody's rules would ever leave. Everybody therefore aims a little beside the mark, always by the same angle.
// Needs the block ParametersBlock and shaders/shared/random.glsl.

const uint PURPOSE_SYMMETRY = 0x51u;

/// rad to the left of the way.
float ownAngle(uint row) {
    if (!SYMMETRY_BREAKING_ENABLED) return 0.0;
    return (randomUnit(parameters.seed, row, PURPOSE_SYMMETRY) * 2.0 - 1.0) * SYMMETRY_BREAKING_MOST;
}
