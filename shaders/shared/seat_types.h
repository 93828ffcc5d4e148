// SPDX-License-Identifier: Apache-2.0
// Structures of seats that people walk to and leave, read by the C++ compiler and by the GLSL compiler alike
// (std430).
#ifndef THRONG_SHARED_SEAT_TYPES_H
#define THRONG_SHARED_SEAT_TYPES_H

#include "shaders/shared/both_languages.h"

THRONG_SHARED_BEGIN

// What somebody does who has a seat of its own.
const uint SITTER_WALKS = 0u;       // about, as everybody does
const uint SITTER_ASKS = 1u;        // likewise, before the aisle, and would like to go in
const uint SITTER_ENTERS = 2u;      // along the aisle and the row
const uint SITTER_TURNS = 3u;       // before its seat, its back to it
const uint SITTER_SETTLES = 4u;     // sits down
const uint SITTER_SITS = 5u;        // and does what its state says
const uint SITTER_LETS_GO = 6u;     // ends that, to stand up
const uint SITTER_STANDS_FOR = 7u;  // stands, or is about to, while somebody passes
const uint SITTER_RISES = 8u;       // to leave
const uint SITTER_LEAVES = 9u;      // along the row and the aisle

const float NO_FORK = -1.0;

/// The way to a seat: along an aisle, and along a row. Those who share an aisle are listed one behind the
/// other.
struct SeatWay {
    vec2 place;     // m, the middle of the seat
    vec2 stand;     // m, where one stands before it
    vec2 shift;     // m: place in the plane - home
    float height;   // m, of the floor there
    float heading;  // rad: which way one sits
    float length;   // m, from the foot of the aisle to before the seat
    float mouth;    // m along it, where the row begins
    float aside;    // m: so far to its right people keep in the aisle
    float fork;     // m along it, where ways to the front and to the back part; NO_FORK: points tell no sides
    uint row;       // whose it is
    uint first_point;
    uint point_count;
    uint lane;       // the same of those who go into one row from one aisle
    uint branch;     // the same of those who share the aisle behind the fork
    uint free_side;  // Sitter::side of who leaves while nobody comes in
    uint first_of_aisle;
    uint count_of_aisle;
};

/// Those who go into one row from one aisle: one behind the other in a list of their numbers.
struct SeatLane {
    uint first;
    uint count;
};

/// Somebody on its way in an aisle, and what the others there look at (shaders/seats/others.glsl): of Sitter
/// and SeatWay. As many words as two texels have.
struct AisleWalker {
    uint number;
    uint mode;
    uint side;
    uint since;
    float along;
    float share;
    float mouth;
    uint lane_and_branch;  // 16 bits each
};

struct SeatPoint {
    vec2 place;    // m
    vec2 beside;   // m, from there to where those walk who come in; the others walk as far on the other side
    vec2 alone;    // m, likewise of those who leave while nobody comes in
    float height;  // m
    float along;   // m from the foot of the aisle
};

/// What somebody does, and where on its way it is.
struct Sitter {
    vec2 off;       // m from the way, on which it is soon
    float along;    // m
    float speed;    // m/s
    float share;    // of standing up: 0 sits, 1 stands
    uint mode;      // SITTER_*
    uint since;     // how many steps were done when that began
    uint activity;  // ACTIVITY_* of who sits
    uint seated;    // how many steps were done when it sat down; NO_INDEX: it does not sit
    uint side;      // of the aisle, on the way out: 0 beside those who come in, else where they would walk
};

THRONG_SHARED_END

#endif
