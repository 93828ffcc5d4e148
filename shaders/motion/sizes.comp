// SPDX-License-Identifier: Apache-2.0
// Sizes: how much room bodies take on ground that makes it more or less (umbrellas, luggage in hand). Where several
// patches lie over each other, their factors are multiplied.
//
// Whoever grows takes what is free around it, and contact, which keeps a hair between bodies, makes more of it free: so
// a crowd spreads as fast as contact moves it, and where there is nowhere to go people stay as large as they have room
// for. Growth itself puts nobody into anybody else, or into a wall; out of vehicles keep_off.comp takes them.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) readonly buffer Bodies { Body bodies[]; };
layout(std430) readonly buffer Walkers { Walker walkers[]; };
layout(std430) readonly buffer WallSegments { WallSegment wall_segments[]; };
layout(std430) readonly buffer WallStarts { uint wall_starts[]; };
layout(std430) readonly buffer WallItems { uint wall_items[]; };
layout(std430) readonly buffer Patches { Patch patches[]; };
layout(std430) readonly buffer PatchPoints { vec2 patch_points[]; };
layout(std430) buffer People { Person people[]; };
#ifdef BODIES
layout(std430) buffer Chests { Chest chests[]; };
#endif
uniform uint patch_count;
uniform float now;  // s

#include "shaders/cells/cells.glsl"
#include "shaders/cells/walls_near.glsl"
#include "shaders/cells/cell_runs.glsl"
#include "shaders/motion/on_patch.glsl"
#include "shaders/motion/room_to_grow.glsl"
#include "shaders/shared/images.glsl"

float sizeAt(vec2 place) {
    float size = 1.0;
    for (uint i = 0u; i < patch_count; ++i)
        if (holds(patches[i], place, now)) size *= patches[i].size;
    return clamp(size, LEAST_SIZE, MOST_SIZE);
}

/// The radius that somebody has from now on, m.
float radiusTowards(float wanted, uint slot) {
    float radius = bodies[slot].radius;
    float most = GROWTH * parameters.decision_seconds;
    if (wanted > radius) most = min(most, roomToGrow(slot));
    return abs(wanted - radius) <= most ? wanted : radius + (wanted > radius ? most : -most);
}

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= live_count || isImage(walkers[slot].flags)) return;
    uint row = bodies[slot].row;
    float own = people[row].own_radius;
    float wanted = own * sizeAt(bodies[slot].position);
    if (wanted == bodies[slot].radius) return;
    float radius = radiusTowards(wanted, slot);
    people[row].radius = radius;
#ifdef BODIES
    float half_axis = chests[row].own_half_axis * (radius / own);
    people[row].half_axis = half_axis;
    chests[row].half_axis = half_axis;
#endif
}
