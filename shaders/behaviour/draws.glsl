// SPDX-License-Identifier: Apache-2.0
// Numbers of people's own, by counting: they depend on the seed, the first of one's party, and how many states and
// goals one has had, so that those who walk together do the same for as long. Needs shaders/shared/random.glsl.

const uint PURPOSE_TIME = 0xb1u;
const uint PURPOSE_COUNT = 0xb2u;
const uint PURPOSE_PLACE = 0xb3u;
const uint PURPOSE_SPOT = 0xb4u;
const uint PURPOSE_CHANCE = 0xb5u;
const uint PURPOSE_STAY = 0xb6u;

/// In [0, 1).
float chanceOf(uint purpose, uint leader, uint count) { return randomUnit(parameters.seed ^ purpose, leader, count); }

/// As authoring/scene/random.h draws them.
float drawnNumber(Drawn drawn, uint purpose, uint leader, uint count) {
    if (drawn.kind == 0u) return drawn.mean;
    float first = chanceOf(purpose, leader, 2u * count);
    if (drawn.kind == 1u) return mix(drawn.minimum, drawn.maximum, first);
    float angle = 6.28318530717959 * chanceOf(purpose, leader, 2u * count + 1u);
    float value = drawn.mean + drawn.deviation * sqrt(-2.0 * log(1.0 - first)) * cos(angle);
    return clamp(drawn.kind == 3u ? exp(value) : value, drawn.minimum, drawn.maximum);
}
