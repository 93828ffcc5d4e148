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

#include "shaders/diagram/distance.glsl"

/// Pixels that a tile may reach, clipped to the window: corner and one past the opposite corner. Empty when outside.
/// A hundredth of a pixel more than the tile makes up for rounding; the test on the exact distance decides.
ivec4 tileBox(vec2 position, float radius) {
    vec2 lower = ceil(position - radius - 0.51);
    vec2 upper = floor(position + radius - 0.49) + 1.0;
    // Clamped as floats: far away sites would overflow the integers.
    return ivec4(clamp(lower, vec2(0.0), diagram_size), clamp(upper, vec2(0.0), diagram_size));
}
