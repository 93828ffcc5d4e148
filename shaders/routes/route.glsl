// SPDX-License-Identifier: Apache-2.0
// Where a route leads from a position: a straight line to a point, or downhill on a distance field.
// Needs the block Stages and the sampler field_cells.

struct RouteAhead {
    vec2 direction;   // unit vector, or zero at the target itself
    float remaining;  // m
    bool straight;    // nothing is in the way any more
};

/// The bilinear weights' cell and fraction on a grid of `size` cells that begins where the distance fields' does.
void gridPosition(vec2 position, float cell_size, uvec2 size, out uvec2 cell, out vec2 fraction) {
    vec2 at = clamp((position - parameters.grid_minimum) / cell_size - 0.5, vec2(0.0), vec2(size) - 1.001);
    cell = uvec2(at);
    fraction = at - vec2(cell);
}

/// How fast jams make the way longer, towards each axis: what the coarse map knows, between its cells' middles.
vec2 detourSlope(uint field, vec2 position) {
    uvec2 cell;
    vec2 fraction;
    gridPosition(position, parameters.detour_cell, uvec2(parameters.detour_width, parameters.detour_height), cell,
                 fraction);
    uint first = (field * parameters.detour_height + cell.y) * parameters.detour_width + cell.x;
    uint above = first + parameters.detour_width;
    return mix(mix(detour_slopes[first], detour_slopes[first + 1u], fraction.x),
               mix(detour_slopes[above], detour_slopes[above + 1u], fraction.x), fraction.y);
}

FieldCell fieldCell(uint index) {
    uvec2 words = texelFetch(field_cells, int(index)).xy;
    return FieldCell(uintBitsToFloat(words.x), words.y);
}

RouteAhead sampleField(uint field, vec2 position) {
    uvec2 cell;
    vec2 fraction;
    gridPosition(position, parameters.grid_cell, uvec2(parameters.grid_width, parameters.grid_height), cell, fraction);
    uint base = field * parameters.grid_width * parameters.grid_height + cell.y * parameters.grid_width + cell.x;
    FieldCell corner[4] = FieldCell[4](fieldCell(base), fieldCell(base + 1u), fieldCell(base + parameters.grid_width),
                                       fieldCell(base + parameters.grid_width + 1u));
    vec4 weight = vec4((1.0 - fraction.x) * (1.0 - fraction.y), fraction.x * (1.0 - fraction.y),
                       (1.0 - fraction.x) * fraction.y, fraction.x * fraction.y);
    RouteAhead ahead = RouteAhead(vec2(0.0), 0.0, false);
    for (int i = 0; i < 4; ++i) {
        ahead.direction += weight[i] * unpackSnorm2x16(corner[i].direction);
        ahead.remaining += weight[i] * corner[i].distance;
    }
    float size = length(ahead.direction);
    // Where routes part (behind an obstacle) the corners cancel out: take one side, always the same.
    ahead.direction = size > 0.05 ? ahead.direction / size : unpackSnorm2x16(corner[0].direction);
    if (parameters.detour_width == 0u) return ahead;
    // Without jams the distance falls by one per metre; jams add their slope.
    vec2 downhill = ahead.direction - detourSlope(field, position);
    size = length(downhill);
    if (size > 0.05) ahead.direction = downhill / size;
    return ahead;
}

RouteAhead routeAhead(Stage stage, vec2 position) {
    vec2 offset = stage.point - position;
    float remaining = length(offset);
    RouteAhead straight = RouteAhead(remaining > 1.0e-6 ? offset / remaining : vec2(0.0), remaining, true);
    if (stage.field == NO_INDEX) return straight;
    RouteAhead ahead = sampleField(stage.field & ~FIELD_THEN_POINT, position);
    if ((stage.field & FIELD_THEN_POINT) == 0u) return ahead;
    if (ahead.remaining <= 0.0) return straight;
    // Still on the way to the surroundings: at least as far as in a straight line.
    ahead.remaining = max(ahead.remaining, remaining);
    return ahead;
}
