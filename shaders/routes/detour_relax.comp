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
uniform usamplerBuffer crowd_flows;  // a CrowdFlow each, as bits
layout(std430) readonly buffer ListedBlocks { uint listed_blocks[]; };
layout(std430) readonly buffer FieldMaps { FieldMap field_maps[]; };
layout(std430) writeonly buffer ChangedBlocks { uint changed_blocks[]; };
layout(std430) writeonly buffer NextDistances { float next_distances[]; };  // of the fields of this round
uniform uint first_field;     // of this round

#include "shaders/routes/detour_blocks.glsl"
#include "shaders/routes/detour_maps.glsl"
#include "shaders/routes/open_sides.glsl"

CrowdFlow crowdAt(uint cell) {
    uvec4 words = texelFetch(crowd_flows, int(cell));
    return CrowdFlow(uintBitsToFloat(words.xy), uintBitsToFloat(words.z), 0.0);
}

/// Which way the nearest of the places is, by the last distances; a unit vector or zero.
vec2 downhill(float here, vec4 beside) {
    vec4 known = mix(vec4(here), beside, lessThan(beside, vec4(BLOCKED_COST)));
    vec2 slope = known.xz - known.yw;
    float size = length(slope);
    return size > 1.0e-6 ? slope / size : vec2(0.0);
}

const float MOST_SLOPE_COST = 2.5;  // stairs: 2.0; more is due to walls beside the way

/// Metres of free walking that leaving a cell to each of its sides is worth. Even through a jam that stands, one gets
/// some time. Who may choose between several places takes a jam for what it is: a door that hundreds wait for is worth
/// a walk to the next one. What counts then is how fast the crowd gets nearer to any of the places; or people would
/// circle with those who circle.
vec4 costsOfLeaving(uint cell, GroundCell ground_here, bool choice, float here, vec4 beside) {
    CrowdFlow crowd = crowdAt(cell);
    vec4 cost = vec4(ground_here.cost * parameters.detour_cell);
    if (crowd.density > ROUTES_ROUND_JAMS_THIN) {
        vec4 along = choice ? vec4(dot(crowd.velocity, downhill(here, beside)))
                            : vec4(-crowd.velocity.x, crowd.velocity.x, -crowd.velocity.y, crowd.velocity.y);
#ifdef CHARTS
        // A crowd that goes up stairs as fast as one does there is no jam: what the ground costs, routes know already.
        along *= clamp(ground_here.cost, 1.0, MOST_SLOPE_COST);
#endif
        float slowest = choice ? ROUTES_ROUND_JAMS_SLOWEST_WITH_CHOICE : ROUTES_ROUND_JAMS_SLOWEST;
        vec4 with_crowd = clamp(along / ROUTES_ROUND_JAMS_FREE_SPEED, slowest, 1.0);
        cost /= mix(vec4(1.0), with_crowd,
                    smoothstep(ROUTES_ROUND_JAMS_THIN, ROUTES_ROUND_JAMS_THICK, crowd.density));
    }
    if (ground_here.one_way != 0u) {
        vec2 way = unpackSnorm2x16(ground_here.one_way);
        cost = mix(cost, vec4(BLOCKED_COST), lessThan(vec4(-way.x, way.x, -way.y, way.y), vec4(AGAINST_ONE_WAY)));
    }
    return cost;
}

/// The better neighbour on one axis: its distance, and the cost of going there.
vec2 betterSide(vec2 low, vec2 high, bool low_is_open, bool high_is_open) {
    vec2 best = vec2(BLOCKED_COST);
    if (low_is_open) best = low;
    if (high_is_open && high.x + high.y < best.x + best.y) best = high;
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

float relaxed(uint field, uint cell, float before) {
    uint first = field * cellsOfMap(), ground_first = field_maps[field].ground_map * cellsOfMap();
    float free = freeDistanceAt(first + cell);
    GroundCell here = groundAt(ground_first + cell);
    // Targets and what nobody reaches stay as they are.
    if (free <= 0.0 || free >= BLOCKED_COST || here.cost >= BLOCKED_COST) return free;
    CellsBeside at = cellsBeside(cell);
    vec4 beside = vec4(detourDistanceAt(first + at.cells.x), detourDistanceAt(first + at.cells.y),
                       detourDistanceAt(first + at.cells.z), detourDistanceAt(first + at.cells.w));
    beside = mix(vec4(BLOCKED_COST), beside, at.exist);
    vec4 cost = costsOfLeaving(cell, here, field_maps[field].has_choice != 0u, before, beside);
    bvec4 open = openBeside(ground_first, at, here.open_sides);
    vec2 x = betterSide(vec2(beside.x, cost.x), vec2(beside.y, cost.y), open.x, open.y);
    vec2 y = betterSide(vec2(beside.z, cost.z), vec2(beside.w, cost.w), open.z, open.w);
    return min(eikonal(x, y), BLOCKED_COST);
}

/// m: smaller changes are none. Rounding and the first solution's own small errors would keep whole maps busy
/// otherwise.
const float SETTLED = 1.0e-3;

void main() {
    uint listed = listed_blocks[gl_WorkGroupID.x];
    ListedCell mine = cellOfBlock(listed);
    if (mine.cell >= cellsOfMap()) return;
    float before = detourDistanceAt(mine.field * cellsOfMap() + mine.cell);
    float after = relaxed(mine.field, mine.cell, before);
    next_distances[(mine.field - first_field) * cellsOfMap() + mine.cell] = after;
    // Several may write, all the same; a barrier would cost more.
    if (abs(after - before) > SETTLED) changed_blocks[listed] = 1u;
}
