// SPDX-License-Identifier: Apache-2.0
// Whoever has walked over a seam goes on where the other chart lies in the plane. Between two decisions people stay
// where they are: each chart goes on beyond its seams.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) buffer States { AgentState states[]; };

#include "shaders/shared/alive.glsl"
#include "shaders/shared/charts.glsl"
#ifdef BELTS
#include "shaders/shared/snap.glsl"
#include "shaders/charts/moving_ground.glsl"
#endif

#ifdef LIFTS
#include "shaders/charts/lifts.glsl"
layout(std430) readonly buffer LiftStates { LiftState lift_states[]; };

/// Who is in a cabin when it sets out is taken on to the stop to which it goes.
uint takenOn(uint owner) {
    if (owner == NO_CHART || cabin_stops[owner] == NO_INDEX) return owner;
    uint lift = lift_stops[cabin_stops[owner]].lift;
    return lift_stops[lift_plans[lift].first_stop + lift_states[lift].stop].chart;
}
#endif

void main() {
    uint row = gl_GlobalInvocationID.x;
    if (row >= parameters.row_count || !isAlive(states[row].status)) return;
    vec2 position = states[row].position;
    ChartCell cell = chartCellAt(position);
    uint chart = chartOf(cell), owner = ownerOf(cell);
    if (chart == NO_CHART) return;
    if (owner == NO_CHART) owner = chart;
#ifdef LIFTS
    owner = takenOn(owner);
#endif
    states[row].position = position + (chart_shifts[owner] - chart_shifts[chart]);
#ifdef BELTS
    states[row].velocity += velocitySeenFrom(states[row].position, position);
#endif
    states[row].rest = chart_shifts[owner];  // way_between.glsl
}
