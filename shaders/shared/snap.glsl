// SPDX-License-Identifier: Apache-2.0
// Places in the plane of charts are whole multiples of 2^-16 m, as those of the scene are: so a shift from one chart to
// another rounds nothing, and who walks over a seam goes on as if there were none. What is added to a place is snapped
// before, not the sum: a sum rounds differently in different parts of the plane.

#ifdef CHARTS
#include "shaders/shared/chart_types.h"

vec2 snapped(vec2 way) { return round(way * PLACES_PER_METRE) / PLACES_PER_METRE; }
#else
vec2 snapped(vec2 way) { return way; }
#endif
