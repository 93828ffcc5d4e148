// SPDX-License-Identifier: Apache-2.0
// Who is carried off stands fast: somebody who is moved across its own way, or back along it, weighs more than others
// in the first rounds of contact (unequal masses in position-based dynamics: Mueller et al. 2007). A platoon would
// carry whoever it has caught along for its whole length; who stands fast is passed on both sides instead, as a post
// would be.
// Needs the blocks Bodies and PreferredVelocities.

/// How hard somebody is to move out of the way.
/// @param bracing 1 in the rounds that know weights, 0 in the others
float weightOf(uint slot, float bracing) {
    vec2 wish = preferred_velocities[slot];
    float speed = length(wish);
    if (!STANDING_FAST_ENABLED || bracing <= 0.0 || speed <= STANDING_SPEED) return 1.0;
    vec2 way = wish / speed;
    vec2 velocity = bodies[slot].velocity;
    vec2 astray = velocity - way * max(dot(velocity, way), 0.0);
    return 1.0 + bracing * STANDING_FAST_WEIGHT *
                     smoothstep(STANDING_FAST_CARRIED, STANDING_FAST_SWEPT_AWAY, length(astray));
}
