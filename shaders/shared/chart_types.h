// SPDX-License-Identifier: Apache-2.0
// Charts: parts of the walkable ground that lie side by side in the simulation's plane
// (authoring/storeys/charts.h), shared by C++ and GLSL (std430).
#ifndef THRONG_SHARED_CHART_TYPES_H
#define THRONG_SHARED_CHART_TYPES_H

#include "shaders/shared/both_languages.h"

THRONG_SHARED_BEGIN

const float SHIFT_STEP =
    4.0;  // m: shifts are multiples of it, and so the lattices of everything fit together
const float PLACES_PER_METRE = 65536.0;  // places in the scene are whole multiples of one over this
const uint NO_CHART = 0xffu;
const uint NO_IMAGES = 0xffffffffu;
const uint MOST_IMAGES = 4u;  // charts on which one person may be present besides its own

/// One cell of the raster over the plane.
struct ChartCell {
    uint charts;  // byte 0: the chart whose part of the plane this is; byte 1: the chart whose ground it
                  // shows. NO_CHART: none
    uint images;  // bytes: the charts on which people who are here are present, too
};

/// Ground that moves, of one chart: an escalator or a travelator. In the scene frame, at home.
struct Belt {
    vec2 velocity;     // m/s, in plan; zero: the ground stands
    vec2 begin;        // m: the middle of where people step on
    vec2 along;        // unit vector
    float length;      // m, in plan
    float half_width;  // m, to its railings
    float lane;        // m: the middle of what is left or right of the middle; 0: there is one lane only
    float stand;       // the side where people stand: 1 left, -1 right, 0 both
    float walking;     // share of its people who walk
    uint has_steps;    // 1 = it is climbed as stairs are
};

THRONG_SHARED_END

#endif
