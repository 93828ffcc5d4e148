// SPDX-License-Identifier: Apache-2.0
// Counts who of some rows is in the scene, and who of these is inside an outline. It comes before anybody changes its
// mind, so that all look at the same numbers.
#include "shaders/shared/simulation_types.h"
#include "shaders/shared/behaviour_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) readonly buffer Bodies { Body bodies[]; };
layout(std430) readonly buffer Walkers { Walker walkers[]; };
layout(std430) readonly buffer BehaviourPoints { vec2 behaviour_points[]; };
layout(std430) readonly buffer Censuses { Census censuses[]; };
layout(std430) buffer Tallies { Tally tallies[]; };
uniform uint census_count;

#include "shaders/shared/images.glsl"
#include "shaders/behaviour/outlines.glsl"

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= live_count || isImage(walkers[slot].flags)) return;
    uint row = bodies[slot].row;
    for (uint i = 0u; i < census_count; ++i) {
        Census census = censuses[i];
        if (row - census.first_row >= census.row_count) continue;  // below the first, it wraps
        atomicAdd(tallies[i].present, 1u);
        if (isInside(bodies[slot].position, census.first_corner, census.corner_count)) atomicAdd(tallies[i].inside, 1u);
    }
}
