// SPDX-License-Identifier: Apache-2.0
// The next velocity: towards the wished one, making room for everybody sensed, along walls, within what legs can do.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) readonly buffer States { AgentState states[]; };
layout(std430) readonly buffer Bodies { Body bodies[]; };
layout(std430) readonly buffer Walkers { Walker walkers[]; };
layout(std430) readonly buffer PreferredVelocities { vec2 preferred_velocities[]; };
layout(std430) readonly buffer Neighbours { uint neighbours[]; };
layout(std430) readonly buffer NeighbourCounts { uint neighbour_counts[]; };
layout(std430) readonly buffer TouchWords { uint touch_words[]; };
layout(std430) readonly buffer WallSegments { WallSegment wall_segments[]; };
layout(std430) readonly buffer WallStarts { uint wall_starts[]; };
layout(std430) readonly buffer WallItems { uint wall_items[]; };
layout(std430) readonly buffer RoadDistances { float road_distances[]; };
layout(std430) writeonly buffer Targets { vec2 targets[]; };  // where each person will be unless bodies touch
layout(std430) writeonly buffer TargetsAfter { vec2 targets_after[]; };  // the same, for those whom contact passes over
layout(std430) writeonly buffer Paces { float paces[]; };  // m/s: how fast each person wants to walk behind others
uniform uint slot_capacity;

// Room for the nearest walls and the kerb.
#define CONSTRAINT_CAPACITY (int(WALL_CONSTRAINTS) + 1)

#include "shaders/shared/at_most.glsl"
#include "shaders/cells/cells.glsl"
#include "shaders/shared/walls.glsl"
#include "shaders/motion/anticipation.glsl"
#include "shaders/motion/company.glsl"
#include "shaders/motion/feet.glsl"
#include "shaders/motion/linear_program.glsl"

/// Bodies inside walls are to leave them within this time (s); the contact pass takes them out in any case.
const float OVERLAP_HORIZON = 0.15;
const float KERB_HORIZON = 0.8;

/// m: a door exactly as wide as a body touches it on both sides; without this nobody would get over its middle. The contact
/// pass keeps bodies out of walls exactly.
const float WALL_SLACK = 0.001;

/// A wall allows no more speed towards its nearest point than reaches it at the horizon.
vec3 wallConstraint(Body self, WallSegment wall) {
    vec2 offset = nearestOnSegment(self.position, wall.a, wall.b) - self.position;
    float size = length(offset);
    vec2 normal = size > 1.0e-6 ? -offset / size : normalize(vec2(wall.a.y - wall.b.y, wall.b.x - wall.a.x));
    float gap = size - self.radius - wall.half_thickness + WALL_SLACK;
    return vec3(normal, -gap / (gap > 0.0 ? parameters.wall_time_horizon : OVERLAP_HORIZON));
}

float wallDistance(Body self, uint segment) {
    WallSegment wall = wall_segments[segment];
    return length(nearestOnSegment(self.position, wall.a, wall.b) - self.position) - wall.half_thickness;
}

/// The walls near by, exactly, and then those seen further ahead; the nearest WALL_CONSTRAINTS of them.
int gatherWalls(Body self, uint slot) {
    uint kept[WALL_CONSTRAINTS];
    float distances[WALL_CONSTRAINTS];
    int count = 0;
    uint cell = cellIndex(cellOf(self.position));
    uint first = wall_starts[cell];
    uint near_by = wall_starts[cell + 1u] - first;
    uint sensed = neighbour_counts[slot];
    for (uint i = 0u; i < near_by + sensed; ++i) {
        uint segment;
        if (i < near_by) {
            segment = wall_items[first + i];
        } else {
            uint key = neighbours[(i - near_by) * slot_capacity + slot];
            if ((key & NEIGHBOUR_IS_WALL) == 0u) continue;
            segment = key & ~NEIGHBOUR_IS_WALL;
        }
        float gap = wallDistance(self, segment);
        if (i < near_by ? gap > parameters.contact_range : gap <= parameters.contact_range) continue;
        int at = count < int(WALL_CONSTRAINTS) ? count++ : int(WALL_CONSTRAINTS);
        if (at == int(WALL_CONSTRAINTS)) {
            at = 0;
            for (int j = 1; j < count; ++j) at = distances[j] > distances[at] ? j : at;
            if (distances[at] <= gap) continue;
        }
        kept[at] = segment;
        distances[at] = gap;
    }
    for (int i = 0; i < count; ++i) setConstraint(i, wallConstraint(self, wall_segments[kept[i]]));
    return count;
}

float roadDistance(uvec2 cell) { return road_distances[cell.y * parameters.grid_width + cell.x]; }

/// The kerb: like a wall's face, along the gradient of the distance to the roads' edge.
bool kerbConstraint(Body self, out vec3 constraint) {
    vec2 size = vec2(parameters.grid_width, parameters.grid_height);
    vec2 at = clamp((self.position - parameters.grid_minimum) / parameters.grid_cell - 0.5, vec2(0.0), size - 1.001);
    uvec2 cell = uvec2(at);
    vec2 f = at - vec2(cell);
    float d00 = roadDistance(cell), d10 = roadDistance(cell + uvec2(1u, 0u));
    float d01 = roadDistance(cell + uvec2(0u, 1u)), d11 = roadDistance(cell + uvec2(1u, 1u));
    float inside = mix(mix(d00, d10, f.x), mix(d01, d11, f.x), f.y);
    vec2 gradient = vec2(mix(d10 - d00, d11 - d01, f.y), mix(d01 - d00, d11 - d10, f.x));
    float slope = length(gradient);
    if (inside > 2.0 || slope < 1.0e-6) return false;
    float gap = inside - self.radius;
    // Those pushed off the road come back at a stroll: nothing hard is there.
    constraint = vec3(gradient / slope, min(-gap / KERB_HORIZON, 0.5));
    return true;
}

/// s: legs bring the velocity towards the wished one with this time constant (0.5 s: Helbing and Molnar 1995).
const float RELAXATION = 0.5;
/// m/s^2: and speed up no faster than this. Walkers set off at about 1 m/s^2; it also bounds how hard a crowd presses.
const float MOST_DRIVE = 1.0;

vec2 drive(vec2 wish, vec2 velocity) {
    return atMost((wish - velocity) / RELAXATION, MOST_DRIVE);
}

/// m/s: how fast one wants to walk behind those ahead.
float paceAmongAll(Body self, uint slot, vec2 way, float speed, float headway) {
    if (headway <= LEAST_HEADWAY) return speed;
    float pace = speed;
    for (uint i = 0u; i < neighbour_counts[slot]; ++i) {
        uint key = neighbours[i * slot_capacity + slot];
        if ((key & NEIGHBOUR_IS_WALL) != 0u) continue;
        Body other = bodies[key];
        pace = min(pace, paceBehind(way, speed, headway, other.position - self.position, self.radius + other.radius,
                                    preferred_velocities[key]));
    }
    return pace;
}

/// m/s^2: the room made for all people sensed together.
/// @param in_peace receives whether all of them go one's way
/// @param in_traffic receives whether any of them goes anywhere
vec2 roomForAll(Body self, uint slot, vec2 wish, Manners manners, out bool in_peace, out bool in_traffic) {
    vec2 room = vec2(0.0);
    in_peace = true;
    in_traffic = false;
    for (uint i = 0u; i < neighbour_counts[slot]; ++i) {
        uint key = neighbours[i * slot_capacity + slot];
        if ((key & NEIGHBOUR_IS_WALL) != 0u) continue;
        Body other = bodies[key];
        vec2 its_wish = preferred_velocities[key];
        room += roomFor(manners, self.position - other.position, self.velocity - other.velocity, wish - other.velocity,
                        self.radius + other.radius, its_wish);
        in_peace = in_peace && followed(likeness(manners.way, its_wish)) > 0.0;
        in_traffic = in_traffic || length(its_wish) > STANDING_SPEED;
    }
    return room;
}

/// Who stands somewhere is walked around, and makes this share of the room that somebody under way would make.
const float ROOM_OF_THE_STANDING = 0.4;

vec2 limitChange(vec2 from, vec2 to, float most) {
    vec2 change = to - from;
    float size = length(change);
    return size > most ? from + change * (most / size) : to;
}

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= live_count) return;
    Body self = bodies[slot];
    Walker walker = walkers[slot];
    bool walls = (touch_words[slot] & (TOUCH_WALL_NEAR | TOUCH_WALL_SENSED)) != 0u;
    int hard = walls ? gatherWalls(self, slot) : 0;
    int count = hard;
    vec3 kerb;
    if (parameters.has_roads != 0u && (walker.flags & PERSON_KEEPS_TO_ROADS) != 0u && kerbConstraint(self, kerb))
        setConstraint(count++, kerb);

    vec2 wish = preferred_velocities[slot];
    float speed = length(wish);
    vec2 way = speed > STANDING_SPEED ? wish / speed : vec2(cos(self.heading), sin(self.heading));
    float impatience = impatienceOf(walker.nervousness);
    // Manners depend on the pace of those with a headway of their own only; for the others one look at everybody will do.
    float pace = paceAmongAll(self, slot, way, speed, walker.headway);
    Manners manners = mannersOf(way, impatience, neighbour_counts[slot], walker.headway, pace / max(speed, STANDING_SPEED));
    bool in_peace, in_traffic;
    vec2 room = roomForAll(self, slot, wish, manners, in_peace, in_traffic);
    if (in_peace && walker.headway <= 0.0) pace = paceAmongAll(self, slot, way, speed, HEADWAY_IN_PEACE * (1.0 - impatience));
    paces[slot] = pace;
    vec2 acceleration = drive(pace < speed ? wish * (pace / speed) : wish, self.velocity) +
                        room * (speed > STANDING_SPEED ? 1.0 : ROOM_OF_THE_STANDING);
    if (walker.party_size > 1u && speed > STANDING_SPEED)
        acceleration += company(self, walker.party_first, walker.party_size, way) * smoothstep(0.0, 0.7, speed / walker.preferred_speed);
    vec2 wanted = self.velocity + acceleration * parameters.step_seconds;
    vec2 legs = self.velocity;  // what they start from
    if (in_traffic && isUnderWay(walker)) plantFeet(self, in_peace && walker.headway > 0.0, wanted, legs);
    vec2 velocity;
    int obeyed = solveInDisc(0, count, self.maximum_speed, wanted, false, velocity);
    if (obeyed < count) relax(hard, obeyed, count, self.maximum_speed, velocity);

    velocity = limitChange(legs, velocity, parameters.maximum_acceleration * parameters.step_seconds);
    vec2 target = self.position + velocity * parameters.step_seconds;
    targets[slot] = target;
    targets_after[slot] = target;
}
