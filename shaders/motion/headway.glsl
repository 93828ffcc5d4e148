// SPDX-License-Identifier: Apache-2.0
// Headway, for those who are given one (`people.headway`): walking behind somebody takes room to step. The free way
// ahead is to last for one's headway; whatever is left of it, one creeps (Tordeux, Chraibi and Seyfried 2016, equation
// 2, with the free way between discs). Crowds that walk one way then slow down with their density as people's do
// (Weidmann 1993). Who follows looks for a way past at the speed it would like, and does not hurry for those behind.
// Needs shaders/motion/walking_behind.glsl.
#include "shaders/shared/walker.glsl"

/// s; 0 = presses on.
float headwayOf(Walker walker) { return HEADWAY_ENABLED ? ownHeadwayOf(walker) : 0.0; }

/// m/s: how fast one walks behind one other person, at most `speed`.
/// @param offset from oneself to the other, m
float paceBehind(vec2 way, float speed, float headway, vec2 offset, float reach, vec2 wish) {
    // Of two who make for the same door, one is ahead: the other follows, and they do not wait for each other.
    float size = length(wish);
    if (size <= STANDING_SPEED || dot(offset, way + wish / size) <= 0.0) return speed;
    float ahead = dot(offset, way);
    float aside_squared = max(dot(offset, offset) - ahead * ahead, 0.0);
    if (ahead <= 0.0 || aside_squared >= HEADWAY_STRAIGHT_AHEAD * HEADWAY_STRAIGHT_AHEAD * reach * reach) return speed;
    float free = ahead - sqrt(reach * reach - aside_squared);
    return mix(speed, clamp(free / headway, min(HEADWAY_SLOWEST, speed), speed), followed(likeness(way, wish)));
}

/// How little those ahead hold somebody up, 0 to 1, by its pace over the speed it would like.
float freedomAt(float pace_share) { return smoothstep(HEADWAY_FREEDOM_BEGINS, 1.0, pace_share); }
