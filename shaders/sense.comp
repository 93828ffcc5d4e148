// SPDX-License-Identifier: Apache-2.0
// What each person perceives: the nearest sites, found by marching rays through the truncated Voronoi diagram
// (De Gyves, Toledo and Rudomin 2013, equations (1) and (2)).
//
// A pixel's owner is the nearest site, so any site whose cell is wider than the gap between samples is met by one of
// them. The samples lie on the rays r_j = a + j b inside the field of view. Inner circles need fewer rays than the outermost
// one for the same gap, so the pattern (sim/sensing_pattern.h) thins them out. Samples only say who is there; distances
// are then taken from the exact positions, and the k nearest are kept.
//
// Crowding cuts cells until samples miss some of them, and nobody sees behind; people still feel who touches them. So
// everybody within the contact range is asked for exactly, whatever the field of view, through the cells.
//
// Candidates are first appended without a branch and then inserted into the sorted list: on wide SIMD units that costs
// half of inserting at every sample, because the lanes stay together.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) readonly buffer Bodies { Body bodies[]; };
layout(std430) readonly buffer CellStarts { uint cell_starts[]; };
layout(std430) readonly buffer RowSlots { uint row_slots[]; };
layout(std430) readonly buffer WallTiles { WallTile wall_tiles[]; };
layout(std430) readonly buffer WallSegments { WallSegment wall_segments[]; };
layout(std430) readonly buffer WallStarts { uint wall_starts[]; };
layout(std430) writeonly buffer Neighbours { uint neighbours[]; };
layout(std430) writeonly buffer NeighbourCounts { uint neighbour_counts[]; };
layout(std430) writeonly buffer TouchWords { uint touch_words[]; };
layout(std430) writeonly buffer TouchLists { uint touch_lists[]; };  // TOUCH_CAPACITY slots each
layout(std430) buffer TouchDispatch { uint touch_groups[3]; uint touch_count; };
layout(std430) writeonly buffer TouchSlots { uint touch_slots[]; };  // those whom the contact pass has to look at
uniform uint slot_capacity;
uniform vec2 pattern[SENSING_SAMPLES];  // m, in the person's own frame: where it looks

#include "shaders/cells.glsl"
#include "shaders/cell_runs.glsl"
#include "shaders/walls.glsl"
#include "shaders/owners.glsl"

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

/// Everybody within the contact range, exactly. Those who may touch within this step are listed for the contact pass.
/// @returns the touch word
uint feelContacts(Body self, uint self_slot) {
    ivec2 cell = cellOf(self.position);
    uint cell_number = cellIndex(cell);
    uint touching = 0u;
    float reach = self.radius + parameters.contact_slack;
    float range_squared = parameters.contact_range * parameters.contact_range;
    for (int y = cell.y - 1; y <= cell.y + 1; ++y) {
        uvec2 run = slotRun(cell.x, y);
        for (uint slot = run.x; slot < run.y; ++slot) {
            vec2 offset = bodies[slot].position - self.position;
            float distance_squared = dot(offset, offset);
            if (distance_squared > range_squared || slot == self_slot) continue;
            keepNearest(distance_squared, bodies[slot].row);
            float touch_distance = reach + bodies[slot].radius;
            if (distance_squared > touch_distance * touch_distance) continue;
            if (touching < TOUCH_CAPACITY) touch_lists[self_slot * TOUCH_CAPACITY + touching] = slot;
            ++touching;
        }
    }
    bool walls = wall_starts[cell_number] != wall_starts[cell_number + 1u];
    return min(touching, TOUCH_COUNT_MASK) | (walls ? TOUCH_WALL_NEAR : 0u);
}

/// Site ids met by the samples, without those met among the last three; at most one per sample. The samples come in the order
/// of their angle, so what lies in one direction is met in one go and few ids come twice.
uint candidates[SENSING_SAMPLES];

int marchRays(Body self) {
    vec2 centre = (self.position - parameters.diagram_minimum) * parameters.pixels_per_metre;
    vec2 forward = vec2(cos(self.heading), sin(self.heading)) * parameters.pixels_per_metre;
    vec2 upper = vec2(parameters.diagram_width, parameters.diagram_height) - 1.0;
    int count = 0;
    uvec3 recent = uvec3(self.row);
    for (int i = 0; i < SENSING_SAMPLES; ++i) {
        vec2 local = pattern[i];
        vec2 pixel = centre + vec2(forward.x * local.x - forward.y * local.y, forward.y * local.x + forward.x * local.y);
        uvec2 at = uvec2(clamp(pixel, vec2(0.0), upper));
        uint owner = ownerAt(at);
        bool fresh = owner != NO_INDEX && owner != self.row && owner != recent.x && owner != recent.y && owner != recent.z;
        candidates[count] = owner;
        count += fresh ? 1 : 0;
        recent = fresh ? uvec3(owner, recent.xy) : recent;
    }
    return count;
}

void weighBody(Body self, uint row) {
    if (isKept(row)) return;
    vec2 offset = bodies[row_slots[row]].position - self.position;
    keepNearest(dot(offset, offset), row);
}

/// A long wall has many tiles and is one neighbour.
void weighWall(Body self, uint tile) {
    uint segment = wall_tiles[tile].segment;
    uint key = NEIGHBOUR_IS_WALL | segment;
    if (isKept(key)) return;
    WallSegment wall = wall_segments[segment];
    vec2 offset = nearestOnSegment(self.position, wall.a, wall.b) - self.position;
    float gap = max(length(offset) - wall.half_thickness, 0.0);
    keepNearest(gap * gap, key);
}

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= live_count) return;
    Body self = bodies[slot];
    for (int i = 0; i < NEIGHBOURS; ++i) {
        nearest_distance[i] = FAR;
        nearest_key[i] = NO_INDEX;
    }
    uint touch_word = feelContacts(self, slot);
    int count = marchRays(self);
    for (int i = 0; i < count; ++i) {
        uint site = candidates[i];
        if (site < parameters.row_count)
            weighBody(self, site);
        else
            weighWall(self, site - parameters.row_count);
    }

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
    if (touch_word != 0u) {
        uint place = atomicAdd(touch_count, 1u);
        touch_slots[place] = slot;
        if (place % AGENT_GROUP_SIZE == 0u) atomicAdd(touch_groups[0], 1u);
    }
}
