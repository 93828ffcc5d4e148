// SPDX-License-Identifier: Apache-2.0
// In the cabin of a lift, one is as far as at the stop to which it takes one, and the ride, and as many more rounds of
// the cabin as those who wait need. One invocation for a field: stops lead to each other.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = PIXEL_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer RideCells { uvec4 ride_cells[]; };  // from, to, where one gets in, 0
layout(std430) readonly buffer RideCosts { vec2 ride_costs[]; };   // m: what it takes, and more for each who waits
layout(std430) readonly buffer LiftQueues { uint lift_queues[]; };
layout(std430) readonly buffer FreeDistances { float free_distances[]; };
layout(std430) buffer DetourDistances { float detour_distances[]; };
layout(std430) writeonly buffer ChangedBlocks { uint changed_blocks[]; };
uniform uint ride_count;
uniform uint first_field;  // of this round
uniform uint field_count;

#include "shaders/shared/flat_index.glsl"
#include "shaders/routes/detour_blocks.glsl"

void main() {
    uint index = flatIndex();
    if (index >= field_count) return;
    uint first = (first_field + index) * cellsOfMap();
    for (uint i = 0u; i < ride_count; ++i) {
        uint from = first + ride_cells[i].x;
        uint waiting = lift_queues[ride_cells[i].z];
        float cost = ride_costs[i].x + ride_costs[i].y * float(waiting);
        float found = detour_distances[first + ride_cells[i].y] + cost;
        if (free_distances[from] >= BLOCKED_COST) continue;
        // What was found when fewer waited is worked out anew (detour_relax.comp).
        if (found >= detour_distances[from] && waiting == 0u) continue;
        detour_distances[from] = min(found, detour_distances[from]);
        changed_blocks[(first_field + index) * blocksOfMap() + ride_cells[i].x / PIXEL_GROUP_SIZE] = 1u;
    }
}
