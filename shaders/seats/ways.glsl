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

/// To the right of who goes up the aisle, at a place on the way; of who is in the row, at its mouth.
vec2 besideOnWay(SeatWay way, float along) {
    const float HAIR = 0.01;  // m
    PieceOfWay piece = pieceAt(way, min(along, way.mouth - HAIR));
    vec2 ahead = piece.after.place - piece.before.place;
    return vec2(ahead.y, -ahead.x) / max(length(ahead), 1.0e-6);
}

/// @param inwards whether one keeps to the side on which people go in, or to the other
vec2 placeOnWay(SeatWay way, float along, bool inwards) {
    const float COMES_TO_SIDE = 0.6;  // m of the row
    PieceOfWay piece = pieceAt(way, along);
    float aside = way.aside * clamp(1.0 - (along - way.mouth) / COMES_TO_SIDE, 0.0, 1.0);
    return mix(piece.before.place, piece.after.place, piece.share) +
           (inwards ? aside : -aside) * besideOnWay(way, along);
}

bool risesOrSettles(uint mode) {
    return mode == SITTER_SETTLES || mode == SITTER_STANDS_FOR || mode == SITTER_RISES;
}
