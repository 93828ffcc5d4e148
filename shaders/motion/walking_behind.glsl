// SPDX-License-Identifier: Apache-2.0
// Who walks behind whom: what several rules mean by it.

/// The cosine between one's own way and another's wish; -1 for whoever stands, and is walked around.
float likeness(vec2 way, vec2 wish) {
    float size = length(wish);
    return size > STANDING_SPEED ? dot(way, wish) / size : -1.0;
}

/// How much two who want to go this way and that walk behind each other, 0 to 1.
float followed(float alike) { return smoothstep(WALKING_BEHIND_BEGINS, WALKING_BEHIND_COMPLETE, alike); }
