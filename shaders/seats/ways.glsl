// SPDX-License-Identifier: Apache-2.0
// The way to a seat: places along it. Needs the block SeatPoints.

/// The number of the point before a place on the way.
uint pointBefore(SeatWay way, float along) {
    uint last = way.first_point + way.point_count - 2u;
    uint point = way.first_point;
    while (point < last && seat_points[point + 1u].along <= along) ++point;
    return point;
}

float shareOfPiece(uint point, float along) {
    float size = seat_points[point + 1u].along - seat_points[point].along;
    return clamp((along - seat_points[point].along) / max(size, 1.0e-6), 0.0, 1.0);
}

float heightOnWay(SeatWay way, float along) {
    uint point = pointBefore(way, along);
    return mix(seat_points[point].height, seat_points[point + 1u].height, shareOfPiece(point, along));
}

/// @param inwards whether one goes in, or out: both keep to their right in the aisle
vec2 placeOnWay(SeatWay way, float along, bool inwards) {
    const float LEAVES_SIDE = 0.6;  // m before the row
    uint point = pointBefore(way, along);
    vec2 a = seat_points[point].place, b = seat_points[point + 1u].place;
    vec2 ahead = (b - a) / max(length(b - a), 1.0e-6);
    float aside = way.aside * clamp((way.mouth - along) / LEAVES_SIDE, 0.0, 1.0);
    return mix(a, b, shareOfPiece(point, along)) + (inwards ? aside : -aside) * vec2(ahead.y, -ahead.x);
}

bool risesOrSettles(uint mode) {
    return mode == SITTER_SETTLES || mode == SITTER_STANDS_FOR || mode == SITTER_RISES;
}
