// SPDX-License-Identifier: Apache-2.0
// A step of all vehicles: each follows its lane behind the one ahead, and stops for red, for people and where it has
// to. One group does it: everybody drives by what all others did before the step, so the order does not matter.
#include "shaders/shared/simulation_types.h"
#include "shaders/shared/traffic_types.h"

layout(local_size_x = VEHICLE_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) buffer Vehicles { Vehicle vehicles[]; };
layout(std430) writeonly buffer VehicleBoxesMade { VehicleBox boxes_made[]; };
layout(std430) readonly buffer Lanes { TrafficLane lanes[]; };
layout(std430) readonly buffer LanePoints { LanePoint lane_points[]; };
layout(std430) readonly buffer TrafficStops { TrafficStop stops[]; };
layout(std430) readonly buffer Lights { uint lights[]; };
layout(std430) readonly buffer InTheWay { uint in_the_way[]; };
#ifdef DOORS
#include "shaders/shared/boarding_types.h"
layout(std430) readonly buffer Platforms { Platform platforms[]; };
layout(std430) readonly buffer VehicleServices { VehicleService services[]; };
layout(std430) readonly buffer VehicleDoors { VehicleDoor vehicle_doors[]; };
#endif
uniform float now;  // s, at the start of the step

#include "shaders/traffic/in_the_way.glsl"
#include "shaders/traffic/lane_places.glsl"
#include "shaders/traffic/driver.glsl"

const float FAR = 1.0e9;             // m
const float LOOK_FOR_STOPS = 60.0;   // m
const float FIRM_BRAKING = 3.5;      // m/s^2: who would have to brake harder for a light drives on
const float PASSED = 0.3;            // m: behind a line by so much, it does not count any more
const float AT_LINE = 0.8;           // m
const float STANDING = 0.15;         // m/s
const float FROM_BODIES = 0.15;      // m: no driver goes nearer to somebody in the way

shared float fronts[MOST_VEHICLES];
shared float speeds[MOST_VEHICLES];
shared uint statuses[MOST_VEHICLES];

/// The nearest one before a place on the lane; VEHICLES where there is none.
uint vehicleAhead(uint self, uint lane, float front) {
    uint found = VEHICLES;
    for (uint i = 0u; i < VEHICLES; ++i) {
        if (i == self || vehicles[i].lane != lane || !isThere(statuses[i]) || fronts[i] < front) continue;
        if (fronts[i] == front && i > self) continue;
        if (found == VEHICLES || fronts[i] < fronts[found]) found = i;
    }
    return found;
}

/// What a driver makes of what is ahead.
struct Outlook {
    float braking;  // m/s^2, the most that anything asks for
    float free;     // m to where it stops, if it stops
    float room;     // m that it cannot but stop within
};

void heed(inout Outlook outlook, Vehicle self, float gap, float closing) {
    outlook.braking = max(outlook.braking, brakingFor(self, gap, closing));
}

/// Fronts stand at the line, where behind vehicles they keep a gap.
void stopAt(inout Outlook outlook, Vehicle self, float to_line) {
    heed(outlook, self, to_line + self.gap, self.speed);
    outlook.free = min(outlook.free, max(to_line, 0.0));
}

/// Whether a stop is one of its own: where all stand for a time, or a platform that it has doors for.
bool standsAt(uint vehicle, uint stop) {
#ifdef DOORS
    if (stops[stop].kind == STOP_AT_PLATFORM) {
        uint sides = platforms[stops[stop].crossing].side > 0.0 ? DOOR_ON_LEFT : DOOR_ON_RIGHT;
        VehicleService service = services[vehicle];
        return service.door_count > 0u && (vehicle_doors[service.first_door].sides & sides) != 0u;
    }
#endif
    return stops[stop].kind == STOP_FOR_TIME;
}

bool stopsFor(Vehicle self, uint stop, float to_line) {
    if (stops[stop].kind == STOP_AT_PLATFORM) return false;
    if (stops[stop].kind == STOP_AT_RED)
        return lights[stops[stop].light] == LIGHT_RED && neededToStop(self, to_line) <= FIRM_BRAKING;
    uint people = in_the_way[atStop(stop)];
    return neededToStop(self, to_line) <= (people == SOMEBODY_IS_ON ? HARDEST_BRAKING
                                           : people == SOMEBODY_COMES ? FIRM_BRAKING : -1.0);
}

void lookForStops(inout Outlook outlook, inout Vehicle self, uint index) {
    uint end = lanes[self.lane].first_stop + lanes[self.lane].stop_count;
    while (self.next_stop < end && stops[self.next_stop].along < self.along - PASSED) ++self.next_stop;
    for (uint stop = self.next_stop; stop < end; ++stop) {
        float to_line = stops[stop].along - self.along;
        if (to_line > LOOK_FOR_STOPS) return;
        bool stands = standsAt(index, stop);
        if (stands || stopsFor(self, stop, to_line)) stopAt(outlook, self, to_line);
        if (stands) return;
    }
}

Outlook lookAhead(inout Vehicle self, uint index) {
    Outlook outlook = Outlook(0.0, FAR, FAR);
    uint leader = vehicleAhead(index, self.lane, self.along);
    if (leader != VEHICLES) {
        float gap = fronts[leader] - vehicles[leader].length - self.along;
        heed(outlook, self, gap, self.speed - speeds[leader]);
        outlook.room = max(gap, 0.0);
    }
    uint person = in_the_way[index];
    if (person != NO_INDEX) {
        float gap = uintBitsToFloat(person) - self.along;
        heed(outlook, self, gap, self.speed);
        outlook.room = min(outlook.room, max(gap - FROM_BODIES, 0.0));
        outlook.free = min(outlook.free, outlook.room);
    }
    lookForStops(outlook, self, index);
    return outlook;
}

/// At a stop of its own: arrives, stands, and goes on. @returns whether it stands
bool standAtStop(inout Vehicle self, uint index) {
    uint end = lanes[self.lane].first_stop + lanes[self.lane].stop_count;
    if (self.status == VEHICLE_STANDS && now >= self.stand_until) {
        self.status = VEHICLE_DRIVES;
        ++self.next_stop;
    }
    if (self.status == VEHICLE_DRIVES && self.next_stop < end && standsAt(index, self.next_stop) &&
        self.speed <= STANDING && abs(stops[self.next_stop].along - self.along) <= AT_LINE) {
        self.status = VEHICLE_STANDS;
        self.stand_until = now + stops[self.next_stop].seconds;
        if (stops[self.next_stop].kind == STOP_AT_PLATFORM) self.stand_until = FAR;  // shaders/boarding/control.comp
    }
    return self.status == VEHICLE_STANDS;
}

/// Comes in once there is room behind the last one, as fast as that leaves it.
void enter(inout Vehicle self, uint index) {
    if (now < self.start) return;
    for (uint i = 0u; i < index; ++i)
        if (vehicles[i].lane == self.lane && statuses[i] == VEHICLE_TO_COME) return;
    uint leader = vehicleAhead(index, self.lane, -FAR);
    float room = leader == VEHICLES ? FAR : fronts[leader] - vehicles[leader].length;
    if (room <= self.gap + 1.0) return;
    self.status = VEHICLE_DRIVES;
    self.along = 0.0;
    self.speed = min(self.wished_speed, (room - self.gap) / (self.headway + 1.0));
}

/// @returns m that it has gone
float goOn(inout Vehicle self, Outlook outlook) {
    float seconds = parameters.step_seconds;
    self.acceleration = max(freeAcceleration(self) - outlook.braking, -HARDEST_BRAKING);
    float speed = self.speed + self.acceleration * seconds;
    float way = 0.5 * (self.speed + speed) * seconds;
    if (speed < 0.0) {
        way = self.speed * self.speed / (-2.0 * self.acceleration);
        speed = 0.0;
    }
    if (way > outlook.room) {
        way = outlook.room;
        speed = way / seconds;
    }
    self.speed = speed;
    return way;
}

VehicleBox boxOf(Vehicle self, Outlook outlook) {
    VehicleBox box = VehicleBox(vec2(0.0), vec2(0.0), vec2(0.0), 0.0, 0.0);
    if (!isThere(self.status)) return box;
    box.front = placeOnLane(self.lane, self.along);
    box.rear = box.front + normalize(placeOnLane(self.lane, self.along - self.length) - box.front) * self.length;
    float reach = min(self.speed * VEHICLE_LOOK_AHEAD, outlook.free);
    box.ahead = placeOnLane(self.lane, self.along + reach);
    box.half_width = self.half_width;
    box.speed = self.speed;
    return box;
}

void main() {
    uint first = gl_LocalInvocationID.x;
    for (uint i = first; i < VEHICLES; i += VEHICLE_GROUP_SIZE) {
        fronts[i] = vehicles[i].along;
        speeds[i] = vehicles[i].speed;
        statuses[i] = vehicles[i].status;
    }
    barrier();
    for (uint i = first; i < VEHICLES; i += VEHICLE_GROUP_SIZE) {
        Vehicle self = vehicles[i];
        Outlook outlook = Outlook(0.0, FAR, FAR);
        if (self.status == VEHICLE_TO_COME) {
            enter(self, i);
        } else if (isThere(self.status)) {
            if (standAtStop(self, i)) {
                self.speed = 0.0;
                self.acceleration = 0.0;
                outlook.free = 0.0;
            } else {
                outlook = lookAhead(self, i);
                self.along += goOn(self, outlook);
            }
            if (self.along - self.length > lanes[self.lane].length) self.status = VEHICLE_GONE;
        }
        vehicles[i] = self;
        boxes_made[i] = boxOf(self, outlook);
    }
}
