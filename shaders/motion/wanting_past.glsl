// SPDX-License-Identifier: Apache-2.0
// Who wants past somebody that has come to rest (shaders/motion/at_rest.glsl).
// Needs the blocks Bodies, Walkers, Neighbours, NeighbourCounts and PreferredVelocities, and
// shaders/motion/among_all.glsl and under_way.glsl.

/// Somebody under way is held up, all but touches, and wants to go where one stands.
bool somebodyWantsPast(Body self, uint slot) {
    for (uint i = 0u; i < neighbour_counts[slot]; ++i) {
        uint key = neighbourKey(slot, i);
        if ((key & NEIGHBOUR_IS_WALL) != 0u || !isUnderWay(walkers[key])) continue;
        if (walkers[key].nervousness < AT_REST_NOTICES) continue;
        vec2 offset = self.position - bodies[key].position;
        if (dot(offset, preferred_velocities[key]) <= 0.0) continue;
        if (length(offset) < reachBetween(self, bodies[key], key) + AT_REST_GIVES_WAY) return true;
    }
    return false;
}
