// SPDX-License-Identifier: Apache-2.0
// Drive: legs bring the velocity towards the wished one (Helbing and Molnar 1995, equation 2), and speed up no faster
// than walkers do. How hard they can speed up also bounds how hard a crowd presses.
// Needs shaders/shared/at_most.glsl.

/// m/s^2.
/// @param pace m/s: how fast one wants to walk behind those ahead, at most `speed`, the length of `wish`
vec2 drive(vec2 wish, float speed, float pace, vec2 velocity) {
    vec2 wanted = pace < speed ? wish * (pace / speed) : wish;
    return atMost((wanted - velocity) / DRIVE_RELAXATION, DRIVE_MOST);
}

vec2 limitChange(vec2 from, vec2 to, float most) {
    vec2 change = to - from;
    float size = length(change);
    return size > most ? from + change * (most / size) : to;
}
