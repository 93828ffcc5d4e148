// SPDX-License-Identifier: Apache-2.0
// Crossings, and which of them are red.
// Needs the blocks Crossings, CrossingPoints and Lights.
#include "shaders/shared/outline.glsl"

bool isRed(uint light) { return light != NO_LIGHT && lights[light] == LIGHT_RED; }

/// Whether a place is on a crossing.
bool isOnCrossing(TrafficCrossing crossing, vec2 place) {
    bool inside = false;
    vec2 before = crossing_points[crossing.first_point + crossing.point_count - 1u];
    for (uint i = 0u; i < crossing.point_count; ++i) {
        vec2 point = crossing_points[crossing.first_point + i];
        if (rayGoesOver(point, before, place)) inside = !inside;
        before = point;
    }
    return inside;
}
