// SPDX-License-Identifier: Apache-2.0
// Where people wait before a door of a vehicle: on both sides of the way that those take who get off, the more of them
// the further out.
// Needs shaders/boarding/passengers.glsl and shaders/shared/random.glsl.

const uint PURPOSE_DOOR = 0xd007u;
const float ROOM_OF_ONE = 0.45;     // m^2
const float FROM_VEHICLE = 0.3;     // m between it and bodies
const float FROM_DOOR = 0.15;       // m between bodies and the way out
const float WAY_OUT = 1.8;          // m before the door that stay free
const float FLATTER = 0.6;          // a crowd is less deep than it is long

/// m. @param waiting how many do
vec2 waitingBeside(Doorway doorway, uint row, uint waiting, float radius) {
    float share = sqrt(randomUnit(parameters.seed, row, PURPOSE_DOOR));
    float angle = (randomUnit(parameters.seed, row, PURPOSE_DOOR + 1u) - 0.5) * 3.0;
    // Sizes go in steps, so that nobody shifts about as others come and go.
    float crowd = exp2(ceil(log2(float(max(waiting, 2u)))));
    float beside = doorway.half_width + radius + FROM_DOOR;
    float away = sqrt(0.64 * ROOM_OF_ONE * crowd / FLATTER) * share;
    vec2 at = away * vec2(-FLATTER * cos(angle), sin(angle));
    at.x -= FROM_VEHICLE + radius;
    if (abs(at.y) < beside && -at.x < WAY_OUT) at.y = (at.y < 0.0 ? -1.0 : 1.0) * (beside + 0.5 * abs(at.y));
    return at;
}
