// SPDX-License-Identifier: Apache-2.0
// Randomness by counting: the same (seed, row, purpose) gives the same number whenever it is asked for.

/// PCG-RXS-M-XS permutation of one word (O'Neill 2014).
uint scramble(uint x) {
    x = x * 747796405u + 2891336453u;
    x = ((x >> ((x >> 28u) + 4u)) ^ x) * 277803737u;
    return (x >> 22u) ^ x;
}

uint randomWord(uint a, uint b, uint c) { return scramble(a ^ scramble(b ^ scramble(c))); }

/// In [0, 1).
float randomUnit(uint a, uint b, uint c) { return float(randomWord(a, b, c) >> 8u) * (1.0 / 16777216.0); }
