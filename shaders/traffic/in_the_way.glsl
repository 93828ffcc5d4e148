// SPDX-License-Identifier: Apache-2.0
// What drivers have seen of people: for each vehicle the bits of how far along the lane the nearest person in its way
// is (m), and after these for each stop before a crossing who is there.
// Needs the block InTheWay.

const uint SOMEBODY_IS_ON = 0u;
const uint SOMEBODY_COMES = 1u;

bool isThere(uint vehicle_status) { return vehicle_status == VEHICLE_DRIVES || vehicle_status == VEHICLE_STANDS; }

uint atStop(uint stop) { return VEHICLES + stop; }
