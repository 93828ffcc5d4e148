// SPDX-License-Identifier: Apache-2.0
// The velocity nearest to the wished one that avoids everybody sensed, within what legs can do.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) readonly buffer People { Person people[]; };
layout(std430) readonly buffer Bodies { Body bodies[]; };
layout(std430) readonly buffer PreferredVelocities { vec2 preferred_velocities[]; };
layout(std430) readonly buffer Neighbours { uint neighbours[]; };
layout(std430) readonly buffer NeighbourCounts { uint neighbour_counts[]; };
layout(std430) readonly buffer RowSlots { uint row_slots[]; };
layout(std430) readonly buffer TouchWords { uint touch_words[]; };
layout(std430) readonly buffer WallSegments { WallSegment wall_segments[]; };
layout(std430) readonly buffer WallStarts { uint wall_starts[]; };
layout(std430) readonly buffer WallItems { uint wall_items[]; };
layout(std430) readonly buffer RoadDistances { float road_distances[]; };
layout(std430) writeonly buffer Targets { vec2 targets[]; };  // where each person will be unless bodies touch
layout(std430) writeonly buffer TargetsAfter { vec2 targets_after[]; };  // the same, for those whom contact passes over
uniform uint slot_capacity;

// Room for the sensed people, the nearest walls, and the kerb.
#define CONSTRAINT_CAPACITY (NEIGHBOURS + int(WALL_CONSTRAINTS) + 1)
#include "shaders/cells.glsl"
#include "shaders/walls.glsl"
#include "shaders/orca.glsl"
#include "shaders/linear_program.glsl"

vec2 facing(uint slot) { return preferred_velocities[slot]; }
#include "shaders/oncoming.glsl"

/// Overlapping bodies are to part within this time (s); the contact pass separates them in any case.
const float OVERLAP_HORIZON = 0.15;
const float KERB_HORIZON = 0.8;

/// A wall's face allows no more speed towards it than reaches it at the horizon; its ends are avoided like a post.
vec3 wallConstraint(Body self, WallSegment wall) {
    float along = alongSegment(self.position, wall.a, wall.b);
    vec2 offset = mix(wall.a, wall.b, along) - self.position;
    float reach = self.radius + wall.half_thickness;
    if (along <= 0.0 || along >= 1.0)
        return avoidanceConstraint(self.velocity, offset, self.velocity, reach, parameters.wall_time_horizon,
                                   OVERLAP_HORIZON, 1.0);
    float size = length(offset);
    vec2 normal = size > 1.0e-6 ? -offset / size : normalize(vec2(wall.a.y - wall.b.y, wall.b.x - wall.a.x));
    float gap = size - reach;
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

/// Looking far ahead is courteous, and in a dense counterflow everybody's courtesy adds up to a standstill: no velocity
/// avoids all that might happen in the next seconds. Who is held up by oncoming people looks ahead this far only (s), as
/// people do who squeeze through; what then comes too near, contact keeps apart.
const float SQUEEZING_HORIZON = 0.2;

/// s: how far ahead somebody avoids other people.
float horizonOf(Body self, uint slot) {
    vec2 wish = preferred_velocities[slot];
    float speed = length(wish);
    if (speed < 1.0e-3) return parameters.time_horizon;
    float progress = min(max(dot(self.velocity, wish) / (speed * speed), 0.0) / GETTING_ON, 1.0);
    if (progress == 1.0) return parameters.time_horizon;
    float held_up = 1.0 - progress * progress * progress;
    return mix(parameters.time_horizon, SQUEEZING_HORIZON, held_up * oncomingTraffic(slot, wish / speed));
}

vec2 limitChange(vec2 from, vec2 to, float most) {
    vec2 change = to - from;
    float size = length(change);
    return size > most ? from + change * (most / size) : to;
}

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= live_count) return;
    Body self = bodies[slot];
    bool walls = (touch_words[slot] & (TOUCH_WALL_NEAR | TOUCH_WALL_SENSED)) != 0u;
    int hard = walls ? gatherWalls(self, slot) : 0;
    int count = hard;
    float horizon = horizonOf(self, slot);
    uint sensed = neighbour_counts[slot];
    for (uint i = 0u; i < sensed; ++i) {
        uint key = neighbours[i * slot_capacity + slot];
        if ((key & NEIGHBOUR_IS_WALL) != 0u) continue;
        Body other = bodies[row_slots[key]];
        setConstraint(count++, avoidanceConstraint(self.velocity, other.position - self.position,
                                                   self.velocity - other.velocity, self.radius + other.radius,
                                                   horizon, OVERLAP_HORIZON, 0.5));
    }
    vec3 kerb;
    if (parameters.has_roads != 0u && (people[self.row].flags & PERSON_KEEPS_TO_ROADS) != 0u && kerbConstraint(self, kerb))
        setConstraint(count++, kerb);

    vec2 velocity;
    int obeyed = solveInDisc(0, count, self.maximum_speed, preferred_velocities[slot], false, velocity);
    if (obeyed < count) relax(hard, obeyed, count, self.maximum_speed, velocity);

    velocity = limitChange(self.velocity, velocity, parameters.maximum_acceleration * parameters.step_seconds);
    vec2 target = self.position + velocity * parameters.step_seconds;
    targets[slot] = target;
    targets_after[slot] = target;
}
