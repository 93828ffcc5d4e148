// SPDX-License-Identifier: Apache-2.0
// Vehicles, lanes and crossings, shared by C++ and GLSL (std430; boxes also std140).
#ifndef THRONG_SHARED_TRAFFIC_TYPES_H
#define THRONG_SHARED_TRAFFIC_TYPES_H

#include "shaders/shared/both_languages.h"

THRONG_SHARED_BEGIN

/// In one bake: their boxes have to fit the smallest uniform block that every device has, 16 KiB.
const uint MOST_VEHICLES = 512u;
const uint VEHICLE_GROUP_SIZE = 64u;  // one group steps all of them

const uint VEHICLE_TO_COME = 0u;
const uint VEHICLE_DRIVES = 1u;
const uint VEHICLE_STANDS = 2u;  // at a stop of its own
const uint VEHICLE_GONE = 3u;

const uint STOP_AT_RED = 0u;
const uint STOP_FOR_PEOPLE = 1u;  // before a crossing
const uint STOP_FOR_TIME = 2u;
const uint STOP_AT_PLATFORM = 3u;

const uint NO_LIGHT = 0xffffffffu;
const uint LIGHT_GREEN = 0u;
const uint LIGHT_RED = 1u;

/// One vehicle, from its first to its last step. Those of one lane come in the order of their times.
struct Vehicle {
    float along;         // m: its front, from where the lane begins
    float speed;         // m/s
    float acceleration;  // m/s^2, of the last step
    float stand_until;   // s: at a stop of its own
    uint status;         // VEHICLE_*
    uint next_stop;      // index into the lane stops: those before are behind it
    uint lane;           // index into the lanes
    uint kind;           // authoring::VehicleKind
    float start;         // s
    float length;        // m, and so on as in authoring::VehicleType
    float half_width;
    float wished_speed;
    float headway;
    float most_acceleration;
    float braking;
    float gap;
};

/// s: people keep off what a vehicle may reach until then.
const float VEHICLE_LOOK_AHEAD = 2.0;

/// Where a vehicle is, and what it is about to drive over, as people see it.
struct VehicleBox {
    vec2 rear;         // m: the middle of its back
    vec2 front;        // m
    vec2 ahead;        // m: where its front may be before it could have stopped, or stops
    float half_width;  // m; 0 = it is not there
    float speed;       // m/s
};

/// Of the vehicles around somebody so many are heeded, the nearest, by their numbers in one word.
const uint MOST_HEEDED = 3u;
const uint HEEDED_BITS = 10u;
const uint HEEDED_NONE = (1u << HEEDED_BITS) - 1u;

struct TrafficLane {
    uint first_point;
    uint point_count;  // at least 2
    uint first_stop;   // in the order of `along`
    uint stop_count;
    float length;  // m
    uint reserved;
};

struct LanePoint {
    vec2 place;   // m
    float along;  // m
    uint reserved;
};

/// Where vehicles stop, or perhaps stop.
struct TrafficStop {
    float along;    // m: where fronts stand
    float seconds;  // s
    uint kind;      // STOP_*
    uint light;     // index into the lights, or NO_LIGHT
    uint crossing;  // index, of STOP_FOR_PEOPLE; of STOP_AT_PLATFORM the platform
};

struct TrafficCrossing {
    uint first_point;
    uint point_count;
    uint light;    // or NO_LIGHT: people may always cross
    uint entries;  // bit by bit, whether people come in over the edge from a point to the next
};
const uint MOST_ENTRIES = 32u;

THRONG_SHARED_END

#endif
