// SPDX-License-Identifier: Apache-2.0
// Whom somebody may touch, read from its list. Who is near in the plane is near in the order of the cells, too: a row
// of cells further at most, which in all but the very widest crowds is less than 32,768 people away.
// Needs the block TouchLists.

/// @param nth below TOUCH_CAPACITY
uint touchSlot(uint self_slot, uint nth) {
    int two = int(touch_lists[self_slot * TOUCH_WORDS + nth / 2u]);
    return uint(int(self_slot) + bitfieldExtract(two, 16 * int(nth % 2u), 16));
}

/// How many may touch, where they are listed: above TOUCH_CAPACITY the list does not hold them all.
uint touchesListed(uint touch_word) { return touch_word & (TOUCH_COUNT_MASK | TOUCH_UNLISTED); }
