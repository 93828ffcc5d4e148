// SPDX-License-Identifier: Apache-2.0
// Out of walls, for bodies that are no discs: the middle of a body stays on the side of a wall on which it began the
// step, and so do its shoulders. A wall turns a body as far as its chest turns in a step, and moves it by the rest.
// Needs the blocks WallSegments, WallStarts and WallItems, shaders/cells/cells.glsl and walls_near.glsl,
// shaders/shared/walls.glsl and body_shape.glsl, and shaders/motion/shoulders.glsl.

/// The place, less where a step from `before` has passed through the wall itself, not only round its end.
vec2 notThroughWall(WallSegment wall, vec2 before, vec2 position, out float side_before) {
    vec2 axis = wall.b - wall.a;
    side_before = crossOf(axis, before - wall.a);
    float side_after = crossOf(axis, position - wall.a);
    if (side_before * side_after >= 0.0) return position;
    vec2 crossing = mix(before, position, side_before / (side_before - side_after));
    float along = dot(crossing - wall.a, axis) / max(dot(axis, axis), 1.0e-12);
    return along >= 0.0 && along <= 1.0 ? crossing + (before - crossing) * 1.0e-3 : position;
}

/// @param start the body's axis at the start of the step
/// @param turns whether the wall may turn it
void pushFromWall(WallSegment wall, Body self, vec2 start, bool turns, inout vec4 target) {
    float side;
    target.xy = notThroughWall(wall, self.position, target.xy, side);
    float thickness = thicknessOf(self.radius, start);
    vec2 half_wall = 0.5 * (wall.b - wall.a);
    vec2 offset = target.xy - 0.5 * (wall.a + wall.b);
    vec2 along = nearestAlong(offset, target.zw, half_wall);
    vec2 at = along.x * target.zw;
    vec2 gap = offset + at - along.y * half_wall;
    float size = length(gap);
    float depth = thickness + wall.half_thickness - size;
    if (depth <= 0.0) return;
    vec2 outward = gap / max(size, 1.0e-6);
    if (size <= 1.0e-5) {  // a shoulder is through the wall: it comes back
        float length_of_wall = length(half_wall);
        outward = length_of_wall > 0.0 ? vec2(-half_wall.y, half_wall.x) / length_of_wall : vec2(1.0, 0.0);
        if (side < 0.0) outward = -outward;
        at = dot(target.zw, outward) > 0.0 ? -target.zw : target.zw;
        depth -= dot(at - along.x * target.zw, outward);
    }
    float arm = crossOf(at, outward);
    float turn = turns ? arm / inertiaOf(self.radius, thickness) : 0.0;
    float push = depth / (1.0 + arm * turn);
    target.xy += outward * push;
    if (turns) target.zw = withinATurn(turnedBy(target.zw, turn * push), start);
}

#ifdef FIRST_ROUND

/// Notes the walls that may move the body in the rounds that follow, as long as it stays within NEAR_ENOUGH of where it
/// began the step. @returns how many they are; the list holds NEAR_WALLS of them at most
uint noteWalls(Body self, uint slot) {
    uint cell = cellIndex(cellOf(self.position));
    uvec2 walls = wallsNear(cell);
    uint found = 0u;
    for (uint i = walls.x; i < walls.y; ++i) {
        WallSegment wall = wall_segments[wall_items[i]];
        float away = length(nearestOnSegment(self.position, wall.a, wall.b) - self.position);
        if (away - wall.half_thickness - self.radius >= NEAR_ENOUGH) continue;
        if (found < NEAR_WALLS) near_lists[slot * NEAR_WORDS + 1u + NEAR_CAPACITY + found] = wall_items[i];
        ++found;
    }
    return found;
}

#endif

/// @param listed how many walls the list holds: 0 where they are those of the cell
vec4 keepOutOfWalls(Body self, uint slot, uint listed_walls, vec2 start, vec4 target) {
    uint cell = cellIndex(cellOf(self.position));
    uvec2 walls = uvec2(0u, listed_walls) + slot * NEAR_WORDS + 1u + NEAR_CAPACITY;
    if (listed_walls == 0u) walls = wallsNear(cell);
    uint first = walls.x, last = walls.y;
    if (first >= last) return target;  // it has come into another cell since it last looked round
    // Leaving one wall may lead into the next: a few rounds settle corners, the last ones without turning.
    int round = 0;
    vec4 was;
    do {
        was = target;
        uint i = first;
        do {
#ifdef FIRST_ROUND
            uint wall = wall_items[i];
#else
            uint wall = listed_walls > 0u ? near_lists[i] : wall_items[i];
#endif
            pushFromWall(wall_segments[wall], self, start, round < 2, target);
        } while (++i < last);
    } while (++round < 4 && target != was);
    return target;
}
