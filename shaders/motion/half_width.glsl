// SPDX-License-Identifier: Apache-2.0
// How broad a body is, seen from a direction: what rules that look ahead mean by its radius.
// Needs the blocks Bodies and Walkers, and shaders/shared/body_shape.glsl.

/// m.
/// @param direction of unit length
float halfWidth(Body body, uint slot, vec2 direction) {
#ifdef BODIES
    vec2 axis = vec2(walkers[slot].axis_x, walkers[slot].axis_y);
    return thicknessOf(body.radius, axis) + abs(dot(axis, direction));
#else
    return body.radius;
#endif
}

#ifdef BODIES
vec2 axis_of_self = vec2(0.0);  // as in the walker of the invocation's own slot: looked up once
#endif

/// m: the same of oneself.
float halfWidthOfSelf(Body self, vec2 direction) {
#ifdef BODIES
    return thicknessOf(self.radius, axis_of_self) + abs(dot(axis_of_self, direction));
#else
    return self.radius;
#endif
}

/// m: how far apart the middles of oneself and another are who touch each other along the line between them.
float reachBetween(Body self, Body other, uint other_slot) {
#ifdef BODIES
    vec2 offset = self.position - other.position;
    vec2 direction = offset / max(length(offset), 1.0e-6);
    return halfWidthOfSelf(self, direction) + halfWidth(other, other_slot, direction);
#else
    return self.radius + other.radius;
#endif
}
