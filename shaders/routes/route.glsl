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

/// Four cells of a field round a position, in the order of mix(): the first of them, how many a row has, and where
/// between them the position is.
struct FieldCorners {
    uint first;
    uint row;
    vec2 fraction;
};

/// On large sites a field first has a value for each crossing of the blocks' edges, and then fine cells for the blocks
/// where walls or kerbs are near, in rows of ten: eight, and the neighbours' next ones on both sides. All fields come
/// after a table that says where each block's cells begin, or 0.
FieldCorners cornersInBlocks(uint field, vec2 position) {
    uvec2 blocks = uvec2(parameters.field_blocks_across, parameters.field_blocks_up);
    vec2 at = clamp((position - parameters.grid_minimum) / parameters.field_cell, vec2(0.0),
                    vec2(blocks * FIELD_BLOCK_CELLS_ACROSS) - 1.0e-3);
    uvec2 block = uvec2(at) / FIELD_BLOCK_CELLS_ACROSS;
    uint cells = texelFetch(field_cells, int(block.y * blocks.x + block.x)).x;
    uint first = blocks.x * blocks.y + field * parameters.cells_per_field;
    vec2 local = at - vec2(block * FIELD_BLOCK_CELLS_ACROSS);
    if (cells == 0u)
        return FieldCorners(first + block.y * (blocks.x + 1u) + block.x, blocks.x + 1u,
                            local / float(FIELD_BLOCK_CELLS_ACROSS));
    vec2 cell = floor(local + 0.5);
    uint corner = first + cells + uint(cell.y) * FIELD_BLOCK_ROW + uint(cell.x);
    return FieldCorners(corner, FIELD_BLOCK_ROW, local + 0.5 - cell);
}

FieldCorners cornersOf(uint field, vec2 position) {
    if (parameters.field_blocks_across > 0u) return cornersInBlocks(field, position);
    uvec2 cell;
    vec2 fraction;
    gridPosition(position, parameters.grid_cell, uvec2(parameters.grid_width, parameters.grid_height), cell, fraction);
    return FieldCorners(field * parameters.cells_per_field + cell.y * parameters.grid_width + cell.x,
                        parameters.grid_width, fraction);
}

/// Straight where most of the cells round about say so.
RouteAhead sampleField(uint field, vec2 position) {
    FieldCorners corners = cornersOf(field, position);
    FieldCell corner[4] = FieldCell[4](fieldCell(corners.first), fieldCell(corners.first + 1u),
                                       fieldCell(corners.first + corners.row),
                                       fieldCell(corners.first + corners.row + 1u));
    vec2 fraction = corners.fraction;
    vec4 weight = vec4((1.0 - fraction.x) * (1.0 - fraction.y), fraction.x * (1.0 - fraction.y),
                       (1.0 - fraction.x) * fraction.y, fraction.x * fraction.y);
    RouteAhead ahead = RouteAhead(vec2(0.0), 0.0, false);
    float straight = 0.0;
    for (int i = 0; i < 4; ++i) {
        ahead.direction += weight[i] * unpackSnorm2x16(corner[i].direction);
        ahead.remaining += weight[i] * abs(corner[i].distance);
        if (corner[i].distance < 0.0) straight += weight[i];
    }
    ahead.straight = straight > 0.5;
    float size = length(ahead.direction);
    // Where routes part (behind an obstacle) the corners cancel out: take one side, always the same.
    ahead.direction = size > 0.05 ? ahead.direction / size : unpackSnorm2x16(corner[0].direction);
    return ahead;
}

/// Without jams the distance falls by one per metre in this direction; jams add their slope.
vec2 roundJams(uint field, vec2 position, vec2 direction) {
    if (parameters.detour_width == 0u) return direction;
    vec2 downhill = direction - detourSlope(field, position);
    float size = length(downhill);
    return size > 0.05 ? downhill / size : direction;
}

/// While nobody is in the way.
RouteAhead freeRouteAhead(Stage stage, vec2 position) {
    vec2 offset = stage.point - position;
    float remaining = length(offset);
    RouteAhead straight = RouteAhead(remaining > 1.0e-6 ? offset / remaining : vec2(0.0), remaining, true);
    if (stage.field == NO_INDEX) return straight;
    RouteAhead ahead = sampleField(stage.field & ~FIELD_THEN_POINT, position);
    if ((stage.field & FIELD_THEN_POINT) == 0u) return ahead;
    if (ahead.straight || ahead.remaining <= 0.0) return straight;
    ahead.remaining = max(ahead.remaining, remaining);
    return ahead;
}

/// The same with the crowd as it is at a position.
RouteAhead heedingJams(Stage stage, vec2 position, RouteAhead ahead) {
    if (stage.field == NO_INDEX) return ahead;
    bool to_point = (stage.field & FIELD_THEN_POINT) != 0u;
    // What is near, the coarse map of jams does not know.
    if (to_point && ahead.straight && ahead.remaining <= parameters.detour_cell) return ahead;
    ahead.direction = roundJams(stage.field & ~FIELD_THEN_POINT, position, ahead.direction);
    return ahead;
}

RouteAhead routeAhead(Stage stage, vec2 position) {
    return heedingJams(stage, position, freeRouteAhead(stage, position));
}
