// SPDX-License-Identifier: Apache-2.0
// The way to a seat: places along it. Needs the block SeatPoints.

/// The two points around a place on the way, and how far from the one to the other it is.
struct PieceOfWay {
    SeatPoint before, after;
    float share;
};

PieceOfWay pieceAt(SeatWay way, float along) {
    SeatPoint before = seat_points[way.first_point];
    SeatPoint after = seat_points[way.first_point + 1u];
    for (uint point = way.first_point + 2u; point < way.first_point + way.point_count; ++point) {
        if (after.along > along) break;
        before = after;
        after = seat_points[point];
    }
    float share = (along - before.along) / max(after.along - before.along, 1.0e-6);
    return PieceOfWay(before, after, clamp(share, 0.0, 1.0));
}

float heightOnWay(SeatWay way, float along) {
    PieceOfWay piece = pieceAt(way, along);
    return mix(piece.before.height, piece.after.height, piece.share);
}

/// @param inwards whether one goes in, or out: both keep to their right in the aisle
vec2 placeOnWay(SeatWay way, float along, bool inwards) {
    const float LEAVES_SIDE = 0.6;  // m before the row
    PieceOfWay piece = pieceAt(way, along);
    vec2 ahead = piece.after.place - piece.before.place;
    ahead /= max(length(ahead), 1.0e-6);
    float aside = way.aside * clamp((way.mouth - along) / LEAVES_SIDE, 0.0, 1.0);
    return mix(piece.before.place, piece.after.place, piece.share) +
           (inwards ? aside : -aside) * vec2(ahead.y, -ahead.x);
}

bool risesOrSettles(uint mode) {
    return mode == SITTER_SETTLES || mode == SITTER_STANDS_FOR || mode == SITTER_RISES;
}
