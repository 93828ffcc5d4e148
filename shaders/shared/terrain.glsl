// SPDX-License-Identifier: Apache-2.0
// Heights and slopes of the ground (authoring/terrain/terrain.h).
#include "shaders/shared/terrain_types.h"

layout(std430) readonly buffer TerrainNodes { TerrainNode terrain_nodes[]; };
uniform vec2 terrain_minimum;  // m, scene frame
uniform float lattice_cell;    // m
uniform uvec2 lattice_size;

/// The ground without its steps: height and, in y, how much of its slope is that of stairs.
vec2 smoothGround(vec2 position) {
    vec2 at = clamp((position - terrain_minimum) / lattice_cell, vec2(0.0), vec2(lattice_size) - 1.001);
    uvec2 cell = uvec2(at);
    vec2 f = at - vec2(cell);
    uint low = cell.y * lattice_size.x + cell.x;
    uint high = low + lattice_size.x;
    TerrainNode n00 = terrain_nodes[low], n10 = terrain_nodes[low + 1u],
                n01 = terrain_nodes[high], n11 = terrain_nodes[high + 1u];
    return mix(mix(vec2(n00.height, n00.steps), vec2(n10.height, n10.steps), f.x),
               mix(vec2(n01.height, n01.steps), vec2(n11.height, n11.steps), f.x), f.y);
}

/// Rise over run in a direction, from `reach` behind to `reach` ahead (m). Where the ground ends on one side, over a
/// drop, only the other counts: who walks away from an edge climbs no cliff. A drop is where one side is steeper than
/// anybody walks on, and the other is not as steep.
/// @param here m: the height of the smooth ground at the position
float smoothSlope(vec2 position, vec2 direction, float reach, float here) {
    float ahead = smoothGround(position + reach * direction).x, behind = smoothGround(position - reach * direction).x;
    float slope = (ahead - behind) / (2.0 * reach);
    vec2 sides = vec2(ahead - here, here - behind) / reach;
    bool is_drop = max(abs(sides.x), abs(sides.y)) > STEEPEST_GROUND && abs(sides.x - sides.y) > STEEPEST_GROUND;
    if (abs(slope) <= STEEPEST_GROUND && !is_drop) return slope;
    float gentler = abs(sides.x) < abs(sides.y) ? sides.x : sides.y;
    return abs(gentler) <= STEEPEST_GROUND ? gentler : 0.0;
}
