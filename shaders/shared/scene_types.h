// SPDX-License-Identifier: Apache-2.0
// Structures of the static scene, read by the C++ compiler and by the GLSL compiler alike (std430).
#ifndef THRONG_SHARED_SCENE_TYPES_H
#define THRONG_SHARED_SCENE_TYPES_H

#include "shaders/shared/both_languages.h"

THRONG_SHARED_BEGIN

/// Marks "none" wherever an index is expected.
const uint NO_INDEX = 0xffffffffu;

const uint PERSON_KEEPS_TO_ROADS = 1u;    // steers back when pushed off the roads
const uint PERSON_STAYS = 2u;             // stands at the goal instead of leaving the scene
const uint PERSON_PRESENT_AT_START = 4u;  // stands at spawn_position when the simulation begins
const uint PERSON_FIXED_SPAWN = 8u;       // appears at spawn_position; otherwise at a point of its entry

/// One row per lifetime; the row index is the agent's stable id.
struct Person {
    vec2 spawn_position;    // m, scene frame; only with PERSON_FIXED_SPAWN
    float radius;           // m
    float preferred_speed;  // m/s
    float maximum_speed;    // m/s
    float spawn_time;       // s; rows of one queue are sorted by it
    float heading;          // rad at the start; NaN-free; entries turn people towards their goal anyway
    float stride_length;    // m per gait cycle (two steps)
    float phase;            // gait cycles at the start, [0, 1)
    uint variation;         // which character of the cast
    uint entry;             // index into entries, NO_INDEX with PERSON_FIXED_SPAWN
    uint flags;             // PERSON_*
    uint first_stage;       // index into stages
    uint stage_count;       // at least 1
    uint group;             // flow or formation, index into the scene's groups
    float headway;          // s of free way kept to those walked behind; 0 = pushes on
};

/// A step of somebody's route: walk until at most `tolerance` metres are left.
struct Stage {
    vec2 point;       // m; the target where field is NO_INDEX (walked to in a straight line)
    float tolerance;  // m
    uint field;       // index into the distance fields, or NO_INDEX; perhaps with FIELD_THEN_POINT
};

/// The field leads to the surroundings of the point, all clear; from there the way to the point is straight.
const uint FIELD_THEN_POINT = 0x80000000u;

/// Points where people of a flow may appear, all clear of walls.
struct Entry {
    uint first_point;
    uint point_count;
};

/// Consecutive rows that appear in order of their spawn time.
struct SpawnQueue {
    uint first_row;
    uint row_count;
};

/// A wall is a chain of capsules: everything within half_thickness of the segment a-b is solid.
struct WallSegment {
    vec2 a;
    vec2 b;
    float half_thickness;  // m; 0 for the outline of a solid polygon
    uint wall;             // index into the layout's walls
};

/// A site of the diagram that stands for a piece of wall. Its site id is the number of people plus its index.
struct WallTile {
    vec2 position;      // m
    float tile_radius;  // m
    uint segment;       // index into the wall segments
};

/// One cell of a distance field: how far it is to the target, and which way to walk.
struct FieldCell {
    float distance;  // m of walking left (cost-weighted off the roads and near walls); finite everywhere
    uint direction;  // unit vector, packSnorm2x16 / glm::packSnorm2x16
};

/// One cell of the coarse map on which detours round jams are worked out.
struct GroundCell {
    float cost;    // >= 1 per metre walked; BLOCKED_COST where nobody can stand
    uint one_way;  // unit direction that may not be walked against, or zero; packSnorm2x16
};
const float BLOCKED_COST = 1.0e9f;

THRONG_SHARED_END

#endif
