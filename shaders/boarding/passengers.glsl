// SPDX-License-Identifier: Apache-2.0
// Who has to do with which door of which vehicle, and where that is. Only with DOORS.
// Needs shaders/traffic/boxes.glsl.
#include "shaders/shared/boarding_types.h"

layout(std430) readonly buffer VehicleDoors { VehicleDoor vehicle_doors[]; };  // vehicle after vehicle

uint phaseOf(uint passenger) { return passenger & PASSENGER_PHASE; }
uint vehicleOf(uint passenger) { return passenger & 0x1ffu; }
uint doorOf(uint passenger) { return passenger >> 12u & 0xfu; }
uint passengerFor(uint phase, uint vehicle, uint door) { return phase | vehicle | door << 12u; }

/// A door of a vehicle that stands at a platform.
struct Doorway {
    vec2 middle;   // m: between its leaves
    vec2 inward;   // unit vector
    float half_width;
};

/// @param side of the vehicle: 1 left, -1 right
Doorway doorwayOf(VehicleBox box, VehicleDoor door, float side) {
    vec2 along = normalize(box.front - box.rear), left = vec2(-along.y, along.x);
    return Doorway(box.front - along * door.behind + left * (side * box.half_width), -side * left, door.half_width);
}

bool opensOn(VehicleDoor door, float side) { return (door.sides & (side > 0.0 ? DOOR_ON_LEFT : DOOR_ON_RIGHT)) != 0u; }

/// How far inside somebody is, below 0 outside, and how far aside of the middle. m
vec2 throughDoorway(Doorway doorway, vec2 place) {
    vec2 offset = place - doorway.middle;
    return vec2(dot(offset, doorway.inward), doorway.inward.x * offset.y - doorway.inward.y * offset.x);
}

/// The place of these.
vec2 atDoorway(Doorway doorway, vec2 inside_and_aside) {
    return doorway.middle + doorway.inward * inside_and_aside.x +
           vec2(-doorway.inward.y, doorway.inward.x) * inside_and_aside.y;
}

/// m to either side of the middle: as far as somebody fits through.
float roomInDoorway(Doorway doorway, float radius) { return max(doorway.half_width - radius - 0.03, 0.0); }
