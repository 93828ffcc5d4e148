// SPDX-License-Identifier: Apache-2.0
// How fast somebody closes up to those before it on a belt, who is on it or about to step on
// (shaders/motion/riding.glsl).
// Needs the blocks States, Bodies, Neighbours and NeighbourCounts, and shaders/motion/riding.glsl and among_all.glsl.

/// s: those who are about to step on queue and do not press.
float headwayBeforeBelt(uint flags) {
    bool queues = RIDING_ENABLED && (flags & (WALKER_RIDES | WALKER_IS_CARRIED)) == WALKER_RIDES;
    return queues ? RIDING_QUEUEING : 0.0;
}

/// m/s along the belt: at most `pace`.
float paceOnBelt(Body self, Walker walker, uint slot, float pace) {
    uint flags = walker.flags;
    if ((flags & WALKER_RIDES) == 0u) return pace;
    // `rest` has the shift of its chart (shaders/charts/way_between.glsl).
    Ride ride = rideOn(beltOf(flags), (flags & WALKER_IS_CARRIED) != 0u, self.position - states[self.row].rest);
    if (ride.on && stepsOff(ride)) return pace;
    vec2 forward = belts[ride.chart].along;
    float to_lane = laneOf(ride, walksOnBelt(ride, partyFirstOf(walker, self.row))) - ride.aside;
    for (uint i = 0u; i < neighbour_counts[slot]; ++i) {
        uint key = neighbourKey(slot, i);
        if ((key & NEIGHBOUR_IS_WALL) != 0u) continue;
        vec2 offset = bodies[key].position - self.position;
        float ahead = dot(offset, forward), aside = forward.x * offset.y - forward.y * offset.x;
        float its_along = ride.along + ahead;
        // It is in one's way, or where one is going over to.
        bool beside = min(abs(aside), abs(aside - to_lane)) > RIDING_BESIDE;
        if (ahead <= 0.0 || beside || its_along < 0.0 || its_along > belts[ride.chart].length) continue;
        float room = ahead - RIDING_SPACING;
        float closing = min(room / RIDING_SETTLING, sqrt(2.0 * RIDING_BRAKING * max(room, 0.0)));
        pace = min(pace, max(dot(bodies[key].velocity, forward) + closing, 0.0));
    }
    return pace;
}

/// A wish that goes along the belt no faster than that; going over to one's side is free.
vec2 keepingBehind(uint flags, vec2 wish, float pace) {
    if ((flags & WALKER_RIDES) == 0u) return wish;
    vec2 forward = belts[beltOf(flags)].along;
    return wish - forward * max(dot(wish, forward) - pace, 0.0);
}
