// SPDX-License-Identifier: Apache-2.0
// What those want who have to do with a door of a vehicle, in place of what their routes say: to wait beside the way
// out of it, to go in when they have been asked, and to get off.
#include "shaders/shared/simulation_types.h"
#include "shaders/shared/traffic_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) readonly buffer Bodies { Body bodies[]; };
layout(std430) buffer Walkers { Walker walkers[]; };
layout(std430) writeonly buffer PreferredVelocities { vec2 preferred_velocities[]; };
#include "shaders/traffic/boxes.glsl"
#include "shaders/boarding/passengers.glsl"
layout(std430) readonly buffer Platforms { Platform platforms[]; };
layout(std430) readonly buffer PlatformPoints { vec2 platform_points[]; };
layout(std430) readonly buffer VehicleServices { VehicleService services[]; };
layout(std430) readonly buffer DoorStates { DoorState door_states[]; };
layout(std430) readonly buffer Passengers { uint passengers[]; };

#include "shaders/shared/images.glsl"
#include "shaders/shared/outline.glsl"
#include "shaders/shared/random.glsl"
#include "shaders/traffic/platforms.glsl"
#include "shaders/boarding/waiting_beside.glsl"

const float NEAR_SPOT = 0.3;   // m from where it waits
const float STROLL = 1.1;      // m/s, before doors
const float SETTLING = 0.5;    // s
const float OUTSIDE = 1.4;     // m before the doors: who gets off makes for there
const float WITHIN = 1.0;      // m behind them
const float LINES_UP = 0.25;   // m before them, who goes in has to be between the jambs

struct Way {
    vec2 to;          // m
    bool goes_through;
};

/// A spot that is on the platform, on the other side of the door where it is not on this one.
vec2 spotBeside(Platform platform, Doorway doorway, uint row, uint waiting, float radius, vec2 place) {
    vec2 at = waitingBeside(doorway, row, waiting, radius);
    if (!isOnPlatform(platform, atDoorway(doorway, at))) at.y = -at.y;
    vec2 spot = atDoorway(doorway, at);
    return isOnPlatform(platform, spot) ? spot : place;
}

Way wayOf(uint passenger, uint row, vec2 place, float radius) {
    uint vehicle = vehicleOf(passenger);
    VehicleService service = services[vehicle];
    Platform platform = platforms[service.platform];
    uint door = service.first_door + doorOf(passenger);
    Doorway doorway = doorwayOf(vehicle_boxes[vehicle], vehicle_doors[door], platform.side);
    if (phaseOf(passenger) == PASSENGER_CALLED)
        return Way(spotBeside(platform, doorway, row, door_states[door].waiting, radius, place), false);
    vec2 at = throughDoorway(doorway, place);
    float room = roomInDoorway(doorway, radius), aside = clamp(at.y, -room, room);
    if (phaseOf(passenger) == PASSENGER_ALIGHTS) return Way(atDoorway(doorway, vec2(-OUTSIDE, aside)), true);
    bool fits = abs(at.y) <= room + 0.05;
    return Way(atDoorway(doorway, vec2(fits ? WITHIN : -radius - LINES_UP, aside)), true);
}

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= live_count || isImage(walkers[slot].flags)) return;
    uint row = bodies[slot].row, passenger = passengers[row];
    if (phaseOf(passenger) == PASSENGER_NONE || services[vehicleOf(passenger)].platform == NO_INDEX) return;
    Way way = wayOf(passenger, row, bodies[slot].position, bodies[slot].radius);
    vec2 offset = way.to - bodies[slot].position;
    float left = length(offset);
    float speed = min(walkers[slot].preferred_speed, STROLL);
    if (way.goes_through) {
        walkers[slot].flags = (walkers[slot].flags & ~PERSON_KEEPS_TO_ROADS) | WALKER_IN_DOORS;
        walkers[slot].flags &= ~WALKER_AT_REST;
        preferred_velocities[slot] = offset * (speed / max(left, 1.0e-6));
        return;
    }
    walkers[slot].flags |= WALKER_HELD;
    bool stands = left <= NEAR_SPOT;
    if (stands) walkers[slot].flags |= WALKER_AT_REST; else walkers[slot].flags &= ~WALKER_AT_REST;
    preferred_velocities[slot] = stands ? vec2(0.0) : offset * (min(speed, left / SETTLING) / left);
}
