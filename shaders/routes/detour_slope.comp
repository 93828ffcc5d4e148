// SPDX-License-Identifier: Apache-2.0
// How fast jams make the way longer: the slope of the difference to an empty place.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = PIXEL_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer FreeDistances { float free_distances[]; };
layout(std430) readonly buffer Ground { GroundCell ground[]; };
layout(std430) readonly buffer DetourDistances { float detour_distances[]; };
layout(std430) writeonly buffer DetourSlopes { vec2 detour_slopes[]; };
layout(std430) readonly buffer FieldMaps { FieldMap field_maps[]; };
layout(std430) readonly buffer ListedBlocks { uint listed_blocks[]; };

#include "shaders/routes/detour_blocks.glsl"
#include "shaders/shared/at_most.glsl"

float delay(uint field, uint cell) {
    float free = free_distances[field * cellsOfMap() + cell];
    return free >= BLOCKED_COST ? -1.0 : max(detour_distances[field * cellsOfMap() + cell] - free, 0.0);
}

/// The delay beyond one side of a cell, or -1 where there is a wall.
float delayBeyond(uint field, uint cell, uint neighbour, bool exists, uint side) {
    if (!exists) return -1.0;
    bool open = (ground[field_maps[field].ground_map * cellsOfMap() + min(cell, neighbour)].open_sides & side) != 0u;
    return open ? delay(field, neighbour) : -1.0;
}

float slope(float low, float here, float high) {
    if (low >= 0.0 && high >= 0.0) return 0.5 * (high - low);
    if (low >= 0.0) return here - low;
    return high >= 0.0 ? high - here : 0.0;
}

void main() {
    uint listed = listed_blocks[gl_WorkGroupID.x], field = listed / blocksOfMap(), width = parameters.detour_width;
    uint cell = listed % blocksOfMap() * PIXEL_GROUP_SIZE + gl_LocalInvocationID.x;
    if (cell >= cellsOfMap()) return;
    float here = delay(field, cell);
    vec2 result = vec2(0.0);
    if (here >= 0.0) {
        uint x = cell % width;
        result.x = slope(delayBeyond(field, cell, cell - 1u, x > 0u, OPEN_TO_X), here,
                         delayBeyond(field, cell, cell + 1u, x + 1u < width, OPEN_TO_X));
        result.y = slope(delayBeyond(field, cell, cell - width, cell >= width, OPEN_TO_Y), here,
                         delayBeyond(field, cell, cell + width, cell + width < cellsOfMap(), OPEN_TO_Y));
    }
    detour_slopes[field * cellsOfMap() + cell] = atMost(result / parameters.detour_cell, ROUTES_ROUND_JAMS_MOST_SLOPE);
}
