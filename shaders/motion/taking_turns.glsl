// SPDX-License-Identifier: Apache-2.0
// Who takes turns: people in a narrow passage, or close before one, who press on. Those who were given a headway of
// their own leave room to each other by that.
// Needs shaders/motion/headway.glsl.

bool takesTurns(Walker walker, uint touch_word) {
    return (touch_word & TOUCH_IN_NARROWS) != 0u && headwayOf(walker) <= 0.0;
}
