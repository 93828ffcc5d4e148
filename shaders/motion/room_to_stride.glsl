// SPDX-License-Identifier: Apache-2.0
// Room to stride, for those who have a body (`people.body`) and were given no headway. A body is as deep as a chest,
// and who is as near to the one ahead as that allows cannot walk: legs take room that a body does not. So where
// all ahead whom one senses go one's way, one follows whoever is before one's own breadth, by the true extents of
// both bodies: depth along the way, breadth across it.
//
// A step is as long as the way is free, and the length of people's steps over how many they take is always the same,
// their walk ratio (Sekiya and Nagasaki 1998): so the pace goes with the square of the free way. Half as much room is a
// quarter of the pace, which is how crowds that walk one way slow down (Weidmann 1993).
//
// Who is faster than oneself goes on being so for a while: what its way to a stop would be longer than one's own, by
// speeds squared (Gipps 1981), counts as free. Where all walk at one pace that is nothing, and small unevenness next to
// nothing; at a door, where those before walk off, it is most: people go through as the one before walks off, not when
// it is gone. Who strides so does not press, and needs no turns (shaders/motion/taking_turns.glsl).
//
// Where somebody ahead goes another way nobody strides: room kept there is only given away to those who come across.
// Who has passed disturbs nobody any more.
//
// Where somebody ahead comes the other way (by NEAREST_FIRST_ONCOMING), everybody presses, and would be hurried on
// besides by those of its own stream who come up from behind: each row would drive the one before it through the
// others, faster than people's streams pass each other (Zhang and others 2012). So the more impatient somebody is
// there, the less it hurries.
// Needs shaders/motion/walking_behind.glsl and shaders/shared/body_shape.glsl.

/// 0 to 1: how much one hurries for those who come up from behind.
/// @param is_met somebody ahead comes the other way, and one has a body
float hurryingOf(bool is_met, float impatience) {
    return ROOM_TO_STRIDE_ENABLED && is_met ? mix(1.0, ROOM_TO_STRIDE_HURRYING, impatience) : 1.0;
}

#ifdef BODIES

/// m/s: how fast one walks behind one other person, at most `speed`.
/// @param extents m: how far apart the middles of both are that touch, one right behind the other, and side by side
/// @param own, its m/s: how fast both are
float paceStriding(vec2 way, float speed, vec2 offset, vec2 extents, vec2 own, vec2 its, vec2 wish, float alike) {
    float ahead = dot(offset, way);
    float aside = (way.x * offset.y - way.y * offset.x) / extents.y;
    bool leads = ahead > 0.0 && dot(offset, way + wish / max(length(wish), STANDING_SPEED)) > 0.0;
    if (!leads || abs(aside) >= ROOM_TO_STRIDE_STRAIGHT_AHEAD) return speed;
    float along = max(dot(own, way), 0.0), its_along = max(dot(its, way), 0.0);
    float free = ahead - extents.x * sqrt(1.0 - aside * aside) +
                 ROOM_TO_STRIDE_DRAWING_AWAY * (its_along * its_along - along * along);
    free = max(free, 0.0);
    return mix(speed, min(free * free / ROOM_TO_STRIDE_WALK_RATIO, speed), followed(alike));
}

/// m: how far a body reaches along a way, and across it.
vec2 extentsAlong(vec2 way, float radius, vec2 axis) {
    return thicknessOf(radius, axis) + abs(vec2(dot(axis, way), crossOf(axis, way)));
}

#endif
