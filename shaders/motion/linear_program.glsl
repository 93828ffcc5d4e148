// SPDX-License-Identifier: Apache-2.0
// The smallest change to a wish that obeys a set of half-planes: a linear program in the plane.
//
// A constraint (n.x, n.y, c) allows the velocities v with n . v >= c, n of unit length. The best allowed point either is
// the wish itself or lies on some constraint's line; adding constraints one by one (Seidel 1991; de Berg et al.,
// Computational Geometry, chapter 4) means that only when the newest one is violated does the optimum move, and then it
// lies on the newest line: a search in one dimension, between the bounds that the earlier constraints leave. All of it
// happens inside the disc of speeds the person is capable of.
//
// In a crush no velocity satisfies everybody. Then the constraints of people give way, all by the same least amount
// (van den Berg et al. 2011, section 5.3), while those of walls, which come first, do not. "Constraint i is violated most,
// and j no more than i" is again a half-plane, (n_j - n_i) . v >= c_j - c_i, so the same solver does it.
//
// constraints[0 .. CONSTRAINT_CAPACITY) are the real ones; the second half of the array is the relaxation's scratch.
// Needs shaders/shared/at_most.glsl.

const float PARALLEL = 1.0e-5;
vec3 constraints[2 * CONSTRAINT_CAPACITY];

/// Written through here, so that compilers see a write before the first read and do not warn.
void setConstraint(int index, vec3 constraint) { constraints[index] = constraint; }

/// The optimum on the line of constraint `base + index`, given the constraints base .. base + index - 1.
/// @param furthest go as far along `wish` as allowed instead of as near to it
bool solveOnLine(int base, int index, float limit, vec2 wish, bool furthest, inout vec2 velocity) {
    vec3 line = constraints[base + index];
    float half_chord_squared = limit * limit - line.z * line.z;
    if (half_chord_squared < 0.0) return false;
    float upper = sqrt(half_chord_squared);
    float lower = -upper;
    vec2 point = line.xy * line.z;
    vec2 along = vec2(-line.y, line.x);
    for (int i = base; i < base + index; ++i) {
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
int solveInDisc(int base, int count, float limit, vec2 wish, bool furthest, out vec2 velocity) {
    velocity = furthest ? wish * limit : atMost(wish, limit);
    for (int i = 0; i < count; ++i) {
        vec3 line = constraints[base + i];
        if (dot(line.xy, velocity) >= line.z) continue;
        vec2 before = velocity;
        if (!solveOnLine(base, i, limit, wish, furthest, velocity)) {
            velocity = before;
            return i;
        }
    }
    return count;
}

/// Makes the worst violation as small as can be. The first `hard` constraints do not give way.
void relax(int hard, int first_violated, int count, float limit, inout vec2 velocity) {
    float worst = 0.0;
    for (int i = max(first_violated, hard); i < count; ++i) {
        vec3 line = constraints[i];
        if (line.z - dot(line.xy, velocity) <= worst) continue;
        int projected = 0;
        for (int j = 0; j < hard; ++j) setConstraint(CONSTRAINT_CAPACITY + projected++, constraints[j]);
        for (int j = hard; j < i; ++j) {
            vec2 normal = constraints[j].xy - line.xy;
            float size = length(normal);
            // The same direction: one of the two always is the worse, and the worse one is i.
            if (size <= PARALLEL) continue;
            setConstraint(CONSTRAINT_CAPACITY + projected++, vec3(normal, constraints[j].z - line.z) / size);
        }
        vec2 relaxed;
        if (solveInDisc(CONSTRAINT_CAPACITY, projected, limit, line.xy, true, relaxed) == projected) velocity = relaxed;
        worst = max(worst, line.z - dot(line.xy, velocity));
    }
}
