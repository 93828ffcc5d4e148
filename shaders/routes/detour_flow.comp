// SPDX-License-Identifier: Apache-2.0
// How dense the crowd is in each cell of the coarse map, and where it goes on the whole.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = PIXEL_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer Ground { GroundCell ground[]; };
layout(std430) readonly buffer Bodies { Body bodies[]; };
layout(std430) buffer CrowdFlows { CrowdFlow crowd_flows[]; };
layout(std430) writeonly buffer DenseBlocks { uint dense_blocks[]; };  // 1 where the crowd matters to routes
uniform float fading;  // 0 to 1: how much of what was known is replaced

#include "shaders/cells/cells.glsl"
#include "shaders/cells/cell_starts.glsl"
#include "shaders/shared/flat_index.glsl"
#include "shaders/shared/quotient.glsl"
#include "shaders/shared/charts.glsl"
#ifdef BELTS
#include "shaders/shared/snap.glsl"
#include "shaders/charts/moving_ground.glsl"

/// Who is carried gets on, standing or not: what ground that moves makes of the way, routes know already.
vec2 progressOf(Body body) {
    uint chart = chartOf(chartCellAt(body.position));
    return isBelt(chart) ? body.velocity + belts[chart].along * ROUTES_ROUND_JAMS_FREE_SPEED : body.velocity;
}
#else
vec2 progressOf(Body body) { return body.velocity; }
#endif

/// Walls take part of some cells, and people crowd in the rest. Everybody within one coarse cell of the middle counts,
/// the nearer the more (a tent, whose integral is the area of one coarse cell).
CrowdFlow flowAround(vec2 middle, float free_share) {
    ivec2 low = cellOf(middle - parameters.detour_cell);
    ivec2 high = cellOf(middle + parameters.detour_cell);
    vec3 sum = vec3(0.0);
    for (int y = low.y; y <= high.y; ++y) {
        uint end = cellStart(cellIndex(ivec2(high.x, y)) + 1u);
        for (uint slot = cellStart(cellIndex(ivec2(low.x, y))); slot < end; ++slot) {
            vec2 near = max(1.0 - abs(bodies[slot].position - middle) / parameters.detour_cell, vec2(0.0));
            sum += near.x * near.y * vec3(progressOf(bodies[slot]), 1.0);
        }
    }
    float area = parameters.detour_cell * parameters.detour_cell * max(free_share, ROUTES_ROUND_JAMS_LEAST_SHARE);
    return CrowdFlow(sum.z > 1.0e-3 ? sum.xy / sum.z : vec2(0.0), sum.z / area, 0.0);
}

#ifdef LIFTS
#include "shaders/charts/lifts.glsl"

/// Who stands in a cabin is no jam.
bool isCabin(vec2 place) {
    uint chart = chartOf(chartCellAt(place));
    return chart != NO_CHART && cabin_stops[chart] != NO_INDEX;
}
#else
bool isCabin(vec2 place) { return false; }
#endif

/// Brings one cell up to date. @returns its density
float look(uint cell) {
    vec2 at = vec2(quotientAndRemainder(cell, parameters.detour_width).yx) + 0.5;
    vec2 middle = parameters.grid_minimum + at * parameters.detour_cell;
    CrowdFlow now = flowAround(middle, ground[cell].free_share);
    if (isCabin(middle)) now = CrowdFlow(vec2(0.0), 0.0, 0.0);
    CrowdFlow known = crowd_flows[cell];
    CrowdFlow mixed = CrowdFlow(mix(known.velocity, now.velocity, fading),
                                mix(known.density, now.density, fading), 0.0);
    crowd_flows[cell] = mixed;
    return mixed.density;
}

void main() {
    uint cell = flatIndex();
    if (cell >= parameters.detour_width * parameters.detour_height) return;
    // A little below what matters, so that routes learn that it does not any more. Several may write, all the same.
    if (look(cell) > 0.9 * ROUTES_ROUND_JAMS_THIN) dense_blocks[cell / PIXEL_GROUP_SIZE] = 1u;
}
