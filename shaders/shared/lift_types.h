// SPDX-License-Identifier: Apache-2.0
// Lifts, shared by C++ and GLSL (std430).
#ifndef THRONG_SHARED_LIFT_TYPES_H
#define THRONG_SHARED_LIFT_TYPES_H

#include "shaders/shared/both_languages.h"

THRONG_SHARED_BEGIN

const uint LIFT_GROUP_SIZE = 64u;      // one group steps all lifts
const uint MOST_SPOTS = 32u;           // in a cabin: bits of a word
const float LIFT_ACCELERATION = 0.8f;  // m/s^2: comfortable (CIBSE Guide D)

const uint LIFT_WAITS = 0u;    // with its doors closed
const uint LIFT_OPENS = 1u;    // its doors
const uint LIFT_IS_OPEN = 2u;  // people get off, and then on
const uint LIFT_CLOSES = 3u;
const uint LIFT_RIDES = 4u;

/// The cabin of a lift where it stands at one of its stops. In the scene frame, at home.
struct LiftStop {
    vec2 begin;    // m: the middle of the line between its doors
    vec2 along;    // unit vector, into the cabin
    uint chart;    // that people in it are on
    uint landing;  // the chart before its doors
    float height;  // m
    uint lift;
};

/// What a lift is like.
struct LiftPlan {
    vec2 corner;      // m: the first spot in its cabin
    vec2 across;      // m, from one spot to the next along the doors of its first stop
    vec2 forward;     // m, from one row of spots to the next, towards these doors
    uint first_stop;  // from the lowest up
    uint stop_count;
    uint capacity;
    uint columns;     // spots in a row
    float half_door;  // m
    float half_width;
    float depth;
    float speed;      // m/s
    float door_time;  // s
    float dwell;      // s
};

/// Where a lift is, and what it does.
struct LiftState {
    float height;  // m, of its cabin's floor
    float open;    // 0 to 1: its doors
    uint stop;     // among its own: where it is or will be next
    uint phase;    // LIFT_*
    float since;   // s in that phase
    float idle;    // s, with its doors open, since somebody has come or gone
    float from;    // m: where it set out from
    int heading;   // 1 up, -1 down, 0 neither
    uint aboard;
    uint given_up;  // 1: until its doors have closed, nobody is asked in, and who is between them steps back
};

/// What people want of a lift, counted anew before it decides; bits are stops.
struct LiftWishes {
    uint up;  // stops at which somebody waits to go up
    uint down;
    uint goals;  // where those in the cabin get off
    uint spots;  // in the cabin that are taken
    uint aboard;
    uint leaving;   // those in the cabin who get off here
    uint boarding;  // those who have been asked in and are not in it yet
    uint in_doors;  // those who stand between the doors
    uint first;     // who is next to come in: how far from the doors, and the row; 0 = nobody
    uint entering;  // who has come into the cabin and has no spot yet: the row; 0 = nobody
};

// Of each row, what it has to do with a lift: bits 0 to 7 the lift, 8 to 11 where it waits, 12 to 15 where it
// gets off, 16 to 21 its spot, and above them:
const uint RIDER_NONE = 0u;
const uint RIDER_WAITS = 0x1000000u;
const uint RIDER_BOARDS = 0x2000000u;  // it has been asked in
const uint RIDER_RIDES = 0x3000000u;   // it is in the cabin
const uint RIDER_PHASE = 0x3000000u;
const uint NO_SPOT = 63u;

THRONG_SHARED_END

#endif
