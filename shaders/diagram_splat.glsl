// SPDX-License-Identifier: Apache-2.0
// The truncated Voronoi diagram, one invocation per site.
//
// A pixel belongs to the nearest site whose tile reaches it. Every site visits the pixels under its own tile, twice:
// the first pass leaves the smallest squared distance in each pixel, the second lets only sites at exactly that
// distance compete, and the smallest id wins. Both passes are unsigned minima, so the result is the same whatever the
// order, and equal to comparing all sites at every pixel. Non-negative floats order like their bits, which is why
// atomicMin on the bits finds the smallest distance. One packed 32-bit pass would be half the work, but has to quantise
// the distance; 64-bit atomics are not to be had everywhere.
//
// Wall tiles never move: they are splatted once, and every step begins with a copy of their two layers.

#include "shaders/diagram_distance.glsl"

/// Pixels that a tile may reach, clipped to the window: corner and one past the opposite corner. Empty when outside.
ivec4 tileBox(vec2 position, float radius) {
    ivec2 window = ivec2(diagram_size);
    // Compared as floats first: far away sites would overflow the integers.
    vec2 lower = clamp(floor(position - radius - 0.5), vec2(0.0), diagram_size);
    vec2 upper = clamp(ceil(position + radius + 0.5), vec2(0.0), diagram_size);
    return ivec4(ivec2(lower), min(ivec2(upper), window));
}
