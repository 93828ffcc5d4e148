// SPDX-License-Identifier: Apache-2.0
// The gap ahead: how much room there is between the walls on both sides of one's way.
// Needs the blocks WallSegments, WallStarts and WallItems, shaders/cells/cells.glsl and walls_near.glsl, and
// shaders/motion/shoulders.glsl.

#ifdef BODIES

const float NO_GAP = 1.0e5;

/// Narrows `sides` (m, to the left and to the right) to what a wall leaves.
/// @returns whether the wall is in the way itself
bool narrowed(vec2 place, vec2 way, float behind, WallSegment wall, inout vec2 sides) {
    vec2 a = wall.a - place, b = wall.b - place;
    vec2 from = vec2(dot(a, way), crossOf(way, a)), to = vec2(dot(b, way), crossOf(way, b));
    if (from.x > to.x) {
        vec2 swapped = from;
        from = to;
        to = swapped;
    }
    float low = -behind - wall.half_thickness, high = SHOULDERS_LOOK + wall.half_thickness;
    if (to.x < low || from.x > high) return false;
    float slope = (to.y - from.y) / max(to.x - from.x, 1.0e-6);
    float first = from.x < low ? from.y + slope * (low - from.x) : from.y;
    float last = to.x > high ? from.y + slope * (high - from.x) : to.y;
    float least = min(first, last) - wall.half_thickness, most = max(first, last) + wall.half_thickness;
    if (least <= 0.0 && most >= 0.0) return true;
    if (least > 0.0)
        sides.x = min(sides.x, least);
    else
        sides.y = min(sides.y, -most);
    return false;
}

/// rad: how far to turn the shoulders for what is ahead.
float twistAhead(Body self, Walker walker, vec2 way) {
    if (!SHOULDERS_ENABLED || walker.half_axis <= 0.0) return 0.0;
    uint cell = cellIndex(cellOf(self.position));
    vec2 sides = vec2(NO_GAP);
    uvec2 walls = wallsNear(cell);
    for (uint i = walls.x; i < walls.y; ++i)
        if (narrowed(self.position, way, self.radius, wall_segments[wall_items[i]], sides)) return 0.0;
    return twistFor(sides.x + sides.y, self.radius, self.radius - walker.half_axis);
}

#else

float twistAhead(Body self, Walker walker, vec2 way) { return 0.0; }

#endif
