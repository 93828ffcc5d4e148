// SPDX-License-Identifier: Apache-2.0
// Optimal reciprocal collision avoidance (van den Berg, Guy, Lin and Manocha 2011, section 4).
//
// Seen from A, the relative velocities that lead to a collision with B within the horizon form a cone cut off by a disc:
// the velocity obstacle. u is the shortest way out of it from the present relative velocity; each of the two takes its
// share of u, which leaves the half-plane n . v >= n . (v_A + share u).

/// @param offset from A to B, m
/// @param relative v_A - v_B, m/s
/// @param reach the sum of the radii, m
/// @param share of the way out that A takes: 1/2 among people, 1 against what cannot move
/// @param overlap_horizon s: bodies that already overlap are to part within this time
vec3 avoidanceConstraint(vec2 velocity, vec2 offset, vec2 relative, float reach, float horizon, float overlap_horizon,
                         float share) {
    float distance_squared = dot(offset, offset);
    float reach_squared = reach * reach;
    bool overlapping = distance_squared <= reach_squared;
    float time = overlapping ? overlap_horizon : horizon;
    vec2 from_disc = relative - offset / time;
    float ahead = dot(from_disc, offset);
    float from_disc_squared = dot(from_disc, from_disc);

    vec2 normal;
    float way_out;
    if (overlapping || (ahead < 0.0 && ahead * ahead > reach_squared * from_disc_squared)) {
        float size = sqrt(from_disc_squared);
        normal = size > 1.0e-6 ? from_disc / size : -offset * inversesqrt(max(distance_squared, 1.0e-12));
        way_out = reach / time - size;
    } else {
        // The tangents from the origin to the disc of B; take the one on the side that the relative velocity is on.
        float tangent = sqrt(max(distance_squared - reach_squared, 0.0));
        float side = offset.x * from_disc.y - offset.y * from_disc.x > 0.0 ? 1.0 : -1.0;
        vec2 leg = vec2(offset.x * tangent - side * offset.y * reach, side * offset.x * reach + offset.y * tangent) /
                   distance_squared;
        normal = side * vec2(-leg.y, leg.x);
        way_out = -dot(relative, normal);
    }
    return vec3(normal, dot(normal, velocity) + share * way_out);
}
