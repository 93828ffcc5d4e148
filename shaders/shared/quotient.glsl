// SPDX-License-Identifier: Apache-2.0
// Division of whole numbers by ones that only the parameters know. Few processors divide several of those at once: a
// software renderer does it one invocation after the other, which took a sixth of the time of routes round jams.

/// number / divisor, and number % divisor; where the quotient is below 2^20, floats tell it to within one.
uvec2 quotientAndRemainder(uint number, uint divisor) {
    uint quotient = uint(float(number) / float(divisor));
    int remainder = int(number - quotient * divisor);
    if (remainder < 0) return uvec2(quotient - 1u, remainder + int(divisor));
    if (remainder >= int(divisor)) return uvec2(quotient + 1u, remainder - int(divisor));
    return uvec2(quotient, remainder);
}
