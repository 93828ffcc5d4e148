// SPDX-License-Identifier: Apache-2.0
// Cushion: nobody walks into anybody. Closing speeds that would use up the gap within a quarter of a second are taken
// back, half by each of the two, at a rate that leaves little for the hard contact to stop at once. It fades with
// patience: a cushion that the impatient keep leaves some of a crossing's people behind.

/// m/s^2.
/// @param offset from the other to oneself, m
/// @param relative one's own velocity less the other's, m/s
vec2 cushion(vec2 offset, vec2 relative, float reach, float patience) {
    if (!CUSHION_ENABLED) return vec2(0.0);
    float distance = max(length(offset), 1.0e-3);
    float closing = -dot(offset, relative) / distance;
    float excess = closing - max(distance - reach, 0.0) / CUSHION_TIME;
    return (excess > 0.0 ? offset * (excess * CUSHION_RATE / distance) : vec2(0.0)) * patience;
}
