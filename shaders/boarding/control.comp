// SPDX-License-Identifier: Apache-2.0
// What the doors of each vehicle at a platform do next. They open once it stands; those who get off come out one after
// another, by all of them; once the last is out and clear of a door, those who wait before it are asked in, the nearest
// first, as long as there is room. Doors close when nobody comes or goes any more, but not before the stop's least time
// is over, and so that the vehicle goes on when its longest is. They do not close on anybody. In between, leaves move
// (shaders/boarding/move.comp).
#include "shaders/shared/simulation_types.h"
#include "shaders/shared/traffic_types.h"
#include "shaders/shared/boarding_types.h"

layout(local_size_x = BOARDING_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer People { Person people[]; };
layout(std430) buffer States { AgentState states[]; };
layout(std430) buffer Vehicles { Vehicle vehicles[]; };
layout(std430) readonly buffer TrafficStops { TrafficStop stops[]; };
#include "shaders/traffic/boxes.glsl"
#include "shaders/boarding/passengers.glsl"
layout(std430) readonly buffer Platforms { Platform platforms[]; };
layout(std430) readonly buffer AlightingCalls { AlightingCall calls[]; };
layout(std430) buffer CallHeads { uint call_heads[]; };  // how many of each have got off
layout(std430) buffer PlatformVehicles { uint platform_vehicles[]; };
layout(std430) buffer VehicleServices { VehicleService services[]; };
layout(std430) buffer Passengers { uint passengers[]; };
layout(std430) readonly buffer DoorWishesBlock { DoorWishes door_wishes[]; };
layout(std430) buffer DoorStates { DoorState door_states[]; };
layout(std430) readonly buffer NewAboard { uint new_aboard[]; };
#ifdef BODIES
layout(std430) writeonly buffer Chests { Chest chests[]; };
#endif
uniform float now;        // s
uniform uint steps_done;  // counted with this one

const uint MOST_AT_ONCE = 3u;   // of each door, who have been asked in and are not in yet
const float GETS_UP = 0.8;      // m inside: from there somebody who gets off is seen
const float BEHIND = 0.1;       // m, one behind the other
const float COMES_OUT = 0.8;    // m/s
const float BESIDE_MIDDLE = 0.2;  // m: people take the left and the right of a door in turn
const float WAITS_FOR = 5.0;    // m: drivers wait for whoever is nearer than this

void enter(inout VehicleService service, uint phase) {
    service.phase = phase;
    service.since = 0.0;
}

/// The next of those who get off here, or NO_INDEX. @param call the one that it is of
uint nextToGetOff(VehicleService service, out uint call) {
    for (call = service.first_call; call < service.first_call + service.call_count; ++call)
        if (calls[call].platform == service.platform && call_heads[call] < calls[call].row_count)
            return calls[call].first_row + call_heads[call];
    return NO_INDEX;
}

/// Whether there is room where somebody would come up from inside.
bool hasRoom(DoorWishes wishes, float radius) {
    return wishes.deepest == 0u || uintBitsToFloat(wishes.deepest) - DEEP < GETS_UP - radius - BEHIND;
}

void comeOut(uint row, uint passenger, Doorway doorway) {
    float radius = people[row].radius;
    float aside = min(BESIDE_MIDDLE, roomInDoorway(doorway, radius)) * (row % 2u == 0u ? 1.0 : -1.0);
    AgentState state = states[row];
    state.position = atDoorway(doorway, vec2(GETS_UP, aside));
    state.velocity = -doorway.inward * COMES_OUT;
    state.heading = atan(-doorway.inward.y, -doorway.inward.x);
    state.status = STATUS_WALKING;
    state.spawn_step = steps_done;
    states[row] = state;
    passengers[row] = passenger;
#ifdef BODIES
    chests[row].angle = state.heading;
    chests[row].rate = 0.0;
#endif
}

/// @returns whether somebody has been let out
bool letOut(inout VehicleService service, uint vehicle, uint number, DoorWishes wishes, Doorway doorway) {
    uint call;
    uint row = nextToGetOff(service, call);
    if (row == NO_INDEX || !hasRoom(wishes, people[row].radius)) return false;
    comeOut(row, passengerFor(PASSENGER_ALIGHTS, vehicle, number), doorway);
    call_heads[call] += 1u;
    service.alighted += 1u;
    service.aboard -= min(service.aboard, 1u);
    return true;
}

/// @param going_in how many have been asked in at all doors
bool askIn(VehicleService service, DoorWishes wishes, inout uint going_in) {
    if (wishes.first == 0u || wishes.coming_out > 0u || wishes.going_in >= MOST_AT_ONCE) return false;
    if (service.aboard + going_in >= service.capacity) return false;
    uint row = ~wishes.first & 0xffffffu;
    passengers[row] = passengerFor(PASSENGER_BOARDS, vehicleOf(passengers[row]), doorOf(passengers[row]));
    going_in += 1u;
    return true;
}

/// When a door may let somebody through again. As long as people wait it lets through as many as it can, however seldom
/// it is looked after.
float dueAgain(float due, float flow) {
    return (now - due < parameters.decision_seconds ? due : now) + 1.0 / flow;
}

/// Lets people through all doors on the platform's side, each as fast as it lets them.
/// @returns whether somebody has been let out or asked in, whom nobody has counted yet
bool letThrough(inout VehicleService service, uint vehicle, uint going_in) {
    bool anybody = false;
    float side = platforms[service.platform].side;
    for (uint i = 0u; i < service.door_count; ++i) {
        uint door = service.first_door + i;
        if (!opensOn(vehicle_doors[door], side) || now < door_states[door].next) continue;
        uint call;
        bool somebody_gets_off = nextToGetOff(service, call) != NO_INDEX;
        Doorway doorway = doorwayOf(vehicle_boxes[vehicle], vehicle_doors[door], side);
        bool through = somebody_gets_off ? letOut(service, vehicle, i, door_wishes[door], doorway)
                                         : askIn(service, door_wishes[door], going_in);
        if (through) door_states[door].next = dueAgain(door_states[door].next, service.door_flow);
        anybody = anybody || through;
    }
    return anybody;
}

/// All doors of a vehicle together.
DoorWishes countedAt(VehicleService service) {
    DoorWishes all = DoorWishes(0u, 0u, 0u, 0u, 0u, 0u);
    for (uint i = 0u; i < service.door_count; ++i) {
        DoorWishes wishes = door_wishes[service.first_door + i];
        all.coming_out += wishes.coming_out;
        all.going_in += wishes.going_in;
        all.in_door += wishes.in_door;
        all.waiting += wishes.waiting;
        all.first = max(all.first, wishes.first);
        door_states[service.first_door + i].waiting = wishes.waiting;
    }
    return all;
}

/// Whether somebody is there to get on: doors do not wait for those who are far off.
bool isNear(DoorWishes all) { return all.first != 0u && (~all.first >> 24u) < uint(10.0 * WAITS_FOR); }

void standOpen(inout VehicleService service, uint vehicle) {
    Platform platform = platforms[service.platform];
    DoorWishes all = countedAt(service);
    float latest = platform.most - service.door_time;
    if (service.phase == DOORS_ARE_OPEN && service.stood >= latest - CLEARING) enter(service, DOORS_LET_THROUGH);
    if (service.phase == DOORS_ARE_OPEN && letThrough(service, vehicle, all.going_in)) return;
    uint call;
    bool has_room = service.aboard + all.going_in < service.capacity;
    bool wanted = nextToGetOff(service, call) != NO_INDEX || (isNear(all) && has_room);
    bool busy = all.coming_out + all.going_in > 0u || (wanted && service.phase == DOORS_ARE_OPEN);
    bool is_done = !busy && service.stood + service.door_time >= platform.least;
    if (all.in_door == 0u && (is_done || service.stood >= latest)) enter(service, DOORS_CLOSE);
}

void stepDoors(inout VehicleService service, uint vehicle) {
    if (service.open != (service.phase == DOORS_OPEN_UP ? 1.0 : 0.0)) return;
    if (service.phase == DOORS_OPEN_UP) {
        enter(service, DOORS_ARE_OPEN);
        return;
    }
    enter(service, DOORS_SHUT);
    platform_vehicles[service.platform] = NO_INDEX;
    service.platform = NO_INDEX;
    vehicles[vehicle].stand_until = now;  // it goes on
}

/// Whether it has just come to stand at a platform.
bool arrives(uint vehicle) {
    Vehicle self = vehicles[vehicle];
    return self.status == VEHICLE_STANDS && stops[self.next_stop].kind == STOP_AT_PLATFORM && self.stand_until > now;
}

void openUp(inout VehicleService service, uint vehicle) {
    service.platform = stops[vehicles[vehicle].next_stop].crossing;
    platform_vehicles[service.platform] = vehicle;
    service.stood = 0.0;
    service.boarded = service.alighted = 0u;
    for (uint i = 0u; i < service.door_count; ++i) door_states[service.first_door + i] = DoorState(now, 0u);
    enter(service, DOORS_OPEN_UP);
}

void main() {
    for (uint vehicle = gl_LocalInvocationID.x; vehicle < VEHICLES; vehicle += BOARDING_GROUP_SIZE) {
        VehicleService service = services[vehicle];
        if (service.door_count == 0u) continue;
        service.aboard += new_aboard[vehicle];
        service.boarded += new_aboard[vehicle];
        if (service.phase == DOORS_SHUT) {
            if (arrives(vehicle)) openUp(service, vehicle);
        } else if (service.phase == DOORS_OPEN_UP || service.phase == DOORS_CLOSE) {
            stepDoors(service, vehicle);
        } else {
            standOpen(service, vehicle);
        }
        services[vehicle] = service;
    }
}
