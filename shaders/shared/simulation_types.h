// SPDX-License-Identifier: Apache-2.0
// Structures and constants of the running simulation, shared by C++ and GLSL (std430).
#ifndef THRONG_SHARED_SIMULATION_TYPES_H
#define THRONG_SHARED_SIMULATION_TYPES_H

#include "shaders/shared/scene_types.h"
#include "shaders/shared/walking.h"

THRONG_SHARED_BEGIN

const uint AGENT_GROUP_SIZE = 64u;   // invocations per group of every pass over agents
const uint SCAN_GROUP_SIZE = 64u;    // invocations per group of a prefix sum
const uint COUNTS_PER_THREAD = 16u;  // counts that one invocation of it adds up
const uint CELLS_PER_STRIP = 64u;    // cells whose people are added up together (cell_starts.glsl)
const uint SPAWN_GROUP_SIZE = 64u;   // people of one queue that may try to enter in one step
const uint PIXEL_GROUP_SIZE = 64u;   // invocations per group of passes over pixels or blocks of pixels

const uint FIELD_BLOCK_SIDE = 16u;    // cells: distance fields are solved in square blocks
const uint FIELD_BLOCK_CELLS = 256u;  // of one block
const float FIELD_FAR = 1.0e30f;      // m: no way is known

const uint SMALLEST_NORMAL = 0x00800000u;  // bits of the smallest float that no device flushes to zero

const uint PAGE_SIDE = 16u;  // px, of a page of a diagram that is not kept whole

const uint STATUS_WAITING = 0u;  // to enter
const uint STATUS_WALKING = 1u;  // under way, or at a stop
const uint STATUS_ARRIVED = 2u;  // and stays there
const uint STATUS_GONE = 3u;     // arrived, and has left the scene
const uint STATUS_SEATED = 4u;   // has a seat, or is on its way between rows: out of everybody's way

/// A neighbour key is a slot, or a wall segment with this bit.
const uint NEIGHBOUR_IS_WALL = 0x80000000u;

/// A touch word counts those who may touch somebody within this step (its low bits) and says where it is.
const uint TOUCH_COUNT_MASK = 0xffffu;
const uint TOUCH_WALL_NEAR = 0x80000000u;    // the cell's list of walls is not empty
const uint TOUCH_WALL_SENSED = 0x40000000u;  // there is a wall among its neighbours
const uint TOUCH_IN_NARROWS = 0x20000000u;   // it is in a narrow passage, or close to one
const uint TOUCH_UNLISTED = 0x10000000u;     // its list does not reach one of them

/// Touch lists hold this many slots; where more bodies crowd together, contact goes back to the cells. They
/// are told by how many slots they come after the person's own: 16 bits, with a sign, two to a word
/// (shaders/shared/touch_list.glsl).
const uint TOUCH_CAPACITY = 24u;
const uint TOUCH_WORDS = TOUCH_CAPACITY / 2u;

/// What is near enough to push somebody in the rounds of a step, where bodies are no discs
/// (shaders/motion/capsules_apart.glsl): a word that counts bodies and says whether walls are near, like a
/// touch word, and counts those; then the slots of bodies; then walls.
const uint NEAR_CAPACITY = 15u;
const uint NEAR_WALLS = 4u;
const uint NEAR_WALLS_AT = 16u;  // where the bits begin that count walls
const uint NEAR_WORDS = 1u + NEAR_CAPACITY + NEAR_WALLS;

/// Wall constraints that one person heeds at a time: the nearest ones.
const uint WALL_CONSTRAINTS = 8u;

/// What changes about one row.
struct AgentState {
    vec2 position;       // m, scene frame
    vec2 velocity;       // m/s, of the last step, contact included
    float heading;       // rad
    float walked;        // m
    uint status;         // STATUS_*
    uint stage;          // index into stages: where it is going
    uint stage_end;      // one past the last of its stages
    uint changes;        // changes of plan already made
    uint leave_step;     // at a stop: how many steps are done when it goes on; otherwise 0
    uint ticket;         // its number in the line that it stands in, or NO_INDEX
    uint spawn_step;     // how many steps were done when it first was there; NO_INDEX = never
    uint arrival_step;   // likewise
    uint attempts;       // how often it asked for room at its entry
    float nervousness;   // 0 to 1: how much it has been held up lately
    float shortest_way;  // m from where it began to its goal, round walls; 0 = not known yet
    float walked_rest;   // m that rounding has dropped from `walked`; wide sites only, as the next
    vec2 rest;           // m that rounding has dropped from the position
};

/// A person in the scene, in the order of the cells ("slot") so that neighbours lie together in memory.
struct Body {
    vec2 position;  // m, at the start of the step
    vec2 velocity;  // m/s
    float radius;   // m
    float heading;  // rad
    uint row;
    float maximum_speed;  // m/s
};

// Beside PERSON_* in the flags of a walker, from one decision to the next:
const uint WALKER_CHART_AT = 8u;          // where the byte begins that says on which belt
const uint WALKER_RIDES = 0x10000u;       // it is on a belt, or about to step on
const uint WALKER_IS_CARRIED = 0x20000u;  // it is on it
const uint WALKER_HELD = 0x40000u;        // it waits before a red crossing
const uint WALKER_IN_DOORS = 0x80000u;    // it gets on or off a vehicle
const uint WALKER_CLIMBS = 0x100000u;     // it goes up stairs
const uint WALKER_DESCENDS = 0x200000u;   // it goes down stairs
const uint WALKER_WAITS = 0x400000u;      // for its company
const uint WALKER_AT_REST = 0x80000000u;  // it has come to rest where it waits
const uint WALKER_IS_IMAGE =
    0x40000000u;  // it is the image of somebody beside a seam (shaders/shared/images.glsl)

/// What else moving somebody takes, by slot, too: looked up once by row, and read in order by the passes that
/// follow.
struct Walker {
    float preferred_speed;  // m/s, and so on as in Person
    uint flags;
    uint status;  // and so on as in AgentState
    uint stage;
    uint stage_end;
    uint leave_step;
    float nervousness;
    uint way_through;  // where its way leads beyond a narrow passage: a direction, packed (snorm 2 x 16)
    // What only some scenes have anything in; shaders/shared/walker.glsl says what is so in the others.
#ifdef HEADWAYS
    float headway;  // as in Person
#endif
#ifdef PARTIES
    uint party_first;  // as in Person
    uint party_size;
#endif
#ifdef PLAN_CHANGES
    uint change_count;  // as in Person
#endif
#ifdef WAITING_LINES
    uint ticket;  // as in AgentState
#endif
#ifdef BODIES
    float half_axis;   // m, as in Person
    float chest;       // rad, at the start of the step, as in Chest
    float chest_rate;  // rad/s
    float axis_x;      // m: from the middle of the body's segment to its end
    float axis_y;
#endif
};

/// Which way the chest of a row points: it follows the heading, and turns aside before gaps and where others
/// push it. Only crowds with bodies that are no discs use it.
struct Chest {
    float angle;          // rad
    float rate;           // rad/s
    float half_axis;      // m, as in Person
    float own_half_axis;  // m: likewise, before what the ground makes of it
};

const uint FEET_IN_TRAFFIC = 1u;  // it senses others who are under way
const uint FEET_WAIT = 2u;        // it waits for its turn in a stream that goes one way
const uint FEET_STILL = 4u;       // it has come to rest, and nobody wants to get past

/// What somebody has decided, until it looks round again.
struct Decision {
    vec2 change;  // m/s, of its velocity in a step
    float pace;   // m/s: how fast it wants to walk behind others
    uint feet;    // 0 or more of FEET_*
#ifdef BODIES
    float twist;  // rad: how far the shoulders are to be turned from the heading, to either side
    uint reserved;
#endif
};

/// Whether the person in a slot is one itself, or the image of one beside a seam
/// (shaders/shared/charts.glsl).
struct SlotImage {
    vec2 shift;   // m: from the person to the image
    uint person;  // the row of the person whose image it is; NO_INDEX: it is no image
    uint reserved;
};

/// What a program of a crowd with bodies that are no discs (BODIES) has more of each person than C++ says,
/// bytes.
const uint MORE_OF_A_BODY = 20u;
const uint MORE_OF_A_DECISION = 8u;

/// A site of the diagram, in pixels from the window's corner.
struct DiagramSite {
    vec2 position;
    float radius;  // the tile's
    uint id;  // agents: the slot, or for pictures the row; wall tiles: the number of rows + the tile's index
};

/// The part of a diagram's work that is done while one band of it is kept (sim/diagram/bands.h): a dispatch
/// over the sites whose places are in it, which stand together, and which those are.
struct Band {
    uint groups_x;
    uint groups_y;
    uint groups_z;
    uint first_slot;
    uint end_slot;
};

/// What a person asks for when it wants to enter.
struct SpawnProposal {
    vec2 position;
    float radius;
    uint row;  // NO_INDEX = does not ask, or there is no room
};

/// How the crowd moves in one cell of the coarse map, smoothed over space and time.
struct CrowdFlow {
    vec2 velocity;  // m/s, mean
    float density;  // persons per square metre
    float reserved;
};

/// One distance field on the coarse map.
struct FieldMap {
    uint ground_map;  // which ground
    uint has_choice;  // 1 = it leads to whichever of several places is nearest
};

/// Everything that stays the same during a bake. Vectors first: GLSL aligns them to eight bytes and C++ to
/// four.
struct Parameters {
    vec2 cells_minimum;    // m
    vec2 diagram_minimum;  // m, corner of pixel (0, 0)
    vec2 grid_minimum;     // m, distance fields
    float cell_size;       // m, at least the contact range and twice the largest radius
    uint cells_width;
    uint cells_height;
    float pixels_per_metre;
    uint diagram_width;
    uint diagram_height;
    float grid_cell;  // m
    uint grid_width;
    uint grid_height;
    float field_cell;          // m, of fields in blocks
    uint field_blocks_across;  // 0 = the cells of fields are those of the grid
    uint field_blocks_up;
    uint cells_per_field;
    float detour_cell;  // m, of the coarse map, which begins where the fields' grid does
    uint detour_width;  // cells; 0 = routes do not heed jams
    uint detour_height;
    uint row_count;
    uint queue_count;
    uint seed;
    float tile_radius;     // m, of agents
    float largest_radius;  // m, of all people
    float step_seconds;
    float decision_seconds;   // from one decision of people to the next: one step or several
    float time_horizon;       // s
    float wall_time_horizon;  // s
    float contact_range;  // m: who are further apart cannot touch before the next decision, however fast they
                          // are
    float contact_gain;   // m/s: how much faster somebody may be by then than it is
    float contact_push;   // m: how far at most others may have moved it by then
    float maximum_acceleration;  // m/s^2
    uint site_rows;              // rows of people, and as many for each image that one may have
    float chart_cell;            // m, of the raster of charts, which begins where the fields' grid does
    uint chart_width;            // cells
    uint chart_height;
};

THRONG_SHARED_END

#ifndef __cplusplus
// Where contact takes somebody: a place, and for bodies that are no discs the axis, as in Walker.
#ifdef BODIES
#define TARGET vec4
#else
#define TARGET vec2
#endif
#endif

#endif
