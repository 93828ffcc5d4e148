// SPDX-License-Identifier: Apache-2.0

/// Squared distance in pixels, from the centre of `pixel`. Kept free of contraction: the distance pass, the site pass
/// and the reference on the CPU have to agree to the last bit.
float squaredDistance(vec2 position, ivec2 pixel) {
    precise vec2 offset = position - (vec2(pixel) + 0.5);
    precise float squared = offset.x * offset.x + offset.y * offset.y;
    return squared;
}

float squaredRadius(float radius) {
    precise float squared = radius * radius;
    return squared;
}
