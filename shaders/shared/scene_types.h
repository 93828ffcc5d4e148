// SPDX-License-Identifier: Apache-2.0
// Structures of the static scene, read by the C++ compiler and by the GLSL compiler alike (std430).
#ifndef THRONG_SHARED_SCENE_TYPES_H
#define THRONG_SHARED_SCENE_TYPES_H

#include "shaders/shared/both_languages.h"

THRONG_SHARED_BEGIN

/// Marks "none" wherever an index is expected.
const uint NO_INDEX = 0xffffffffu;

const uint PERSON_KEEPS_TO_ROADS = 1u;    // steers back when pushed off the roads
const uint PERSON_ALIGHTS = 2u;           // comes out of a vehicle
const uint PERSON_PRESENT_AT_START = 4u;  // stands at spawn_position when the simulation begins
const uint PERSON_FIXED_SPAWN = 8u;       // appears at spawn_position; otherwise at a point of its entry

const uint PERSON_IS_GIVEN = 16u;       // follows a way that is given (GivenWay)
const uint PERSON_SITS_AT_START = 32u;  // in its seat

/// One row per lifetime; the row index is the agent's stable id.
struct Person {
    vec2 spawn_position;    // m, scene frame; only with PERSON_FIXED_SPAWN
    float radius;           // m; of a body that is no disc, half of its longer side
    float preferred_speed;  // m/s
    float maximum_speed;    // m/s
    float spawn_time;       // s; rows of one queue are sorted by it
    float heading;          // rad at the start; NaN-free; entries turn people towards their goal anyway
    float phase;            // gait cycles at the start, [0, 1)
    uint variation;         // which character of the cast
    uint entry;             // index into entries, NO_INDEX with PERSON_FIXED_SPAWN
    uint flags;             // PERSON_*
    uint first_stage;       // index into stages
    uint stage_count;       // at least 1
    uint first_change;      // index into the changes of plan, which take the place of the stages in turn
    uint change_count;
    uint party_first;  // row of the first of those who walk together
    uint party_size;   // 1 = walks alone
    uint group;        // flow or formation, index into the scene's groups
    float headway;     // s of free way kept to those walked behind; 0 = pushes on
    uint kind;         // of its group's people, as the layout lists them: nothing here depends on it
    float half_axis;   // m: half of the segment that all of the body is near to; 0 = a disc, above 0 = from
                       // shoulder to shoulder, below 0 = the way it faces
    float own_radius;  // m: `radius` is this times what the ground makes of it (Patch::size)
};

/// A step of somebody's route: walk until at most `tolerance` metres are left, and perhaps stop there.
struct Stage {
    vec2 point;       // m; the target where field is NO_INDEX (walked to in a straight line)
    vec2 facing;      // m; what those who stop there look at; the point itself: nothing
    float tolerance;  // m
    uint field;       // index into the distance fields, or NO_INDEX; perhaps with FIELD_THEN_POINT
    float dwell;      // s of standing there; 0 = walks on, DWELL_FOR_GOOD = the journey ends there
    uint line;        // index into the waiting lines: the point is the place in line; or NO_INDEX
    uint activity;    // ACTIVITY_* of those who stop
    uint flags;       // STAGE_*
    float beyond;     // m of the shortest way from here to the end of the route
    uint board;       // where people wait to get on, and what (boarding_types.h); 0: they do not
};
const float DWELL_FOR_GOOD = 1.0e9f;

/// Near by will do for those who cannot get nearer to the point.
const uint STAGE_ANYWHERE = 1u;
/// The field leads to an area, and anywhere in it will do for them.
const uint STAGE_IN_AREA = 2u;

const uint ACTIVITY_WALK = 1u;  // what the stream of states says of people who are there
const uint ACTIVITY_STAND = 2u;
const uint ACTIVITY_LOOK = 3u;
const uint ACTIVITY_QUEUE = 4u;
const uint ACTIVITY_SIT = 5u;  // in a seat, as those up to 10 (base/activities.h)
const uint ACTIVITY_CLAP_SEATED = 7u;
const uint ACTIVITY_CHEER_SEATED = 9u;
const uint ACTIVITY_SING_SEATED = 10u;
const uint ACTIVITY_SETTLE = 11u;
const uint ACTIVITY_CLAP = 13u;  // on one's feet, as all from here on
const uint ACTIVITY_CHEER = 14u;
const uint ACTIVITY_SING = 15u;
const uint ACTIVITY_WAVE = 16u;
const uint ACTIVITY_LED = 32u;  // added for those who are led to or from a seat; recordings take it out again

/// From a time on, a row has other stages.
struct PlanChange {
    uint start_step;  // how many steps are done by then
    uint first_stage;
    uint stage_count;
    uint reserved;
};

/// People who wait in line, one behind the other from the first point on; whoever is in front is served.
struct WaitingLine {
    uint first_point;
    uint point_count;   // at least 2
    uint first_ticket;  // index into the tickets, which say who has which number
    uint ticket_count;
    float spacing;   // m
    uint given;      // tickets handed out
    uint served;     // of these, the ones whose turn is over
    uint candidate;  // row that joins at the end of the step, or NO_INDEX
};

/// The field leads to the surroundings of the point; from where it says so, the way to the point is straight.
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

/// Ground that people walk on at another pace, or take another room on.
struct Patch {
    vec2 lower;  // m, its bounds
    vec2 upper;
    float pace;   // times the preferred speed
    float from;   // s
    float until;  // s
    uint first_point;
    uint point_count;
    float size;  // times how broad and deep bodies are by themselves
};

/// However many patches lie over each other, bodies are no smaller and no larger than so many times their own
/// size.
const float LEAST_SIZE = 0.5f;
const float MOST_SIZE = 2.0f;
/// m/s, of a radius: an umbrella is open in a few steps, and contact moves people faster.
const float GROWTH = 0.1f;

/// Somebody whose way is given: consecutive places, at least two of them.
struct GivenWay {
    uint first_place;
    uint place_count;
    vec2 shift;  // m: of the chart on which it begins; 0 where there are no charts
};
struct GivenPlace {
    vec2 position;  // m, at home
    float time;     // s, later than that of the place before
    uint reserved;
};

/// A site of the diagram that stands for a piece of wall. Its site id is the number of people plus its index.
struct WallTile {
    vec2 position;      // m
    float tile_radius;  // m
    uint segment;       // index into the wall segments
};

/// One cell of a distance field: how far it is to the target, and which way to walk.
struct FieldCell {
    float distance;  // m of walking left, finite everywhere; negative: from here the way to the point is
                     // straight
    uint direction;  // unit vector, packSnorm2x16 / glm::packSnorm2x16
};

/// Fields in blocks: cells along a block's side, and along a row of it as it is stored.
const uint FIELD_BLOCK_CELLS_ACROSS = 8u;
const uint FIELD_BLOCK_ROW = 10u;

/// One cell of the coarse map on which detours round jams are worked out.
struct GroundCell {
    float cost;        // >= 1 per metre walked; BLOCKED_COST where nobody can stand
    uint one_way;      // unit direction that may not be walked against, or zero; packSnorm2x16
    uint open_sides;   // OPEN_*: whether one may go to the next cell on that axis, and back
    float free_share;  // of its area, 0 to 1
};
const uint OPEN_TO_X = 1u;
const uint OPEN_TO_Y = 2u;
const float BLOCKED_COST = 1.0e9f;

/// Walking more than this (cosine) against a one-way road is not allowed.
const float AGAINST_ONE_WAY = -0.1f;

THRONG_SHARED_END

#endif
