// SPDX-License-Identifier: Apache-2.0
// How fast jams make the way longer: the slope of the difference to an empty place.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = PIXEL_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) writeonly buffer DetourSlopes { vec2 detour_slopes[]; };
layout(std430) readonly buffer FieldMaps { FieldMap field_maps[]; };
layout(std430) readonly buffer ListedBlocks { uint listed_blocks[]; };

#include "shaders/routes/detour_blocks.glsl"
#include "shaders/routes/detour_maps.glsl"
#include "shaders/routes/open_sides.glsl"
#include "shaders/shared/at_most.glsl"

/// By how much a jam makes the way from a cell longer, or -1 where no way leads from.
float delay(uint index) {
    float free = freeDistanceAt(index);
    return free >= BLOCKED_COST ? -1.0 : max(detourDistanceAt(index) - free, 0.0);
}

/// The same beyond each side of a cell, or -1 where there is a wall.
vec4 delaysBeside(uint field, uint cell) {
    uint first = field * cellsOfMap(), ground_first = field_maps[field].ground_map * cellsOfMap();
    CellsBeside at = cellsBeside(cell);
    bvec4 open = openBeside(ground_first, at, groundAt(ground_first + cell).open_sides);
    vec4 beside = vec4(delay(first + at.cells.x), delay(first + at.cells.y), delay(first + at.cells.z),
                       delay(first + at.cells.w));
    return mix(vec4(-1.0), beside, open);
}

float slope(float low, float here, float high) {
    if (low >= 0.0 && high >= 0.0) return 0.5 * (high - low);
    if (low >= 0.0) return here - low;
    return high >= 0.0 ? high - here : 0.0;
}

void main() {
    ListedCell mine = cellOfBlock(listed_blocks[gl_WorkGroupID.x]);
    if (mine.cell >= cellsOfMap()) return;
    uint index = mine.field * cellsOfMap() + mine.cell;
    float here = delay(index);
    vec4 beside = delaysBeside(mine.field, mine.cell);
    vec2 result =
        here < 0.0 ? vec2(0.0) : vec2(slope(beside.x, here, beside.y), slope(beside.z, here, beside.w));
    detour_slopes[index] = atMost(result / parameters.detour_cell, ROUTES_ROUND_JAMS_MOST_SLOPE);
}
