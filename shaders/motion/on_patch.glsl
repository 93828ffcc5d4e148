// SPDX-License-Identifier: Apache-2.0
// Whether a place is on a patch of ground. Needs the block PatchPoints.

#include "shaders/shared/outline.glsl"

bool isIn(Patch ground, vec2 place) {
    if (any(lessThan(place, ground.lower)) || any(greaterThan(place, ground.upper))) return false;
    bool inside = false;
    vec2 before = patch_points[ground.first_point + ground.point_count - 1u];
    for (uint i = 0u; i < ground.point_count; ++i) {
        vec2 point = patch_points[ground.first_point + i];
        if (rayGoesOver(point, before, place)) inside = !inside;
        before = point;
    }
    return inside;
}

bool holds(Patch ground, vec2 place, float now) {
    return now >= ground.from && now < ground.until && isIn(ground, place);
}
