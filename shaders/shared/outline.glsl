// SPDX-License-Identifier: Apache-2.0
// What outlines are asked, edge by edge: they lie in different buffers.

/// Whether the ray from a place to the right goes over an edge: inside are the places whose rays go over an odd number.
bool rayGoesOver(vec2 a, vec2 b, vec2 place) {
    return (a.y > place.y) != (b.y > place.y) && place.x < (b.x - a.x) * (place.y - a.y) / (b.y - a.y) + a.x;
}

/// m.
float distanceToEdge(vec2 place, vec2 a, vec2 b) {
    vec2 axis = b - a;
    float along = clamp(dot(place - a, axis) / max(dot(axis, axis), 1.0e-12), 0.0, 1.0);
    return distance(place, a + along * axis);
}
