// SPDX-License-Identifier: Apache-2.0
// What drivers see of people: for each vehicle, where the nearest person in its way is, and for each crossing of a
// lane, whether anybody is on it, or about to step on, who has not passed the lane already.
#include "shaders/shared/simulation_types.h"
#include "shaders/shared/traffic_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer People { Person people[]; };
layout(std430) readonly buffer States { AgentState states[]; };
layout(std430) readonly buffer Vehicles { Vehicle vehicles[]; };
layout(std430) readonly buffer Lanes { TrafficLane lanes[]; };
layout(std430) readonly buffer LanePoints { LanePoint lane_points[]; };
layout(std430) readonly buffer TrafficStops { TrafficStop stops[]; };
layout(std430) readonly buffer Crossings { TrafficCrossing crossings[]; };
layout(std430) readonly buffer CrossingPoints { vec2 crossing_points[]; };
layout(std430) readonly buffer Lights { uint lights[]; };
layout(std430) buffer InTheWay { uint in_the_way[]; };

#include "shaders/shared/alive.glsl"
#include "shaders/traffic/in_the_way.glsl"
#include "shaders/traffic/lane_places.glsl"
#include "shaders/traffic/crossings.glsl"

const float ROOM_BESIDE = 0.3;      // m: drivers stop for whoever is nearer than this beside their way
const float WIDEST = 1.3;           // m: half of it
const float ABOUT_TO_STEP_ON = 1.0; // m
const float PAST = 0.6;             // m: who is further from a lane and leaves it is no reason to wait

#ifdef DOORS
#include "shaders/shared/boarding_types.h"
layout(std430) readonly buffer Platforms { Platform platforms[]; };
layout(std430) readonly buffer PlatformPoints { vec2 platform_points[]; };
#include "shaders/traffic/platforms.glsl"
const float ROOM_BESIDE_PLATFORMS = 0.05;  // m: who stands there knows what comes, and drivers that they do

float roomBeside(vec2 place) {
    for (uint i = 0u; i < PLATFORMS; ++i)
        if (isOnPlatform(platforms[i], place)) return ROOM_BESIDE_PLATFORMS;
    return ROOM_BESIDE;
}
#else
float roomBeside(vec2 place) { return ROOM_BESIDE; }
#endif

void standInTheWay(uint lane, float along, float beside, float radius, float room) {
    for (uint i = 0u; i < VEHICLES; ++i) {
        if (vehicles[i].lane != lane || !isThere(vehicles[i].status)) continue;
        if (along + radius <= vehicles[i].along || beside > vehicles[i].half_width + radius + room)
            continue;
        atomicMin(in_the_way[i], floatBitsToUint(max(along - radius, 0.0)));
    }
}

/// @param from_lane m: from the nearest point of the lane
void holdBeforeCrossing(uint stop, AgentState state, vec2 from_lane, float radius) {
    TrafficCrossing crossing = crossings[stops[stop].crossing];
    float apart = length(from_lane);
    if (apart > WIDEST + radius + PAST && dot(state.velocity, from_lane) > 0.0) return;
    vec2 ahead = vec2(cos(state.heading), sin(state.heading));
    bool may_step_on = state.status == STATUS_WALKING && state.leave_step == 0u && !isRed(crossing.light);
    if (isOnCrossing(crossing, state.position))
        atomicMin(in_the_way[atStop(stop)], SOMEBODY_IS_ON);
    else if (may_step_on && isOnCrossing(crossing, state.position + ahead * ABOUT_TO_STEP_ON))
        atomicMin(in_the_way[atStop(stop)], SOMEBODY_COMES);
}

void main() {
    uint row = gl_GlobalInvocationID.x;
    if (row >= parameters.row_count || !isAlive(states[row].status)) return;
    AgentState state = states[row];
    float radius = people[row].radius;
    for (uint lane = 0u; lane < LANES; ++lane) {
        vec2 from_lane;
        float along = nearestAlongLane(lane, state.position, from_lane);
        float beside = length(from_lane);
        if (beside <= WIDEST + radius + ROOM_BESIDE)
            standInTheWay(lane, along, beside, radius, roomBeside(state.position));
        uint first = lanes[lane].first_stop;
        for (uint stop = first; stop < first + lanes[lane].stop_count; ++stop)
            if (stops[stop].kind == STOP_FOR_PEOPLE) holdBeforeCrossing(stop, state, from_lane, radius);
    }
}
