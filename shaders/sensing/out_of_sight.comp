// SPDX-License-Identifier: Apache-2.0
// Takes those out of everybody's neighbours whom a wall hides that is not looked over. Bodies touch all the same.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) readonly buffer Bodies { Body bodies[]; };
layout(std430) readonly buffer WallSegments { WallSegment wall_segments[]; };
layout(std430) readonly buffer HidingStarts { uint hiding_starts[]; };  // walls within the reach of each cell
layout(std430) readonly buffer HidingItems { uint hiding_items[]; };
layout(std430) buffer Neighbours { uint neighbours[]; };
layout(std430) buffer NeighbourCounts { uint neighbour_counts[]; };
uniform uint slot_capacity;

#include "shaders/cells/cells.glsl"
#include "shaders/charts/slot_images.glsl"

float side(vec2 from, vec2 to, vec2 point) {
    vec2 way = to - from, off = point - from;
    return way.x * off.y - way.y * off.x;
}

/// Whether the line from one eye to another crosses the middle of a wall.
bool hides(WallSegment wall, vec2 from, vec2 to) {
    bool parts = (side(wall.a, wall.b, from) > 0.0) != (side(wall.a, wall.b, to) > 0.0);
    return parts && (side(from, to, wall.a) > 0.0) != (side(from, to, wall.b) > 0.0);
}

bool isHidden(uint cell, vec2 from, vec2 to) {
    for (uint i = hiding_starts[cell]; i < hiding_starts[cell + 1u]; ++i)
        if (hides(wall_segments[hiding_items[i]], from, to)) return true;
    return false;
}

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= live_count || holdsImage(slot)) return;
    vec2 place = bodies[slot].position;
    uint cell = cellIndex(cellOf(place));
    if (hiding_starts[cell] == hiding_starts[cell + 1u]) return;
    uint found = neighbour_counts[slot], kept = 0u;
    for (uint i = 0u; i < found; ++i) {
        uint key = neighbours[i * slot_capacity + slot];
        if ((key & NEIGHBOUR_IS_WALL) == 0u && isHidden(cell, place, bodies[key].position)) continue;
        neighbours[kept++ * slot_capacity + slot] = key;
    }
    neighbour_counts[slot] = kept;
}
