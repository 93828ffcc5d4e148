// SPDX-License-Identifier: Apache-2.0
// Doors of vehicles and who goes through them, shared by C++ and GLSL (std430).
#ifndef THRONG_SHARED_BOARDING_TYPES_H
#define THRONG_SHARED_BOARDING_TYPES_H

#include "shaders/shared/both_languages.h"

THRONG_SHARED_BEGIN

const uint BOARDING_GROUP_SIZE = 64u;  // one group decides for all vehicles
const uint MOST_PLATFORMS = 255u;      // in one bake
const uint MOST_LINES = 24u;           // flows of vehicles with doors: bits of a word beside the platform

const uint DOORS_SHUT = 0u;
const uint DOORS_OPEN_UP = 1u;
const uint DOORS_ARE_OPEN = 2u;
const uint DOORS_LET_THROUGH = 3u;  // who is between them, and nobody else
const uint DOORS_CLOSE = 4u;
const float CLEARING = 2.0f;  // s: so long before doors have to close, nobody more is let through

/// One door of one vehicle.
struct VehicleDoor {
    float behind;      // m: its middle, behind the vehicle's front
    float half_width;  // m
    uint sides;        // DOOR_ON_*
    uint reserved;
};
const uint DOOR_ON_LEFT = 1u;
const uint DOOR_ON_RIGHT = 2u;

struct DoorState {
    float next;    // s: before then nobody more is let through
    uint waiting;  // how many did before it when last counted
};

/// What a vehicle does at platforms; of one without doors, door_count is 0.
struct VehicleService {
    uint first_door;
    uint door_count;
    uint first_call;  // of those who get off
    uint call_count;
    uint line;        // its bit in Stage::board
    uint capacity;    // people
    float door_time;  // s, to open or to close
    float door_flow;  // persons/s through each door
    uint phase;       // DOORS_*
    uint platform;    // at which it stands, or NO_INDEX
    float open;       // 0 to 1
    float since;      // s in that phase
    float stood;      // s that it has stood there
    uint aboard;      // people
    uint boarded;     // at this platform
    uint alighted;    // likewise
};

/// Where people get on and off: a stop of a lane.
struct Platform {
    float side;        // 1: to the left of the lane, -1: to the right
    float least;       // s from when a vehicle stands there to when it goes on
    float most;        // likewise, unless somebody is in its doors
    uint first_point;  // of its outline
    uint point_count;
};

/// People who get off a vehicle at a platform: rows in this order.
struct AlightingCall {
    uint platform;
    uint first_row;
    uint row_count;
};

/// What people want of a door, counted anew before anybody decides.
struct DoorWishes {
    uint coming_out;  // have got off and are not clear of it
    uint going_in;    // have been asked in and are not in yet
    uint in_door;     // stand between its leaves
    uint waiting;     // before it
    uint first;       // who is next to go in: how far off, and the row; 0 = nobody
    uint deepest;     // whoever is furthest inside: the bits of how far, m + DEEP; 0 = nobody
};
const float DEEP = 8.0f;  // m

// Of each row, what it has to do with a vehicle: bits 0 to 8 which, 12 to 15 which of its doors, and above
// them:
const uint PASSENGER_NONE = 0u;
const uint PASSENGER_CALLED = 0x1000000u;   // it stands beside a door
const uint PASSENGER_BOARDS = 0x2000000u;   // it has been asked in
const uint PASSENGER_ALIGHTS = 0x3000000u;  // it gets off
const uint PASSENGER_PHASE = 0x3000000u;

// Stage::board: bits 0 to 7 are 1 + the platform where people get on, and above them those lines that they
// take.
const uint BOARD_LINES_AT = 8u;

THRONG_SHARED_END

#endif
