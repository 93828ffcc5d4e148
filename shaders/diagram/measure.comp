// SPDX-License-Identifier: Apache-2.0
// The squared distance from every pixel to its owner, whoever found the owner.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = PIXEL_GROUP_SIZE) in;
layout(std430) readonly buffer Owners { uint owners[]; };
layout(std430) readonly buffer Sites { DiagramSite sites[]; };
layout(std430) readonly buffer SiteSlots { uint site_slots[]; };
layout(std430) writeonly buffer Distances { float distances[]; };
uniform uvec2 diagram_size;

#include "shaders/diagram/distance.glsl"
#include "shaders/shared/flat_index.glsl"
#ifdef TRAFFIC
#include "shaders/diagram/vehicle_sites.glsl"
#endif

float squaredDistanceTo(uint owner, ivec2 pixel) {
#ifdef TRAFFIC
    if (owner >= first_vehicle) return squaredDistanceToVehicle(owner - first_vehicle, pixel);
#endif
    return squaredDistance(sites[site_slots[owner]].position, pixel);
}

void main() {
    uint index = flatIndex();
    if (index >= diagram_size.x * diagram_size.y) return;
    uint owner = owners[index];
    float squared = uintBitsToFloat(0x7f800000u);
    if (owner != NO_INDEX) squared = squaredDistanceTo(owner, ivec2(index % diagram_size.x, index / diagram_size.x));
    distances[index] = squared;
}
