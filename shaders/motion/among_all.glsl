// SPDX-License-Identifier: Apache-2.0
// The rules about one other person, over everybody sensed.
// Needs the blocks Bodies, Neighbours, NeighbourCounts, PreferredVelocities, TouchWords, the uniform slot_capacity, and
// shaders/motion/half_width.glsl.
#include "shaders/motion/room.glsl"
#include "shaders/motion/headway_in_peace.glsl"
#include "shaders/motion/room_to_stride.glsl"
#include "shaders/motion/taking_turns.glsl"

uint neighbourKey(uint slot, uint nth) { return neighbours[nth * slot_capacity + slot]; }

/// Somebody may be under way (under_way.glsl) and yet not want to move just now.
bool wantsOn(vec2 wish) { return length(wish) > STANDING_SPEED; }

#ifdef BODIES
/// How somebody with a body walks behind those ahead.
struct Striding {
    float pace;    // m/s
    bool strides;  // it may keep room to stride: all those ahead go its way, or through the same narrow passage
    bool is_met;   // it has a body, and somebody ahead wants to get to where it comes from
};

Striding strideAmongAll(Body self, Walker walker, vec2 way, float speed, uint slot) {
    bool has_body = hasBody(walker);
    Striding found = Striding(speed, ROOM_TO_STRIDE_ENABLED && has_body && speed > STANDING_SPEED, false);
    // Two who stand on both sides of a door walk towards each other first, and yet go one way (climbsInTurn).
    bool is_in_narrows = (touch_words[slot] & TOUCH_IN_NARROWS) != 0u;
    vec2 own = extentsAlong(way, self.radius, axis_of_self);
    for (uint i = 0u; i < neighbour_counts[slot]; ++i) {
        uint key = neighbourKey(slot, i);
        if ((key & NEIGHBOUR_IS_WALL) != 0u) continue;
        Walker other = walkers[key];
        vec2 offset = bodies[key].position - self.position, wish = preferred_velocities[key];
        float alike = likeness(way, wish);
        if (dot(offset, way) > 0.0) {
            found.strides = found.strides && (is_in_narrows || isPeaceful(alike));
            found.is_met = found.is_met || has_body && wantsOn(wish) &&
                                               isOncoming(walker.way_through, other.way_through);
        }
        vec2 extents = own + extentsAlong(way, bodies[key].radius, vec2(other.axis_x, other.axis_y));
        found.pace = min(found.pace, paceStriding(way, speed, offset, extents, self.velocity, bodies[key].velocity,
                                                  wish, alike));
    }
    return found;
}
#endif

/// m/s: how fast one wants to walk behind those ahead, for who keeps a headway.
float paceAmongAll(Body self, uint slot, vec2 way, float speed, float headway) {
#ifdef HEADWAYS
    if (headway <= HEADWAY_LEAST) return speed;
    float pace = speed;
    for (uint i = 0u; i < neighbour_counts[slot]; ++i) {
        uint key = neighbourKey(slot, i);
        if ((key & NEIGHBOUR_IS_WALL) != 0u) continue;
        Body other = bodies[key];
        pace = min(pace, paceBehind(way, speed, headway, other.position - self.position,
                                    reachBetween(self, other, key), preferred_velocities[key]));
    }
    return pace;
#else
    return speed;
#endif
}

/// What somebody learns of those it senses.
struct Surroundings {
    vec2 room;        // m/s^2: made for all of them together
    float pace;       // m/s: how fast one wants to walk behind those ahead, by `headway`
    bool in_peace;    // all of them go one's way
    bool in_traffic;  // some of them go anywhere
};

/// @param headway s: how much of one everybody would keep, if all went the same way
Surroundings lookAround(Body self, uint slot, vec2 wish, float speed, float headway, Manners manners) {
    Surroundings around = Surroundings(vec2(0.0), speed, true, false);
    for (uint i = 0u; i < neighbour_counts[slot]; ++i) {
        uint key = neighbourKey(slot, i);
        if ((key & NEIGHBOUR_IS_WALL) != 0u) continue;
        Body other = bodies[key];
        vec2 its_wish = preferred_velocities[key];
        vec2 offset = self.position - other.position;
        float reach = reachBetween(self, other, key);
        around.room += roomFor(manners, offset, self.velocity - other.velocity, wish - other.velocity, reach, its_wish);
        if (headway > HEADWAY_LEAST)
            around.pace = min(around.pace, paceBehind(manners.way, speed, headway, -offset, reach, its_wish));
        around.in_peace = around.in_peace && isPeaceful(likeness(manners.way, its_wish));
        around.in_traffic = around.in_traffic || wantsOn(its_wish);
    }
    return around;
}
