// SPDX-License-Identifier: Apache-2.0
// Walls ahead: a wall allows no more speed towards its nearest point than reaches it at the horizon. Bodies inside
// walls are to leave them soon; the contact pass takes them out in any case.
// Needs the blocks TouchWords, Neighbours, NeighbourCounts, WallSegments, WallStarts and WallItems,
// shaders/cells/cells.glsl and walls_near.glsl, shaders/shared/walls.glsl, and shaders/motion/linear_program.glsl and
// half_width.glsl.

/// s: in narrow passages people do not slow down for a wall that they will not walk into.
float wallHorizon(bool takes_turns) {
    return takes_turns ? min(parameters.wall_time_horizon, WALLS_AHEAD_IN_NARROWS) : parameters.wall_time_horizon;
}

vec3 wallConstraint(Body self, uint slot, WallSegment wall, float horizon) {
    vec2 offset = nearestOnSegment(self.position, wall.a, wall.b) - self.position;
    float size = length(offset);
    vec2 normal = size > 1.0e-6 ? -offset / size : normalize(vec2(wall.a.y - wall.b.y, wall.b.x - wall.a.x));
    float gap = size - halfWidthOfSelf(self, normal) - wall.half_thickness + WALLS_AHEAD_SLACK;
    return vec3(normal, -gap / (gap > 0.0 ? horizon : WALLS_AHEAD_WAY_OUT));
}

float wallDistance(Body self, uint segment) {
    WallSegment wall = wall_segments[segment];
    return length(nearestOnSegment(self.position, wall.a, wall.b) - self.position) - wall.half_thickness;
}

/// The walls near by, exactly, and then those seen further ahead; the nearest WALL_CONSTRAINTS of them.
int gatherWalls(Body self, Walker walker, uint slot) {
    uint kept[WALL_CONSTRAINTS];
    float distances[WALL_CONSTRAINTS];
    int count = 0;
    uvec2 walls = wallsNear(cellIndex(cellOf(self.position)));
    uint first = walls.x, near_by = walls.y - walls.x;
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
    float horizon = wallHorizon(takesTurns(walker, touch_words[slot]));
    for (int i = 0; i < count; ++i) setConstraint(i, wallConstraint(self, slot, wall_segments[kept[i]], horizon));
    return count;
}

/// Sets the constraints of walls. @returns how many
int wallsAhead(Body self, Walker walker, uint slot) {
    bool walls = (touch_words[slot] & (TOUCH_WALL_NEAR | TOUCH_WALL_SENSED)) != 0u;
    return WALLS_AHEAD_ENABLED && walls ? gatherWalls(self, walker, slot) : 0;
}
