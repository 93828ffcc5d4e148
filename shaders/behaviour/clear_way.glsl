// SPDX-License-Identifier: Apache-2.0
// Whether somebody can walk straight from one place to another: no wall comes nearer to the way than a body.
// Needs the blocks ParametersBlock, WallSegments, WallStarts and WallItems, and shaders/cells/cells.glsl and
// walls_near.glsl.
#include "shaders/shared/outline.glsl"

float cross2(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

float segmentsApart(vec2 a, vec2 b, vec2 c, vec2 d) {
    float turn = cross2(b - a, d - c);
    if (abs(turn) > 1.0e-12) {
        float on_first = cross2(c - a, d - c) / turn;
        float on_second = cross2(c - a, b - a) / turn;
        if (on_first >= 0.0 && on_first <= 1.0 && on_second >= 0.0 && on_second <= 1.0) return 0.0;
    }
    return min(min(distanceToEdge(a, c, d), distanceToEdge(b, c, d)),
               min(distanceToEdge(c, a, b), distanceToEdge(d, a, b)));
}

bool wayIsClear(vec2 from, vec2 to, float radius) {
    float size = distance(from, to);
    int steps = int(ceil(2.0 * size / parameters.cell_size)) + 1;
    uint cell_before = NO_INDEX;
    for (int i = 0; i <= steps; ++i) {
        uint cell = cellIndex(cellOf(mix(from, to, float(i) / float(steps))));
        if (cell == cell_before) continue;
        cell_before = cell;
        uvec2 walls = wallsNear(cell);
        for (uint item = walls.x; item < walls.y; ++item) {
            WallSegment wall = wall_segments[wall_items[item]];
            if (segmentsApart(from, to, wall.a, wall.b) < radius + wall.half_thickness) return false;
        }
    }
    return true;
}
