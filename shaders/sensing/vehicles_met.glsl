// SPDX-License-Identifier: Apache-2.0
// The vehicles that somebody heeds: those seen, those within the contact range, which are felt as bodies and walls are,
// and those that are about to drive where it is, which are heard from behind, too. Of all these the nearest few, in the
// word that follows the neighbours. Only with TRAFFIC.
#include "shaders/traffic/boxes.glsl"
#include "shaders/traffic/way_ahead.glsl"

float vehicle_gaps[MOST_HEEDED];
uint vehicles_met[MOST_HEEDED];

/// m: from a body to a vehicle, or to what it will drive over; HEEDED_WITHIN where that does not concern it.
float gapToWayAhead(Body self, VehicleBox box) {
    float clearance = self.radius + ROOM_TO_VEHICLES;
    PlaceBefore where;
    if (!isAhead(box, self.position, clearance, where)) return HEEDED_WITHIN;
    return max(abs(where.beside) - box.half_width - clearance, 0.0);
}

/// Keeps the list sorted by (gap, number); a vehicle is in it once.
void keepNearestVehicle(float gap, uint vehicle) {
    for (uint i = 0u; i < MOST_HEEDED; ++i)
        if (vehicles_met[i] == vehicle) return;
    for (uint i = 0u; i < MOST_HEEDED; ++i) {
        bool nearer = gap < vehicle_gaps[i] || (gap == vehicle_gaps[i] && vehicle < vehicles_met[i]);
        float passed_on = nearer ? vehicle_gaps[i] : gap;
        uint passed_on_vehicle = nearer ? vehicles_met[i] : vehicle;
        vehicle_gaps[i] = nearer ? gap : vehicle_gaps[i];
        vehicles_met[i] = nearer ? vehicle : vehicles_met[i];
        gap = passed_on;
        vehicle = passed_on_vehicle;
    }
}

void weighVehicle(Body self, uint vehicle, bool is_seen) {
    VehicleBox box = vehicle_boxes[vehicle];
    if (box.half_width <= 0.0) return;
    vec2 outward;
    float away = distanceToBox(self.position, box.rear, box.front, box.half_width, outward);
    float before = gapToWayAhead(self, box);
    if (!is_seen && away > parameters.contact_range && before >= HEEDED_WITHIN) return;
    float gap = min(away - self.radius, before);
    if (gap < HEEDED_WITHIN) keepNearestVehicle(gap, vehicle);
}

void forgetVehicles() {
    for (uint i = 0u; i < MOST_HEEDED; ++i) {
        vehicle_gaps[i] = HEEDED_WITHIN;
        vehicles_met[i] = HEEDED_NONE;
    }
}

/// Those felt and heard.
void hearVehicles(Body self) {
    forgetVehicles();
    for (uint vehicle = 0u; vehicle < VEHICLES; ++vehicle) weighVehicle(self, vehicle, false);
}

void publishVehicles(uint slot) {
    uint word = 0u;
    for (uint i = 0u; i < MOST_HEEDED; ++i) word |= vehicles_met[i] << i * HEEDED_BITS;
    neighbours[uint(NEIGHBOURS) * slot_capacity + slot] = word;
}
