// SPDX-License-Identifier: Apache-2.0
// Who is carried off stands fast: somebody who is moved across its own way, or back along it, weighs more than others
// in the first rounds of contact (unequal masses in position-based dynamics: Mueller et al. 2007). A platoon would
// carry whoever it has caught along for its whole length; who stands fast is passed on both sides instead, as a post
// would be.

/// How hard somebody is to move out of the way, in the rounds that know weights.
float weightAgainst(vec2 wish, vec2 velocity) {
    float speed = length(wish);
    if (!STANDING_FAST_ENABLED || speed <= STANDING_SPEED) return 1.0;
    vec2 way = wish / speed;
    vec2 astray = velocity - way * max(dot(velocity, way), 0.0);
    return 1.0 + STANDING_FAST_WEIGHT *
                     smoothstep(STANDING_FAST_CARRIED, STANDING_FAST_SWEPT_AWAY, length(astray));
}
