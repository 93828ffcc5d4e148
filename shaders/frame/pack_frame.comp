// SPDX-License-Identifier: Apache-2.0
// Lays out one frame as the streams hold it: all rows, dead or alive. Strides are added when it is written
// (recording/gaits.h).
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer People { Person people[]; };
layout(std430) readonly buffer States { AgentState states[]; };
layout(std430) readonly buffer Stages { Stage stages[]; };
#ifdef SEATS
#include "shaders/shared/seat_types.h"
layout(std430) readonly buffer SitterOfRow { uint sitter_of_row[]; };
layout(std430) readonly buffer SeatWays { SeatWay seat_ways[]; };
layout(std430) readonly buffer SeatPoints { SeatPoint seat_points[]; };
layout(std430) readonly buffer Sitters { Sitter sitters[]; };
#include "shaders/seats/ways.glsl"
#endif
layout(std430) writeonly buffer FrameBlock { float frame[]; };  // positions of all rows, then directions, then states

#include "shaders/shared/alive.glsl"
#include "shaders/shared/charts.glsl"

/// Recordings go back to home coordinates by it; 0 where there are no charts.
float chartNumberAt(vec2 position) {
#ifdef CHARTS
    return float(chartOf(chartCellAt(position)));
#else
    return 0.0;
#endif
}

void put(uint stream, uint row, vec3 value) {
    uint at = (stream * parameters.row_count + row) * 3u;
    frame[at] = value.x;
    frame[at + 1u] = value.y;
    frame[at + 2u] = value.z;
}

/// What somebody who is there does: the stream's first component.
uint activityOf(AgentState state) {
    bool stands = state.status == STATUS_ARRIVED || state.leave_step != 0u;
    if (stands) return stages[state.stage].activity;
    return state.ticket != NO_INDEX ? ACTIVITY_QUEUE : ACTIVITY_WALK;
}

#ifdef SEATS
/// Who is in its seat or on its way there is somewhere above the plane. How far up it is between sitting and standing
/// comes in place of the phase; below 0 it is about to get up.
void putSeated(uint row, AgentState state) {
    uint index = sitter_of_row[row];
    Sitter sitter = sitters[index];
    uint activity = ACTIVITY_WALK;
    if (sitter.mode == SITTER_SITS) activity = sitter.activity;
    if (sitter.mode == SITTER_LETS_GO) activity = ACTIVITY_SIT;
    if (risesOrSettles(sitter.mode)) activity = ACTIVITY_SETTLE;
    bool walks = activity == ACTIVITY_WALK;  // what is told then is how much of the way to the first row is left
    float told = walks ? beforeRows(seat_ways[index], sitter.along)
                       : sitter.mode == SITTER_LETS_GO ? -1.0 : sitter.share;
    put(0u, row, vec3(state.position - seat_ways[index].shift, heightOnWay(seat_ways[index], sitter.along)));
    put(1u, row, vec3(cos(state.heading), sin(state.heading), walks ? length(state.velocity) : 0.0));
    put(2u, row, vec3(float(activity + ACTIVITY_LED), float(people[row].variation), told));
}
#endif

void main() {
    uint row = gl_GlobalInvocationID.x;
    if (row >= parameters.row_count) return;
    AgentState state = states[row];
#ifdef SEATS
    if (state.status == STATUS_SEATED) {
        putSeated(row, state);
        return;
    }
#endif
    bool alive = isAlive(state.status);
    put(0u, row, vec3(state.position, chartNumberAt(state.position)));
    put(1u, row, vec3(cos(state.heading), sin(state.heading), alive ? length(state.velocity) : 0.0));
    put(2u, row, vec3(alive ? float(activityOf(state)) : 0.0, float(people[row].variation), people[row].phase));
}
