// SPDX-License-Identifier: Apache-2.0
// How much somebody may grow until it next looks round.
// Needs the blocks ParametersBlock, Bodies, Walkers, WallSegments, WallStarts and WallItems,
// shaders/cells/cells.glsl, cell_runs.glsl and walls_near.glsl.

#include "shaders/shared/body_shape.glsl"
#include "shaders/shared/walls.glsl"

#ifdef BODIES
vec2 axisIn(uint slot) { return vec2(walkers[slot].axis_x, walkers[slot].axis_y); }

/// How much is free between two segments and what reaches from them, m.
float freeBetween(vec2 offset, vec2 a, vec2 b, float reach) {
    vec2 along = nearestAlong(offset, a, b);
    return length(offset + along.x * a - along.y * b) - reach;
}

float freeOf(uint slot, uint other) {
    vec2 axis = axisIn(slot), its = axisIn(other);
    return freeBetween(bodies[slot].position - bodies[other].position, axis, its,
                       thicknessOf(bodies[slot].radius, axis) + thicknessOf(bodies[other].radius, its));
}

float freeOf(uint slot, WallSegment wall) {
    vec2 axis = axisIn(slot);
    return freeBetween(bodies[slot].position - 0.5 * (wall.a + wall.b), axis, 0.5 * (wall.b - wall.a),
                       thicknessOf(bodies[slot].radius, axis) + wall.half_thickness);
}
#else
float freeOf(uint slot, uint other) {
    return distance(bodies[slot].position, bodies[other].position) - bodies[slot].radius - bodies[other].radius;
}

float freeOf(uint slot, WallSegment wall) {
    vec2 place = bodies[slot].position;
    return distance(place, nearestOnSegment(place, wall.a, wall.b)) - bodies[slot].radius - wall.half_thickness;
}
#endif

/// m of its radius: all that is free between it and walls, and half of what is between it and others, who may grow,
/// too.
float roomToGrow(uint slot) {
    float room = GROWTH;
    ivec2 cell = cellOf(bodies[slot].position);
    for (int y = cell.y - 1; y <= cell.y + 1; ++y) {
        uvec2 run = slotRun(cell.x, y);
        for (uint other = run.x; other < run.y; ++other)
            if (other != slot) room = min(room, 0.5 * freeOf(slot, other));
    }
    uvec2 walls = wallsNear(cellIndex(cell));
    for (uint i = walls.x; i < walls.y; ++i)
        room = min(room, freeOf(slot, wall_segments[wall_items[i]]));
    return max(room, 0.0);
}
