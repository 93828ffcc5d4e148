// SPDX-License-Identifier: Apache-2.0
// Whatever people are pushed to: nobody ends a step in a vehicle, which does not give, and nobody who was not on a red
// crossing is on it after.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) readonly buffer Bodies { Body bodies[]; };
layout(std430) readonly buffer TouchWords { uint touch_words[]; };
layout(std430) readonly buffer WallSegments { WallSegment wall_segments[]; };
layout(std430) readonly buffer WallStarts { uint wall_starts[]; };
layout(std430) readonly buffer WallItems { uint wall_items[]; };
layout(std430) buffer Targets { TARGET targets[]; };

#include "shaders/traffic/boxes.glsl"
layout(std430) readonly buffer Crossings { TrafficCrossing crossings[]; };
layout(std430) readonly buffer CrossingPoints { vec2 crossing_points[]; };
layout(std430) readonly buffer Lights { uint lights[]; };
#include "shaders/traffic/crossings.glsl"
#include "shaders/cells/cells.glsl"
#include "shaders/cells/walls_near.glsl"
#include "shaders/shared/walls.glsl"
#include "shaders/motion/out_of_walls.glsl"

#ifdef DOORS
#include "shaders/boarding/passengers.glsl"
layout(std430) readonly buffer Platforms { Platform platforms[]; };
layout(std430) readonly buffer VehicleServices { VehicleService services[]; };
layout(std430) readonly buffer Passengers { uint passengers[]; };

/// Who gets on or off is between the leaves of its door, and else out of the vehicle.
bool isInDoorway(uint passenger, uint vehicle, float radius, vec2 from, inout vec2 place) {
    bool goes_through = phaseOf(passenger) == PASSENGER_BOARDS || phaseOf(passenger) == PASSENGER_ALIGHTS;
    VehicleService service = services[vehicle];
    if (!goes_through || vehicleOf(passenger) != vehicle || service.platform == NO_INDEX) return false;
    Doorway doorway = doorwayOf(vehicle_boxes[vehicle], vehicle_doors[service.first_door + doorOf(passenger)],
                                platforms[service.platform].side);
    float room = roomInDoorway(doorway, radius);
    vec2 was = throughDoorway(doorway, from), at = throughDoorway(doorway, place);
    bool is_in = (was.x > -radius && abs(was.y) <= room + HAIR_FROM_VEHICLES) || abs(at.y) <= room;
    if (!is_in) return false;
    if (at.x > -radius) place = atDoorway(doorway, vec2(at.x, clamp(at.y, -room, room)));
    return true;
}
#endif

vec2 outOfVehicles(uint row, vec2 from, vec2 place, float radius) {
    for (uint i = 0u; i < VEHICLES; ++i) {
        VehicleBox box = vehicle_boxes[i];
        if (box.half_width <= 0.0) continue;
#ifdef DOORS
        if (isInDoorway(passengers[row], i, radius, from, place)) continue;
#endif
        vec2 outward;
        float away = distanceToBox(place, box.rear, box.front, box.half_width, outward);
        if (away < radius) place += outward * (radius + HAIR_FROM_VEHICLES - away);
    }
    return place;
}

bool isOnRed(vec2 place) {
    for (uint i = 0u; i < CROSSINGS; ++i)
        if (isRed(crossings[i].light) && isOnCrossing(crossings[i], place)) return true;
    return false;
}

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= live_count) return;
    Body self = bodies[slot];
    vec2 target = targets[slot].xy, place = target;
    if (isOnRed(place) && !isOnRed(self.position)) place = self.position;
    place = outOfVehicles(self.row, self.position, place, self.radius);
    if (place == target) return;
    if ((touch_words[slot] & TOUCH_WALL_NEAR) != 0u) place = keepOutOfWalls(self, place);
    targets[slot].xy = place;
}
