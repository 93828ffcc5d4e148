// SPDX-License-Identifier: Apache-2.0
// The smallest change to a wish that obeys a set of half-planes: a linear program in the plane.
//
// A constraint (n.x, n.y, c) allows the velocities v with n . v >= c, n of unit length. The best allowed point either
// is the wish itself or lies on some constraint's line; adding constraints one by one (Seidel 1991; de Berg et al.,
// Computational Geometry, chapter 4) means that only when the newest one is violated does the optimum move, and then it
// lies on the newest line: a search in one dimension, between the bounds that the earlier constraints leave. All of it
// happens inside the disc of speeds the person is capable of.
//
// The last constraint may be one that gives way. Where the others leave no velocity that obeys it, the best is as far
// on its side as they allow: the same search, along its normal instead of near the wish.
// Needs CONSTRAINT_CAPACITY and shaders/shared/at_most.glsl.

const float PARALLEL = 1.0e-5;
vec3 constraints[CONSTRAINT_CAPACITY];

/// Written through here, so that compilers see a write before the first read and do not warn.
void setConstraint(int index, vec3 constraint) { constraints[index] = constraint; }

/// The optimum on the line of constraint `index`, given the constraints before it.
/// @param furthest go as far along `wish` as allowed instead of as near to it
bool solveOnLine(int index, float limit, vec2 wish, bool furthest, inout vec2 velocity) {
    vec3 line = constraints[index];
    float half_chord_squared = limit * limit - line.z * line.z;
    if (half_chord_squared < 0.0) return false;
    float upper = sqrt(half_chord_squared);
    float lower = -upper;
    vec2 point = line.xy * line.z;
    vec2 along = vec2(-line.y, line.x);
    for (int i = 0; i < index; ++i) {
        float slope = dot(constraints[i].xy, along);
        float bound = constraints[i].z - dot(constraints[i].xy, point);
        if (abs(slope) <= PARALLEL) {
            if (bound > PARALLEL) return false;
        } else if (slope > 0.0) {
            lower = max(lower, bound / slope);
        } else {
            upper = min(upper, bound / slope);
        }
        if (lower > upper) return false;
    }
    float wished = dot(wish, along);
    float at = furthest ? (wished > 0.0 ? upper : lower) : clamp(wished, lower, upper);
    velocity = point + along * at;
    return true;
}

/// @returns how many constraints could be obeyed, in order; `count` when all
int solveInDisc(int count, float limit, vec2 wish, bool furthest, out vec2 velocity) {
    velocity = furthest ? wish * limit : atMost(wish, limit);
    for (int i = 0; i < count; ++i) {
        vec3 line = constraints[i];
        if (dot(line.xy, velocity) >= line.z) continue;
        vec2 before = velocity;
        if (!solveOnLine(i, limit, wish, furthest, velocity)) {
            velocity = before;
            return i;
        }
    }
    return count;
}

/// The velocity nearest to the wish. Of the constraints, the first `hard` ones do not give way, and one more may
/// follow.
vec2 nearestAllowed(int hard, int count, float limit, vec2 wish) {
    vec2 velocity;
    int obeyed = solveInDisc(count, limit, wish, false, velocity);
    if (obeyed == count || hard == count) return velocity;
    vec3 soft = constraints[hard];
    if (soft.z - dot(soft.xy, velocity) <= 0.0) return velocity;
    vec2 furthest;
    return solveInDisc(hard, limit, soft.xy, true, furthest) == hard ? furthest : velocity;
}
