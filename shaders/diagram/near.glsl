// SPDX-License-Identifier: Apache-2.0
// The pages that somebody looks at: all within `reach` px, and, as samples beyond the window's edge are taken at the
// edge, those at the edge for who stands outside. Needs the uniform diagram_size.

void pagesNear(vec2 position, float reach, out uvec2 lower, out uvec2 upper) {
    // A pixel more than the reach makes up for rounding. Clamped as floats: far away sites would overflow the integers.
    vec2 last = diagram_size - 1.0;
    lower = uvec2(clamp(position - reach - 1.0, vec2(0.0), last)) / PAGE_SIDE;
    upper = uvec2(clamp(position + reach + 1.0, vec2(0.0), last)) / PAGE_SIDE;
}
