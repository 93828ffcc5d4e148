// SPDX-License-Identifier: Apache-2.0

/// The direction in which a body parts from another, of unit length.
vec2 apartDirection(vec2 offset, float size, uint row, uint other_row) {
    if (size > 1.0e-6) return offset / size;
    // Two bodies in exactly the same place part along a direction that both agree on.
    float angle = float((row ^ other_row) % 64u) * 0.098174770;
    return (row < other_row ? 1.0 : -1.0) * vec2(cos(angle), sin(angle));
}
