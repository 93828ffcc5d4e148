// SPDX-License-Identifier: Apache-2.0
// Who waits before which door of a vehicle, who has been asked in, who has got in, and who has got off and is clear of
// the door; and, counted, what that means to each door.
#include "shaders/shared/simulation_types.h"
#include "shaders/shared/traffic_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer People { Person people[]; };
layout(std430) buffer States { AgentState states[]; };
layout(std430) readonly buffer Stages { Stage stages[]; };
#include "shaders/traffic/boxes.glsl"
#include "shaders/boarding/passengers.glsl"
layout(std430) readonly buffer Platforms { Platform platforms[]; };
layout(std430) readonly buffer PlatformPoints { vec2 platform_points[]; };
layout(std430) readonly buffer PlatformVehicles { uint platform_vehicles[]; };  // which one stands there, or NO_INDEX
layout(std430) readonly buffer VehicleServices { VehicleService services[]; };
layout(std430) buffer Passengers { uint passengers[]; };  // by row: PASSENGER_*
layout(std430) buffer DoorWishesBlock { DoorWishes door_wishes[]; };
layout(std430) readonly buffer DoorStates { DoorState door_states[]; };
layout(std430) buffer NewAboard { uint new_aboard[]; };  // by vehicle: how many have got in just now
uniform uint steps_done;  // counted with this one

#include "shaders/shared/alive.glsl"
#include "shaders/shared/outline.glsl"
#include "shaders/traffic/platforms.glsl"

const float INSIDE = 0.75;        // m: so far in, somebody is aboard
const float CLEAR = 0.35;         // m between a body and the vehicle's side: it has got off
const float WORTH_CHANGING = 1.5; // m: of another door that is better by so much
const float FOR_EACH = 0.5;       // m that everybody who waits at a door makes it worse

Doorway doorwayAt(uint vehicle, uint door) {
    VehicleService service = services[vehicle];
    float side = service.platform == NO_INDEX ? 1.0 : platforms[service.platform].side;
    return doorwayOf(vehicle_boxes[vehicle], vehicle_doors[service.first_door + door], side);
}

/// Once in some decisions, at others than its neighbours.
bool looksRound(uint row) {
    const uint ONCE_IN = 16u;  // decisions
    uint decision = uint(float(steps_done) * parameters.step_seconds / parameters.decision_seconds);
    return (decision + row) % ONCE_IN == 0u;
}

/// Of the doors on the platform's side the one to go to. Who has one keeps it unless another is much better, and looks
/// round for that now and then.
uint chosenDoor(uint vehicle, uint row, uint kept, vec2 place) {
    if (kept != NO_INDEX && !looksRound(row)) return kept;
    VehicleService service = services[vehicle];
    float side = platforms[service.platform].side, least = 1.0e30;
    uint best = NO_INDEX;
    for (uint i = 0u; i < service.door_count; ++i) {
        VehicleDoor door = vehicle_doors[service.first_door + i];
        if (!opensOn(door, side)) continue;
        float cost = distance(place, doorwayOf(vehicle_boxes[vehicle], door, side).middle);
        cost += FOR_EACH * float(door_states[service.first_door + i].waiting);
        if (i == kept) cost -= WORTH_CHANGING + FOR_EACH;
        if (cost >= least) continue;
        least = cost;
        best = i;
    }
    return best;
}

uint waits(uint passenger, uint row, AgentState state) {
    uint board = stages[state.stage].board;
    if (board == 0u || state.status != STATUS_WALKING) return PASSENGER_NONE;
    uint number = (board & ((1u << BOARD_LINES_AT) - 1u)) - 1u;
    uint vehicle = platform_vehicles[number];
    if (vehicle == NO_INDEX) return PASSENGER_NONE;
    // Where a platform is full, some stand beside it.
    if (state.leave_step == 0u && !isOnPlatform(platforms[number], state.position)) return PASSENGER_NONE;
    VehicleService service = services[vehicle];
    bool comes_in = service.phase == DOORS_OPEN_UP || service.phase == DOORS_ARE_OPEN;
    if ((board & service.line) == 0u || !comes_in || service.aboard >= service.capacity) return PASSENGER_NONE;
    bool knows = phaseOf(passenger) != PASSENGER_NONE && vehicleOf(passenger) == vehicle;
    uint door = chosenDoor(vehicle, row, knows ? doorOf(passenger) : NO_INDEX, state.position);
    return door == NO_INDEX ? PASSENGER_NONE : passengerFor(PASSENGER_CALLED, vehicle, door);
}

void countWaiting(uint passenger, uint row, vec2 place) {
    uint vehicle = vehicleOf(passenger), door = services[vehicle].first_door + doorOf(passenger);
    atomicAdd(door_wishes[door].waiting, 1u);
    // The nearest comes first, of several the smallest row: the largest of these words.
    uint away = min(uint(distance(place, doorwayAt(vehicle, doorOf(passenger)).middle) * 10.0), 254u);
    atomicMax(door_wishes[door].first, ~(away << 24u | (row & 0xffffffu)));
}

void countInDoorway(uint passenger, float inside, float radius) {
    uint door = services[vehicleOf(passenger)].first_door + doorOf(passenger);
    if (phaseOf(passenger) == PASSENGER_ALIGHTS)
        atomicAdd(door_wishes[door].coming_out, 1u);
    else
        atomicAdd(door_wishes[door].going_in, 1u);
    if (inside <= -radius) return;
    atomicAdd(door_wishes[door].in_door, 1u);
    atomicMax(door_wishes[door].deepest, floatBitsToUint(inside + radius + DEEP));
}

/// Gets off, until it is clear of the vehicle.
uint getsOff(uint passenger, uint row, AgentState state) {
    float inside = throughDoorway(doorwayAt(vehicleOf(passenger), doorOf(passenger)), state.position).x;
    if (inside < -people[row].radius - CLEAR) return PASSENGER_NONE;
    countInDoorway(passenger, inside, people[row].radius);
    return passenger;
}

/// Goes in, until it is aboard; doors that are about to close keep out whoever is not between them.
uint getsOn(uint passenger, uint row, AgentState state) {
    uint vehicle = vehicleOf(passenger);
    float radius = people[row].radius;
    float inside = throughDoorway(doorwayAt(vehicle, doorOf(passenger)), state.position).x;
    if (inside >= INSIDE) {
        states[row].status = STATUS_GONE;
        states[row].arrival_step = steps_done;
        states[row].leave_step = 0u;
        atomicAdd(new_aboard[vehicle], 1u);
        return PASSENGER_NONE;
    }
    if (inside <= -radius && services[vehicle].phase != DOORS_ARE_OPEN) return PASSENGER_NONE;
    countInDoorway(passenger, inside, radius);
    return passenger;
}

void main() {
    uint row = gl_GlobalInvocationID.x;
    if (row >= parameters.row_count) return;
    AgentState state = states[row];
    uint passenger = passengers[row];
    bool is_gone = phaseOf(passenger) != PASSENGER_NONE && services[vehicleOf(passenger)].platform == NO_INDEX;
    if (!isAlive(state.status) || is_gone)  // or the vehicle is
        passenger = PASSENGER_NONE;
    else if (phaseOf(passenger) == PASSENGER_ALIGHTS)
        passenger = getsOff(passenger, row, state);
    else if (phaseOf(passenger) == PASSENGER_BOARDS)
        passenger = getsOn(passenger, row, state);
    else
        passenger = waits(passenger, row, state);
    if (phaseOf(passenger) == PASSENGER_CALLED) countWaiting(passenger, row, state.position);
    passengers[row] = passenger;
}
