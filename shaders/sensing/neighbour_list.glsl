// SPDX-License-Identifier: Apache-2.0
// What all ways to perceive others share: the sorted list of the nearest, the exact query within the contact range, and
// what is left for the passes that follow.

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer Bodies { Body bodies[]; };
layout(std430) readonly buffer WallSegments { WallSegment wall_segments[]; };
layout(std430) readonly buffer WallStarts { uint wall_starts[]; };
layout(std430) readonly buffer NarrowCells { uint narrow_cells[]; };  // a bit each
layout(std430) writeonly buffer Neighbours { uint neighbours[]; };
layout(std430) writeonly buffer NeighbourCounts { uint neighbour_counts[]; };
layout(std430) writeonly buffer TouchWords { uint touch_words[]; };
layout(std430) writeonly buffer TouchLists { uint touch_lists[]; };  // TOUCH_WORDS each
layout(std430) buffer TouchDispatch { uint touch_groups[3]; uint touch_count; };
layout(std430) writeonly buffer TouchSlots { uint touch_slots[]; };  // those whom the contact pass has to look at
uniform uint slot_capacity;

#include "shaders/cells/cells.glsl"
#include "shaders/cells/walls_near.glsl"
#include "shaders/cells/cell_runs.glsl"
#include "shaders/shared/walls.glsl"

const float FAR = 1.0e30;
float nearest_distance[NEIGHBOURS];
uint nearest_key[NEIGHBOURS];

bool isKept(uint key) {
    bool kept = false;
    for (int i = 0; i < NEIGHBOURS; ++i) kept = kept || nearest_key[i] == key;
    return kept;
}

/// Keeps the list sorted by (distance, key). The key decides between equals so that the result does not depend on the
/// order of the candidates.
void keepNearest(float distance_squared, uint key) {
    float carried = distance_squared;
    uint carried_key = key;
    for (int i = 0; i < NEIGHBOURS; ++i) {
        bool nearer = carried < nearest_distance[i] || (carried == nearest_distance[i] && carried_key < nearest_key[i]);
        float passed_on = nearer ? nearest_distance[i] : carried;
        uint passed_on_key = nearer ? nearest_key[i] : carried_key;
        nearest_distance[i] = nearer ? carried : nearest_distance[i];
        nearest_key[i] = nearer ? carried_key : nearest_key[i];
        carried = passed_on;
        carried_key = passed_on_key;
    }
}

/// m: how far somebody may have come before the next decision.
float mayMove(Body body) {
    float speed = min(body.maximum_speed, length(body.velocity) + parameters.contact_gain);
    return speed * parameters.decision_seconds + parameters.contact_push;
}

/// Everybody within the contact range, exactly. Those who may touch before the next decision are listed for the contact
/// pass.
/// @returns the touch word
uint feelContacts(Body self, uint self_slot) {
    ivec2 cell = cellOf(self.position);
    uint cell_number = cellIndex(cell);
    uint touching = 0u, two = 0u;
    bool unlisted = false;
    float reach = self.radius + mayMove(self);
    float range_squared = parameters.contact_range * parameters.contact_range;
    for (int y = cell.y - 1; y <= cell.y + 1; ++y) {
        uvec2 run = slotRun(cell.x, y);
        for (uint slot = run.x; slot < run.y; ++slot) {
            vec2 offset = bodies[slot].position - self.position;
            float distance_squared = dot(offset, offset);
            if (distance_squared > range_squared || slot == self_slot) continue;
            keepNearest(distance_squared, slot);
            float touch_distance = reach + bodies[slot].radius + mayMove(bodies[slot]);
            if (distance_squared > touch_distance * touch_distance) continue;
            int after = int(slot - self_slot);
            unlisted = unlisted || after != bitfieldExtract(after, 0, 16);
            two = touching % 2u == 0u ? uint(after) & 0xffffu : two | uint(after) << 16;
            if (touching < TOUCH_CAPACITY) touch_lists[self_slot * TOUCH_WORDS + touching / 2u] = two;
            ++touching;
        }
    }
    bool walls = hasWalls(cell_number);
    bool narrow = (narrow_cells[cell_number / 32u] >> cell_number % 32u & 1u) != 0u;
    return min(touching, TOUCH_COUNT_MASK) | (walls ? TOUCH_WALL_NEAR : 0u) | (narrow ? TOUCH_IN_NARROWS : 0u) |
           (unlisted ? TOUCH_UNLISTED : 0u);
}

void forgetEverybody() {
    for (int i = 0; i < NEIGHBOURS; ++i) {
        nearest_distance[i] = FAR;
        nearest_key[i] = NO_INDEX;
    }
}

/// A wall is one neighbour, however much of it is met.
void weighWall(vec2 position, uint segment) {
    uint key = NEIGHBOUR_IS_WALL | segment;
    if (isKept(key)) return;
    WallSegment wall = wall_segments[segment];
    vec2 offset = nearestOnSegment(position, wall.a, wall.b) - position;
    float gap = max(length(offset) - wall.half_thickness, 0.0);
    keepNearest(gap * gap, key);
}

void publish(uint slot, uint touch_word) {
    uint found = 0u;
    bool wall_found = false;
    for (int i = 0; i < NEIGHBOURS; ++i) {
        bool kept = nearest_distance[i] < FAR;
        if (kept) neighbours[uint(i) * slot_capacity + slot] = nearest_key[i];
        wall_found = wall_found || (kept && (nearest_key[i] & NEIGHBOUR_IS_WALL) != 0u);
        found += kept ? 1u : 0u;
    }
    neighbour_counts[slot] = found;
    touch_words[slot] = touch_word | (wall_found ? TOUCH_WALL_SENSED : 0u);
    // In whatever order: the contact pass writes to each person's own place only.
    if ((touch_word & ~TOUCH_IN_NARROWS) != 0u) {
        uint place = atomicAdd(touch_count, 1u);
        touch_slots[place] = slot;
        if (place % AGENT_GROUP_SIZE == 0u) atomicAdd(touch_groups[0], 1u);
    }
}
