// SPDX-License-Identifier: Apache-2.0
// Riding: on escalators and travelators some people walk, and the others stand still, a step behind the next one. Where
// the layout tells a side, people stand on it and walk on the other one; everybody makes for its side before it steps
// on. Who walks together does the same.
//
// Velocities are relative to the ground (shaders/charts/belts.glsl): who stands wants nothing. How many a belt takes
// follows from the room that people leave to each other, from the moment at which they step on: who is about to waits
// until the one before has been carried on by a step more than its own depth (spacing_on_belts.glsl).
// Needs the block ParametersBlock, shaders/charts/belts.glsl and shaders/shared/random.glsl.

const uint PURPOSE_RIDING = 0x71de5u;

/// Where somebody is on a belt, or before it.
struct Ride {
    uint chart;   // NO_CHART: it is not
    bool on;      // it stands on it
    float along;  // m from where people step on; negative before that
    float aside;  // m to the left of the middle
};

/// @param home m: its place in home coordinates
Ride rideOn(uint chart, bool on, vec2 home) {
    vec2 offset = home - belts[chart].begin, forward = belts[chart].along;
    return Ride(chart, on, dot(offset, forward), forward.x * offset.y - forward.y * offset.x);
}

bool stepsOff(Ride ride) { return ride.along > belts[ride.chart].length - RIDING_STEPS_OFF; }

/// Whether it walks on the belt. @param party the first row of its company
bool walksOnBelt(Ride ride, uint party) {
    return randomUnit(parameters.seed ^ PURPOSE_RIDING, party, ride.chart) < belts[ride.chart].walking;
}

/// m to the left of the middle: where it rides.
float laneOf(Ride ride, bool walks) {
    float side = walks ? -belts[ride.chart].stand : belts[ride.chart].stand;
    if (side == 0.0) side = ride.aside >= 0.0 ? 1.0 : -1.0;
    return side * belts[ride.chart].lane;
}
