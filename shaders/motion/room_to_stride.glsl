// SPDX-License-Identifier: Apache-2.0
// Room to stride, for those who have a body (`people.body`) and were given no headway. A body is as deep as a chest,
// and who is as near to the one ahead as that allows cannot walk: legs take room that a body does not. So where
// everybody whom one senses goes one's way, one follows whoever is before one's own breadth at a headway (equation 2 of
// Tordeux, Chraibi and Seyfried 2016), by the true extents of both bodies: depth along the way, breadth across it. Who
// draws away is followed sooner, by the way that it gains: through a door people go as those before them walk off, not
// when they are gone. Who strides so does not press, and needs no turns (shaders/motion/taking_turns.glsl).
//
// Where streams meet nobody strides: a headway there only gives room away to those who come across.
// Needs shaders/motion/walking_behind.glsl and headway.glsl, and shaders/shared/body_shape.glsl.

#ifdef BODIES

/// m/s: how fast one walks behind one other person, at most `speed`.
/// @param extents m: how far apart the middles of both are that touch, one right behind the other, and side by side
/// @param gains m/s: by how much the other is faster
float paceStriding(vec2 way, float speed, vec2 offset, vec2 extents, vec2 gains, vec2 wish, float alike) {
    float ahead = dot(offset, way);
    float aside = (way.x * offset.y - way.y * offset.x) / extents.y;
    bool leads = ahead > 0.0 && dot(offset, way + wish / max(length(wish), STANDING_SPEED)) > 0.0;
    if (!leads || abs(aside) >= HEADWAY_STRAIGHT_AHEAD) return speed;
    float free = ahead - extents.x * sqrt(1.0 - aside * aside) - ROOM_TO_STRIDE_GAP;
    free += ROOM_TO_STRIDE_DRAWING_AWAY * dot(gains, way);
    return mix(speed, clamp(free / ROOM_TO_STRIDE_HEADWAY, 0.0, speed), followed(alike));
}

/// m: how far a body reaches along a way, and across it.
vec2 extentsAlong(vec2 way, float radius, vec2 axis) {
    return thicknessOf(radius, axis) + abs(vec2(dot(axis, way), crossOf(axis, way)));
}

#endif
