// SPDX-License-Identifier: Apache-2.0
// The rules about one other person, over everybody sensed.
// Needs the blocks Bodies, Neighbours, NeighbourCounts, PreferredVelocities, the uniform slot_capacity, and
// shaders/motion/half_width.glsl.
#include "shaders/motion/room.glsl"
#include "shaders/motion/headway_in_peace.glsl"

uint neighbourKey(uint slot, uint nth) { return neighbours[nth * slot_capacity + slot]; }

/// m/s: how fast one wants to walk behind those ahead.
float paceAmongAll(Body self, uint slot, vec2 way, float speed, float headway) {
    if (headway <= HEADWAY_LEAST) return speed;
    float pace = speed;
    for (uint i = 0u; i < neighbour_counts[slot]; ++i) {
        uint key = neighbourKey(slot, i);
        if ((key & NEIGHBOUR_IS_WALL) != 0u) continue;
        Body other = bodies[key];
        pace = min(pace, paceBehind(way, speed, headway, other.position - self.position,
                                    reachBetween(self, slot, other, key), preferred_velocities[key]));
    }
    return pace;
}

/// What somebody learns of those it senses.
struct Surroundings {
    vec2 room;        // m/s^2: made for all of them together
    bool in_peace;    // all of them go one's way
    bool in_traffic;  // some of them go anywhere
};

Surroundings lookAround(Body self, uint slot, vec2 wish, Manners manners) {
    Surroundings around = Surroundings(vec2(0.0), true, false);
    for (uint i = 0u; i < neighbour_counts[slot]; ++i) {
        uint key = neighbourKey(slot, i);
        if ((key & NEIGHBOUR_IS_WALL) != 0u) continue;
        Body other = bodies[key];
        vec2 its_wish = preferred_velocities[key];
        around.room += roomFor(manners, self.position - other.position, self.velocity - other.velocity,
                               wish - other.velocity, reachBetween(self, slot, other, key), its_wish);
        around.in_peace = around.in_peace && isPeaceful(likeness(manners.way, its_wish));
        around.in_traffic = around.in_traffic || length(its_wish) > STANDING_SPEED;
    }
    return around;
}
