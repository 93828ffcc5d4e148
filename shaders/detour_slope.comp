// SPDX-License-Identifier: Apache-2.0
// Keeps a round's distances, and how fast jams make the way longer: the slope of the difference to an empty place.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = PIXEL_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer NextDistances { float next_distances[]; };
layout(std430) readonly buffer FreeDistances { float free_distances[]; };
layout(std430) readonly buffer Ground { GroundCell ground[]; };
layout(std430) writeonly buffer DetourDistances { float detour_distances[]; };
layout(std430) writeonly buffer DetourSlopes { vec2 detour_slopes[]; };
uniform uint field;
uniform uint ground_map;

#include "shaders/flat_index.glsl"
#include "shaders/at_most.glsl"

const float MOST_SLOPE = 4.0;  // enough to turn anybody round; more would only make them flicker

float delay(uint cell) {
    float free = free_distances[field * parameters.detour_width * parameters.detour_height + cell];
    return free >= BLOCKED_COST ? -1.0 : max(next_distances[cell] - free, 0.0);
}

bool isOpen(uint cell, uint side) {
    return (ground[ground_map * parameters.detour_width * parameters.detour_height + cell].open_sides & side) != 0u;
}

float slope(float low, float here, float high) {
    if (low >= 0.0 && high >= 0.0) return 0.5 * (high - low);
    if (low >= 0.0) return here - low;
    return high >= 0.0 ? high - here : 0.0;
}

void main() {
    uint cell = flatIndex();
    uint width = parameters.detour_width, cells = width * parameters.detour_height;
    if (cell >= cells) return;
    detour_distances[field * cells + cell] = next_distances[cell];
    float here = delay(cell);
    vec2 result = vec2(0.0);
    if (here >= 0.0) {
        uint x = cell % width;
        result.x = slope(x > 0u && isOpen(cell - 1u, OPEN_TO_X) ? delay(cell - 1u) : -1.0, here,
                         x + 1u < width && isOpen(cell, OPEN_TO_X) ? delay(cell + 1u) : -1.0);
        result.y = slope(cell >= width && isOpen(cell - width, OPEN_TO_Y) ? delay(cell - width) : -1.0, here,
                         cell + width < cells && isOpen(cell, OPEN_TO_Y) ? delay(cell + width) : -1.0);
    }
    detour_slopes[field * cells + cell] = atMost(result / parameters.detour_cell, MOST_SLOPE);
}
