// SPDX-License-Identifier: Apache-2.0
// Outlines of places, as corners among the behaviours' points. Needs the block BehaviourPoints.

#include "shaders/shared/outline.glsl"

/// As insidePolygon() of authoring/scene/raster.h: an odd number of edges lies to the right.
bool isInside(vec2 position, uint first, uint count) {
    bool inside = false;
    vec2 before = behaviour_points[first + count - 1u];
    for (uint i = first; i < first + count; ++i) {
        vec2 corner = behaviour_points[i];
        if (rayGoesOver(corner, before, position)) inside = !inside;
        before = corner;
    }
    return inside;
}

/// m; 0 inside.
float awayFrom(vec2 position, uint first, uint count) {
    if (isInside(position, first, count)) return 0.0;
    float least = 1.0e30;
    vec2 before = behaviour_points[first + count - 1u];
    for (uint i = first; i < first + count; ++i) {
        least = min(least, distanceToEdge(position, before, behaviour_points[i]));
        before = behaviour_points[i];
    }
    return least;
}
