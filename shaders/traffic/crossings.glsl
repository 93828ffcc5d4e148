// SPDX-License-Identifier: Apache-2.0
// Crossings, and which of them are red.
// Needs the blocks Crossings, CrossingPoints and Lights.

bool isRed(uint light) { return light != NO_LIGHT && lights[light] == LIGHT_RED; }

/// Whether a place is on a crossing: by how often a way to it from afar goes over the outline.
bool isOnCrossing(TrafficCrossing crossing, vec2 place) {
    bool inside = false;
    vec2 before = crossing_points[crossing.first_point + crossing.point_count - 1u];
    for (uint i = 0u; i < crossing.point_count; ++i) {
        vec2 point = crossing_points[crossing.first_point + i];
        if ((point.y > place.y) != (before.y > place.y) &&
            place.x < point.x + (before.x - point.x) * (place.y - point.y) / (before.y - point.y))
            inside = !inside;
        before = point;
    }
    return inside;
}

/// m: how far it is to a crossing's edge, straight on; more than `most`: it is not ahead.
float distanceToCrossing(TrafficCrossing crossing, vec2 place, vec2 ahead, float most) {
    float least = most + 1.0;
    vec2 before = crossing_points[crossing.first_point + crossing.point_count - 1u];
    for (uint i = 0u; i < crossing.point_count; ++i) {
        vec2 point = crossing_points[crossing.first_point + i];
        vec2 edge = point - before, offset = before - place;
        float across = ahead.x * edge.y - ahead.y * edge.x;
        before = point;
        if (abs(across) < 1.0e-9) continue;
        float along = (offset.x * edge.y - offset.y * edge.x) / across;
        float share = (offset.x * ahead.y - offset.y * ahead.x) / across;
        if (along >= 0.0 && share >= 0.0 && share <= 1.0) least = min(least, along);
    }
    return least;
}
