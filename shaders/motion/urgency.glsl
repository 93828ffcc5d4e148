// SPDX-License-Identifier: Apache-2.0
// How impatient somebody is, 0 to 1, and in the number's sign whether it takes turns: one word a person for the rounds
// of contact to load.

float urgencyOf(bool takes_turns, float impatience) {
    return uintBitsToFloat(floatBitsToUint(impatience) | (takes_turns ? 0x80000000u : 0u));
}

bool takesTurns(float urgency) { return (floatBitsToUint(urgency) & 0x80000000u) != 0u; }
