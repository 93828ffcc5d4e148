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

/// The way to a seat: up an aisle, and along a row. Those who share an aisle are listed one behind the other.
struct SeatWay {
    vec2 place;     // m, the middle of the seat
    vec2 stand;     // m, where one stands before it
    float height;   // m, of the floor there
    float heading;  // rad: which way one sits
    float length;   // m, from the foot of the aisle to before the seat
    float mouth;    // m along it, where the row begins
    float aside;    // m: so far to its right people keep in the aisle
    uint row;       // whose it is
    uint first_point;
    uint point_count;
    uint lane;  // the same of those who go into one row from one aisle
    uint first_of_aisle;
    uint count_of_aisle;
    uint reserved;
};

struct SeatPoint {
    vec2 place;    // m
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
    uint side;      // of the aisle, on the way out: 0 its right, 1 its left, where those walk who come in
};

THRONG_SHARED_END

#endif
