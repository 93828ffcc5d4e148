// SPDX-License-Identifier: Apache-2.0
// Who takes turns: people in a narrow passage, or close before one, who press on. Those who were given a headway of
// their own leave room to each other by that; and where some come the other way, nobody takes turns: whoever is behind
// another would then make way right into those.
//
// Who comes the other way is told by where ways lead through the passage, not by how they begin: two who stand on both
// sides of a door walk towards each other first.
// Needs shaders/motion/headway.glsl.

bool takesTurns(Walker walker, uint touch_word) {
    return (touch_word & TOUCH_IN_NARROWS) != 0u && headwayOf(walker) <= 0.0;
}

bool isOncoming(uint way_through, uint its_way_through) {
    return dot(unpackSnorm2x16(way_through), unpackSnorm2x16(its_way_through)) < NEAREST_FIRST_ONCOMING;
}
