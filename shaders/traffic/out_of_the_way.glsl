// SPDX-License-Identifier: Apache-2.0
// Out of the way of vehicles: nobody walks into one, or into what it may drive over within the next seconds, and who is
// there goes to the nearer side. Drivers who are about to stop for somebody are trusted: what they drive over ends
// there (shaders/traffic/drive.comp). Which vehicles somebody heeds, sensing has found
// (shaders/sensing/vehicles_met.glsl). Only with TRAFFIC.
// Needs shaders/traffic/way_ahead.glsl, shaders/motion/linear_program.glsl and half_width.glsl.

const float VEHICLE_HORIZON = 0.5;  // s
const float BRISKLY = 1.8;          // m/s: as fast as people get out of the way
const float MEANT_SIDE = 0.6;       // s: who crosses goes on to the other side rather than back

/// Beside it, or behind it: as beside a wall that moves.
vec3 besideVehicle(vec2 outward, float gap, float towards) {
    float speed = gap > 0.0 ? towards - gap / VEHICLE_HORIZON : max(towards, 0.0) - gap / VEHICLE_HORIZON;
    return vec3(outward, min(speed, BRISKLY));
}

/// @returns m to what it will drive over, or HEEDED_WITHIN where that does not concern somebody
float beforeVehicle(Body self, VehicleBox box, float clearance, out vec3 constraint) {
    PlaceBefore where;
    constraint = vec3(0.0);
    if (!isAhead(box, self.position, clearance, where)) return HEEDED_WITHIN;
    float half_width = box.half_width + clearance;
    float meant = where.beside + dot(self.velocity, where.aside) * MEANT_SIDE;
    float side = (abs(where.beside) < half_width ? meant : where.beside) < 0.0 ? -1.0 : 1.0;
    float gap = side * where.beside - half_width;
    constraint = vec3(where.aside * side, min(-gap / VEHICLE_HORIZON, BRISKLY));
    return max(gap, 0.0);
}

/// Sets constraints from number `index` on. @param in_doors it gets on or off. @returns how many
int vehiclesAhead(Body self, uint slot, int index, bool in_doors) {
    int count = 0;
    uint heeded = neighbourKey(slot, uint(NEIGHBOURS));
    for (uint i = 0u; i < MOST_HEEDED; ++i) {
        uint vehicle = heeded >> i * HEEDED_BITS & HEEDED_NONE;
        if (vehicle == HEEDED_NONE) break;
        VehicleBox box = vehicle_boxes[vehicle];
#ifdef DOORS
        if (in_doors && box.speed == 0.0) continue;  // shaders/motion/keep_off.comp sees to that one
#endif
        vec2 outward;
        float away = distanceToBox(self.position, box.rear, box.front, box.half_width, outward);
        float width = halfWidth(self, slot, outward);
        vec3 constraint;
        float gap = beforeVehicle(self, box, width + ROOM_TO_VEHICLES, constraint);
        if (away - width < gap) {
            gap = away - width;
            vec2 forward = normalize(box.front - box.rear);
            constraint = besideVehicle(outward, gap - 0.5 * ROOM_TO_VEHICLES, box.speed * dot(forward, outward));
        }
        if (gap < HEEDED_WITHIN) setConstraint(index + count++, constraint);
    }
    return count;
}
