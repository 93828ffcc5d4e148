// SPDX-License-Identifier: Apache-2.0
// What a vehicle may drive over within the next seconds, and who is there. Only with TRAFFIC.
// Needs shaders/traffic/boxes.glsl.

const float HEEDED_WITHIN = 4.0;      // m: no vehicle further away concerns anybody
const float ROOM_TO_VEHICLES = 0.25;  // m: what people leave

struct PlaceBefore {
    vec2 aside;    // unit vector, to the left of the vehicle's way
    float beside;  // m, along it
};

/// Whether a place is ahead of a vehicle, and no further than it may come.
bool isAhead(VehicleBox box, vec2 place, float clearance, out PlaceBefore where) {
    vec2 axis = box.ahead - box.front;
    float reach = length(axis);
    where = PlaceBefore(vec2(0.0), 0.0);
    if (reach < 0.3) return false;
    vec2 along = axis / reach;
    where.aside = vec2(-along.y, along.x);
    vec2 offset = place - box.front;
    where.beside = dot(offset, where.aside);
    float ahead = dot(offset, along);
    return ahead >= 0.0 && ahead <= reach + clearance;
}
