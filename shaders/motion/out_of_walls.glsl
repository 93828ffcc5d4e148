// SPDX-License-Identifier: Apache-2.0
// Out of walls: a body stays on the side of a wall on which it began the step, whatever pushes it.
// Needs the blocks WallSegments, WallStarts and WallItems, shaders/cells/cells.glsl and walls_near.glsl, and
// shaders/shared/walls.glsl.

/// Moves `position` to the side of the wall that `before` is on, clear of it by the body's radius.
vec2 pushFromWall(WallSegment wall, vec2 before, vec2 position, float radius) {
    vec2 axis = wall.b - wall.a;
    float reach = radius + wall.half_thickness;
    float side_before = axis.x * (before.y - wall.a.y) - axis.y * (before.x - wall.a.x);
    float side_after = axis.x * (position.y - wall.a.y) - axis.y * (position.x - wall.a.x);
    if (side_before * side_after < 0.0) {
        // Did the step pass through the wall itself, or only round its end?
        vec2 crossing = mix(before, position, side_before / (side_before - side_after));
        float along = dot(crossing - wall.a, axis) / max(dot(axis, axis), 1.0e-12);
        if (along >= 0.0 && along <= 1.0) position = crossing + (before - crossing) * 1.0e-3;
    }
    vec2 nearest = nearestOnSegment(position, wall.a, wall.b);
    vec2 offset = position - nearest;
    float size = length(offset);
    if (size >= reach) return position;
    vec2 outward = size > 1.0e-5 ? offset / size
                                 : normalize(vec2(-axis.y, axis.x)) * (side_before >= 0.0 ? 1.0 : -1.0);
    return nearest + outward * reach;
}

vec2 keepOutOfWalls(Body self, vec2 position) {
    uvec2 walls = wallsNear(cellIndex(cellOf(self.position)));
    if (walls.x >= walls.y) return position;
    // Leaving one wall may lead into the next: a few rounds settle corners.
    int round = 0;
    vec2 was;
    do {
        was = position;
        uint i = walls.x;
        do {
            position = pushFromWall(wall_segments[wall_items[i]], self.position, position, self.radius);
        } while (++i < walls.y);
    } while (++round < 3 && position != was);
    return position;
}
