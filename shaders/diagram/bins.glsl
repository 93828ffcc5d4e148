// SPDX-License-Identifier: Apache-2.0
// The bins that sites of the diagram are sorted into: squares of `1 / bins_per_pixel` px over the window. Sites outside
// the window belong to the bin nearest to them, so a search over the bins that a tile can reach from still meets them.
uniform vec2 bin_count;
uniform float bins_per_pixel;

/// Clamped as floats: far away sites would overflow the integers.
uvec2 binOf(vec2 position) { return uvec2(clamp(floor(position * bins_per_pixel), vec2(0.0), bin_count - 1.0)); }
