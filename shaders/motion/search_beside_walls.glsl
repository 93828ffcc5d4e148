// SPDX-License-Identifier: Apache-2.0
// Who does not get on at all beside a wall looks for another way: up to so far aside, another way every so often. It is
// what breaks the arches that form where people press (the fluctuations of Helbing, Farkas and Vicsek 2000). Where
// people take turns (nearest_first.glsl) there are no arches, and nobody searches.
// Needs the block ParametersBlock and shaders/shared/random.glsl.

const uint PURPOSE_SEARCH = 0x5eu;

/// rad to the left of the way.
float searchAngle(uint row, Walker walker, uint touch_word, uint step) {
    if (!SEARCH_BESIDE_WALLS_ENABLED || (touch_word & TOUCH_WALL_NEAR) == 0u) return 0.0;
    float despair = takesTurns(walker, touch_word)
                        ? smoothstep(SEARCH_BESIDE_WALLS_IN_NARROWS, 1.0, walker.nervousness)
                        : smoothstep(SEARCH_BESIDE_WALLS_BEGINS, SEARCH_BESIDE_WALLS_COMPLETE, walker.nervousness);
    if (despair <= 0.0) return 0.0;
    uint turn = uint(float(step) * parameters.step_seconds / SEARCH_BESIDE_WALLS_PERIOD +
                     randomUnit(parameters.seed, row, PURPOSE_SEARCH));
    return despair * SEARCH_BESIDE_WALLS_MOST *
           (randomUnit(parameters.seed ^ PURPOSE_SEARCH, row, turn) * 2.0 - 1.0);
}
