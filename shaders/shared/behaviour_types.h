// SPDX-License-Identifier: Apache-2.0
// Structures of behaviours, read by the C++ compiler and by the GLSL compiler alike (std430): a table of
// states, of the rules that lead from one to another, and what each person has in mind.
#ifndef THRONG_SHARED_BEHAVIOUR_TYPES_H
#define THRONG_SHARED_BEHAVIOUR_TYPES_H

#include "shaders/shared/both_languages.h"

THRONG_SHARED_BEGIN

const uint DOES_WALK = 0u;    // to a place
const uint DOES_STAY = 1u;    // where it is
const uint DOES_WANDER = 2u;  // about an area
const uint DOES_VISIT = 3u;   // some of several places
const uint DOES_GATHER = 4u;  // at a spot of its own in a place
const uint DOES_FLEE = 5u;    // from a point
const uint DOES_FOLLOW = 6u;  // the nearest of some rows
const uint DOES_QUEUE = 7u;   // in a line, whose first one is served
const uint DOES_SIT = 8u;     // in a seat of its own

const uint STATE_LEAVES = 1u;    // at the end of its way one leaves the scene
const uint STATE_FOR_GOOD = 2u;  // who has come to rest in it has arrived
const uint STATE_NEAREST = 4u;   // of its places the nearest; otherwise one is drawn by weight
const uint STATE_FACES = 8u;     // there is a point that one faces

/// A number of each person's own, as the layout's distributions are.
struct Drawn {
    uint kind;  // 0 constant, 1 uniform, 2 normal, 3 log-normal
    float mean;
    float deviation;
    float minimum;
    float maximum;
};

/// What somebody does, until a rule leads to another state or it is done.
struct BehaviourState {
    vec2 facing;  // m; with STATE_FACES
    vec2 from;    // m; flee: what from, where there are no rows
    uint does;    // DOES_*
    uint flags;   // STATE_*
    uint first_rule;
    uint rule_count;
    uint then;  // the state after it is done, or NO_INDEX
    uint first_place;
    uint place_count;
    uint activity;   // of those who have come to rest
    uint least;      // visit: so many places
    uint most;       // visit: at most
    uint first_row;  // follow, flee: of these rows the nearest
    uint row_count;
    float distance;  // m; flee: so far is enough; follow: so far behind
    float pace;      // of the preferred speed
    Drawn lasts;     // s at each place; DWELL_WHILE: until something else happens
    uint line;       // queue: index into the waiting lines
};

/// Longer than any shot: who stands for so long goes on only when a rule says so.
const float DWELL_WHILE = 1.0e5f;

/// Somewhere that states lead to.
struct BehaviourPlace {
    vec2 middle;       // m
    vec2 facing;       // m; what one looks at there
    uint field;        // that leads there
    uint first_point;  // spots, clear of walls
    uint point_count;
    uint first_corner;  // of its outline
    uint corner_count;
    float weight;
};

const uint IF_AFTER = 0u;        // so long in the state
const uint IF_AT = 1u;           // this time of the shot has come
const uint IF_ARRIVED = 2u;      // it stands at its place, or has come to the end of its way
const uint IF_NEAR_PLACE = 3u;   // no further from an outline
const uint IF_NEAR_PEOPLE = 4u;  // no further from one of some rows
const uint IF_CROWDED = 5u;      // more persons/m^2 around
const uint IF_CHANCE = 6u;       // so large a share per second
const uint IF_EMPTY = 7u;        // of a census, nobody else is inside
const uint IF_ALL_HERE = 8u;     // of a census, everybody is inside
const uint IF_OPEN = 9u;         // a gate
const uint IF_CLOSED = 10u;      // a gate
const uint IF_GREEN = 11u;       // a crossing or lane, by its signal
const uint IF_RED = 12u;         // likewise

/// A condition, and where it leads.
struct BehaviourRule {
    uint condition;  // IF_*
    uint then;       // the next state; NO_INDEX: the next rule has to hold, too
    uint subject;    // a census; open, closed: 1 = the gate is open at first
    uint first;      // corners, rows, moments at which the gate moves, or when it is green, s into the cycle
    uint count;
    float number;  // m, persons/m^2, share, or s of a signal's cycle
    Drawn time;    // s; green, red: its mean is how far into the cycle the signal is at time 0
    uint reserved;
};

/// People of some rows in an outline are counted.
struct Census {
    uint first_corner;
    uint corner_count;
    uint first_row;
    uint row_count;
};

struct Tally {
    uint present;  // of the rows, in the scene
    uint inside;
};

const uint MIND_NEEDS_GOAL = 1u;  // where to go is still to be told
const uint MIND_COMES_IN = 2u;    // wander: it is still on its way into the place
const uint MIND_IS_SAFE = 4u;     // flee from people: none of them is near

/// What a row has in mind.
struct Mind {
    uint state;        // NO_INDEX: it has no behaviour
    uint since;        // how many steps were done when the state began
    uint entered;      // how many states it has been in; 0 = not begun
    uint visited;      // places of the state, one bit each
    uint visits_left;  // of the state
    uint place;        // of the state, where it goes or is
    uint picks;        // goals chosen in the state
    uint flags;        // MIND_*
    uint first_stage;  // of two of its own: where it goes, and what comes when it has been there
    uint followed;     // row
    uint let_go;  // how many steps were done when it began to end what it did with its hands; 0: it does not
    uint next;    // the state that comes then
    uint seat;    // sit: the aisle to its seat, of the state's places
};

THRONG_SHARED_END

#endif
