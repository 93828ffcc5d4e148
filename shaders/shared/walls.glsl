// SPDX-License-Identifier: Apache-2.0
// Walls are chains of capsules; everything about them starts from the nearest point of a segment's axis.

#include "shaders/shared/snap.glsl"

/// Where along a-b (0 to 1) the point nearest to `position` lies.
float alongSegment(vec2 position, vec2 a, vec2 b) {
    vec2 axis = b - a;
    float length_squared = dot(axis, axis);
    return length_squared > 0.0 ? clamp(dot(position - a, axis) / length_squared, 0.0, 1.0) : 0.0;
}

vec2 nearestOnSegment(vec2 position, vec2 a, vec2 b) { return a + snapped((b - a) * alongSegment(position, a, b)); }
