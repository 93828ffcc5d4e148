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
layout(std430) readonly buffer Owners { uint owners[]; };
layout(std430) readonly buffer WallTiles { WallTile wall_tiles[]; };
layout(std430) readonly buffer WallSegments { WallSegment wall_segments[]; };
layout(std430) writeonly buffer Neighbours { uint neighbours[]; };
layout(std430) writeonly buffer NeighbourCounts { uint neighbour_counts[]; };
layout(std430) writeonly buffer NearestBodies { float nearest_bodies[]; };  // m, to the nearest other's centre, at most the contact range
uniform uint slot_capacity;
uniform vec2 pattern[SENSING_SAMPLES];  // m, in the person's own frame: where it looks

#include "shaders/cells.glsl"
#include "shaders/cell_runs.glsl"
#include "shaders/walls.glsl"

const float FAR = 1.0e30;
float nearest_distance[NEIGHBOURS];
uint nearest_key[NEIGHBOURS];

/// Keeps the list sorted by (distance, key), each key once. The key decides between equals so that the result does not
/// depend on the order of the candidates.
void keepNearest(float distance_squared, uint key) {
    bool known = false;
    for (int i = 0; i < NEIGHBOURS; ++i) known = known || nearest_key[i] == key;
    float carried = known ? FAR : distance_squared;
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

float feelContacts(Body self) {
    float nearest = parameters.contact_range * parameters.contact_range;
    ivec2 cell = cellOf(self.position);
    float range_squared = parameters.contact_range * parameters.contact_range;
    for (int y = cell.y - 1; y <= cell.y + 1; ++y) {
        uvec2 run = slotRun(cell.x, y);
        for (uint slot = run.x; slot < run.y; ++slot) {
            vec2 offset = bodies[slot].position - self.position;
            float distance_squared = dot(offset, offset);
            if (distance_squared > range_squared || bodies[slot].row == self.row) continue;
            keepNearest(distance_squared, slot);
            nearest = min(nearest, distance_squared);
        }
    }
    return sqrt(nearest);
}

/// Site ids met by the samples, without immediate repetitions; at most one per sample.
uint candidates[SENSING_SAMPLES];

int marchRays(Body self) {
    vec2 centre = (self.position - parameters.diagram_minimum) * parameters.pixels_per_metre;
    vec2 forward = vec2(cos(self.heading), sin(self.heading)) * parameters.pixels_per_metre;
    vec2 upper = vec2(parameters.diagram_width, parameters.diagram_height) - 1.0;
    int count = 0;
    uint previous = self.row;
    for (int i = 0; i < SENSING_SAMPLES; ++i) {
        vec2 local = pattern[i];
        vec2 pixel = centre + vec2(forward.x * local.x - forward.y * local.y, forward.y * local.x + forward.x * local.y);
        uvec2 at = uvec2(clamp(pixel, vec2(0.0), upper));
        uint owner = owners[at.y * parameters.diagram_width + at.x];
        bool fresh = owner != NO_INDEX && owner != previous && owner != self.row;
        candidates[count] = owner;
        count += fresh ? 1 : 0;
        previous = owner;
    }
    return count;
}

void weighCandidate(Body self, uint site) {
    if (site < parameters.row_count) {
        uint slot = row_slots[site];
        vec2 offset = bodies[slot].position - self.position;
        keepNearest(dot(offset, offset), slot);
    } else {
        // A long wall has many tiles and is one neighbour.
        uint segment = wall_tiles[site - parameters.row_count].segment;
        WallSegment wall = wall_segments[segment];
        vec2 offset = nearestOnSegment(self.position, wall.a, wall.b) - self.position;
        float gap = max(length(offset) - wall.half_thickness, 0.0);
        keepNearest(gap * gap, NEIGHBOUR_IS_WALL | segment);
    }
}

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= live_count) return;
    Body self = bodies[slot];
    for (int i = 0; i < NEIGHBOURS; ++i) {
        nearest_distance[i] = FAR;
        nearest_key[i] = NO_INDEX;
    }
    nearest_bodies[slot] = feelContacts(self);
    int count = marchRays(self);
    for (int i = 0; i < count; ++i) weighCandidate(self, candidates[i]);

    uint found = 0u;
    for (int i = 0; i < NEIGHBOURS; ++i) {
        neighbours[uint(i) * slot_capacity + slot] = nearest_key[i];
        found += nearest_distance[i] < FAR ? 1u : 0u;
    }
    neighbour_counts[slot] = found;
}
