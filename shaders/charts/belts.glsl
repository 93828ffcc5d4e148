// SPDX-License-Identifier: Apache-2.0
// Ground that moves: escalators and travelators. Velocities of people are relative to the ground that they stand on, so
// who stands there has none, and in a step everybody is carried on by what the ground moves. Only with BELTS.
//
// From one decision to the next, the flags of a walker say on which belt somebody is, or about to step on: programs
// that move people have no room for the raster of charts.
// Needs the block ParametersBlock and shaders/shared/snap.glsl.
#include "shaders/shared/chart_types.h"

layout(std140) uniform Belts { Belt belts[NO_CHART]; };  // by chart

bool isBelt(uint chart) { return chart != NO_CHART && belts[chart].length > 0.0; }

/// The belt that a walker's flags speak of.
uint beltOf(uint walker_flags) { return (walker_flags >> WALKER_CHART_AT) & NO_CHART; }

/// m/s: of the ground under a walker.
vec2 groundUnder(uint walker_flags) {
    return (walker_flags & WALKER_IS_CARRIED) != 0u ? belts[beltOf(walker_flags)].velocity : vec2(0.0);
}

/// m: how far it carries somebody in a step.
vec2 carriedInStep(uint walker_flags) { return snapped(groundUnder(walker_flags) * parameters.step_seconds); }
