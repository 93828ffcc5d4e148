// SPDX-License-Identifier: Apache-2.0
// One round of bringing one field's walking distances up to date with the crowd.
//
// Who can see that the crowd ahead stands, or comes the other way, walks round it. The way costs as many metres as one
// could have walked in the same time without a crowd: where it is dense, one gets on as fast as the crowd moves in
// one's own direction, and next to not at all against it (Treuille, Cooper and Popovic 2006, equations 4, 7 and 8).
// Walking with a stream is therefore cheap, and lanes attract those who go the same way.
//
// The distances obey the Eikonal equation with these costs. Every round recomputes each cell from its neighbours' last
// values (Jacobi), so news of a jam spreads by one cell a round, and no order of invocations shows in the result.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = PIXEL_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer CrowdFlows { CrowdFlow crowd_flows[]; };
layout(std430) readonly buffer Ground { GroundCell ground[]; };
layout(std430) readonly buffer DetourDistances { float detour_distances[]; };
layout(std430) readonly buffer FreeDistances { float free_distances[]; };  // without any crowd
layout(std430) readonly buffer ListedBlocks { uint listed_blocks[]; };
layout(std430) readonly buffer FieldMaps { FieldMap field_maps[]; };
layout(std430) writeonly buffer ChangedBlocks { uint changed_blocks[]; };
layout(std430) writeonly buffer NextDistances { float next_distances[]; };  // of the fields of this round
uniform uint first_field;     // of this round

#include "shaders/routes/detour_blocks.glsl"

float detourOr(uint field, uint cell, bool exists, float otherwise) {
    float distance = exists ? detour_distances[field * cellsOfMap() + cell] : otherwise;
    return distance < BLOCKED_COST ? distance : otherwise;
}

/// Which way the nearest of the places is, by the last distances; a unit vector or zero.
vec2 downhill(uint field, uint cell) {
    uint width = parameters.detour_width, x = cell % width;
    float here = detour_distances[field * cellsOfMap() + cell];
    vec2 slope = vec2(detourOr(field, cell - 1u, x > 0u, here) - detourOr(field, cell + 1u, x + 1u < width, here),
                      detourOr(field, cell - width, cell >= width, here) -
                          detourOr(field, cell + width, cell + width < cellsOfMap(), here));
    float size = length(slope);
    return size > 1.0e-6 ? slope / size : vec2(0.0);
}

/// Metres of free walking that leaving a cell in this direction is worth. Even through a jam that stands, one gets some
/// time. Who may choose between several places takes a jam for what it is: a door that hundreds wait for is worth a
/// walk to the next one. What counts then is how fast the crowd gets nearer to any of the places; or people would
/// circle with those who circle.
float costTowards(uint field, uint cell, GroundCell here, vec2 direction) {
    if (dot(unpackSnorm2x16(here.one_way), direction) < AGAINST_ONE_WAY) return BLOCKED_COST;
    CrowdFlow crowd = crowd_flows[cell];
    bool choice = field_maps[field].has_choice != 0u;
    float along = dot(crowd.velocity, choice ? downhill(field, cell) : direction);
    float slowest = choice ? ROUTES_ROUND_JAMS_SLOWEST_WITH_CHOICE : ROUTES_ROUND_JAMS_SLOWEST;
    float with_crowd = clamp(along / ROUTES_ROUND_JAMS_FREE_SPEED, slowest, 1.0);
    float speed = mix(1.0, with_crowd, smoothstep(ROUTES_ROUND_JAMS_THIN, ROUTES_ROUND_JAMS_THICK, crowd.density));
    return here.cost * parameters.detour_cell / speed;
}

/// The better neighbour on one axis: its distance, and the cost of going there.
vec2 betterSide(uint field, uint cell, GroundCell here, bool has_low, bool has_high, uint stride, vec2 axis) {
    vec2 best = vec2(BLOCKED_COST);
    uint side = axis.x > 0.0 ? OPEN_TO_X : OPEN_TO_Y;
    uint first = field * cellsOfMap();
    if (has_low && (ground[field_maps[field].ground_map * cellsOfMap() + cell - stride].open_sides & side) != 0u)
        best = vec2(detour_distances[first + cell - stride], costTowards(field, cell, here, -axis));
    if (has_high && (here.open_sides & side) != 0u) {
        vec2 high = vec2(detour_distances[first + cell + stride], costTowards(field, cell, here, axis));
        if (high.x + high.y < best.x + best.y) best = high;
    }
    return best;
}

/// (T - Tx)^2 / Cx^2 + (T - Ty)^2 / Cy^2 = 1, or along one axis where that is shorter.
float eikonal(vec2 x, vec2 y) {
    float one_axis = min(x.x + x.y, y.x + y.y);
    if (max(x.x, y.x) >= one_axis) return one_axis;
    float a = 1.0 / (x.y * x.y), b = 1.0 / (y.y * y.y);
    float difference = x.x - y.x;
    float inside = a + b - a * b * difference * difference;
    return inside <= 0.0 ? one_axis : min(one_axis, (a * x.x + b * y.x + sqrt(inside)) / (a + b));
}

float relaxed(uint field, uint cell) {
    float free = free_distances[field * cellsOfMap() + cell];
    GroundCell here = ground[field_maps[field].ground_map * cellsOfMap() + cell];
    // Targets and what nobody reaches stay as they are.
    if (free <= 0.0 || free >= BLOCKED_COST || here.cost >= BLOCKED_COST) return free;
    uvec2 at = uvec2(cell % parameters.detour_width, cell / parameters.detour_width);
    uint width = parameters.detour_width;
    vec2 x = betterSide(field, cell, here, at.x > 0u, at.x + 1u < width, 1u, vec2(1.0, 0.0));
    vec2 y = betterSide(field, cell, here, at.y > 0u, at.y + 1u < parameters.detour_height, width, vec2(0.0, 1.0));
    return min(eikonal(x, y), BLOCKED_COST);
}

/// m: smaller changes are none. Rounding and the first solution's own small errors would keep whole maps busy
/// otherwise.
const float SETTLED = 1.0e-3;

void main() {
    uint listed = listed_blocks[gl_WorkGroupID.x], field = listed / blocksOfMap();
    uint cell = listed % blocksOfMap() * PIXEL_GROUP_SIZE + gl_LocalInvocationID.x;
    if (cell >= cellsOfMap()) return;
    float before = detour_distances[field * cellsOfMap() + cell];
    float after = relaxed(field, cell);
    next_distances[(field - first_field) * cellsOfMap() + cell] = after;
    // Several may write, all the same; a barrier would cost more.
    if (abs(after - before) > SETTLED) changed_blocks[listed] = 1u;
}
