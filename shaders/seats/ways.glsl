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

/// How much of the way from the foot of the aisle to the first row is left, 0 to 1.
float beforeRows(SeatWay way, float along) {
    float first_row = seat_points[way.first_point + 1u].along;
    return clamp(1.0 - along / max(first_row, 1.0e-6), 0.0, 1.0);
}

const float HAIR = 0.01;  // m

/// To the right of who goes up the aisle, at a place on the way; of who is in the row, at its mouth.
vec2 besideOnWay(SeatWay way, float along) {
    PieceOfWay piece = pieceAt(way, min(along, way.mouth - HAIR));
    vec2 ahead = piece.after.place - piece.before.place;
    return vec2(ahead.y, -ahead.x) / max(length(ahead), 1.0e-6);
}

// Which side of an aisle somebody keeps to.
const uint FILE_IN = 0u;     // that of those who come in
const uint FILE_OUT = 1u;    // the other
const uint FILE_ALONE = 2u;  // of those who leave while nobody comes in: that which is nearer to their seat

const float COMES_TO_SIDE = 0.6;  // m of the row

vec2 placeOnWay(SeatWay way, float along, uint file) {
    PieceOfWay piece = pieceAt(way, along);
    vec2 middle = mix(piece.before.place, piece.after.place, piece.share);
    if (way.fork != NO_FORK) {
        if (file == FILE_ALONE) return middle + mix(piece.before.alone, piece.after.alone, piece.share);
        vec2 beside = mix(piece.before.beside, piece.after.beside, piece.share);
        return middle + (file == FILE_IN ? beside : -beside);
    }
    float aside = way.aside * clamp(1.0 - (along - way.mouth) / COMES_TO_SIDE, 0.0, 1.0);
    return middle + (file == FILE_OUT ? -aside : aside) * besideOnWay(way, along);
}

uint fileOf(Sitter sitter) {
    if (sitter.mode == SITTER_ENTERS) return FILE_IN;
    return sitter.side == 0u ? FILE_OUT : FILE_ALONE;
}

bool risesOrSettles(uint mode) {
    return mode == SITTER_SETTLES || mode == SITTER_STANDS_FOR || mode == SITTER_RISES;
}
