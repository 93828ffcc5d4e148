// SPDX-License-Identifier: Apache-2.0
// Charts: parts of the walkable ground that lie side by side in the simulation's plane
// (authoring/storeys/charts.h), shared by C++ and GLSL (std430).
#ifndef THRONG_SHARED_CHART_TYPES_H
#define THRONG_SHARED_CHART_TYPES_H

#include "shaders/shared/both_languages.h"

THRONG_SHARED_BEGIN

const float SHIFT_STEP =
    4.0;  // m: shifts are multiples of it, and so the lattices of everything fit together
const uint NO_CHART = 0xffu;
const uint NO_IMAGES = 0xffffffffu;
const uint MOST_IMAGES = 4u;  // charts on which one person may be present besides its own

/// One cell of the raster over the plane.
struct ChartCell {
    uint charts;  // byte 0: the chart whose part of the plane this is; byte 1: the chart whose ground it
                  // shows. NO_CHART: none
    uint images;  // bytes: the charts on which people who are here are present, too
};

THRONG_SHARED_END

#endif
