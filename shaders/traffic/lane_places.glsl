// SPDX-License-Identifier: Apache-2.0
// Places along lanes; before their first point and behind their last, they go straight on.
// Needs the blocks Lanes and LanePoints.

vec2 placeOnLane(uint lane, float along) {
    uint first = lanes[lane].first_point;
    uint last = first + lanes[lane].point_count - 1u;
    uint i = first + 1u;
    while (i < last && lane_points[i].along < along) ++i;
    float begin = lane_points[i - 1u].along;
    float share = (along - begin) / (lane_points[i].along - begin);
    return lane_points[i - 1u].place + (lane_points[i].place - lane_points[i - 1u].place) * share;
}

/// Where a lane is nearest to somebody: how far along it, m, and from there to them.
float nearestAlongLane(uint lane, vec2 position, out vec2 from_lane) {
    uint first = lanes[lane].first_point;
    float found = 0.0, least = 1.0e30;
    for (uint i = first + 1u; i < first + lanes[lane].point_count; ++i) {
        vec2 a = lane_points[i - 1u].place, axis = lane_points[i].place - a;
        float share = clamp(dot(position - a, axis) / dot(axis, axis), 0.0, 1.0);
        vec2 apart = position - (a + axis * share);
        if (dot(apart, apart) >= least) continue;
        least = dot(apart, apart);
        from_lane = apart;
        found = mix(lane_points[i - 1u].along, lane_points[i].along, share);
    }
    return found;
}
