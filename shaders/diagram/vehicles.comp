// SPDX-License-Identifier: Apache-2.0
// Vehicles in the diagram, as walls that move: a pixel is a vehicle's where that is nearer than the owner, and no
// further than a wall's tile reaches. Their outlines are boxes, so none of the ways to build a diagram has them among
// its sites: they are laid over whatever it has built.
//
// One group a vehicle goes through the pixels about it. Where two may reach the same pixel, the first of them decides
// for both: nobody else reads or writes that pixel, and the result does not depend on the order.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = PIXEL_GROUP_SIZE) in;
layout(std430) readonly buffer Sites { DiagramSite sites[]; };
layout(std430) readonly buffer SiteSlots { uint site_slots[]; };
layout(std430) buffer Owners { uint owners[]; };
#ifdef PAGED
uniform usamplerBuffer page_table;
uniform uint pages_per_line;
uniform uint first_page;  // of those that Owners shows
uniform uint page_count;
#endif
uniform vec2 diagram_size;  // whole pixels

#include "shaders/diagram/distance.glsl"
#include "shaders/diagram/vehicle_sites.glsl"

const uint MOST_LISTED = 32u;
uint listed[MOST_LISTED];  // vehicles that may reach the same pixels
uint listed_count = 0u;    // more than MOST_LISTED: all have to be looked at

/// Pixels within its reach and `margin` px beyond, clipped to the window: corner and one past the opposite corner.
ivec4 boundsOf(VehicleBox box, float margin) {
    vec2 rear = pixelsOf(box.rear), front = pixelsOf(box.front);
    float reach = box.half_width * pixels_per_metre + vehicle_reach + margin;
    vec2 lower = min(rear, front) - reach, upper = max(rear, front) + reach + 1.0;
    return ivec4(clamp(lower, vec2(0.0), diagram_size), clamp(upper, vec2(0.0), diagram_size));
}

// A vehicle goes through more pixels than others leave to it: however bounds are rounded, none is left out.
const float VISITED = 2.0, LEFT_TO_IT = 1.0;  // px

bool holds(ivec4 bounds, ivec2 pixel) {
    return all(greaterThanEqual(pixel, bounds.xy)) && all(lessThan(pixel, bounds.zw));
}

bool isThereBeside(uint self, uint other) { return other != self && vehicle_boxes[other].half_width > 0.0; }

void listThoseBeside(uint self, ivec4 bounds) {
    for (uint other = 0u; other < VEHICLES; ++other) {
        if (!isThereBeside(self, other)) continue;
        ivec4 theirs = boundsOf(vehicle_boxes[other], VISITED);
        if (any(lessThanEqual(theirs.zw, bounds.xy)) || any(lessThanEqual(bounds.zw, theirs.xy))) continue;
        if (listed_count < MOST_LISTED) listed[listed_count] = other;
        ++listed_count;
    }
}

/// Of all that reach a pixel, the nearest; of several the first.
/// @param distance_squared px^2, to it. @returns NO_INDEX where another vehicle decides
uint nearestVehicle(uint self, ivec2 pixel, out float distance_squared) {
    uint nearest = self;
    distance_squared = squaredDistanceToVehicle(self, pixel);
    bool all_of_them = listed_count > MOST_LISTED;
    uint count = all_of_them ? VEHICLES : listed_count;
    for (uint i = 0u; i < count; ++i) {
        uint other = all_of_them ? i : listed[i];
        if (all_of_them && !isThereBeside(self, other)) continue;
        if (other < self && holds(boundsOf(vehicle_boxes[other], LEFT_TO_IT), pixel)) return NO_INDEX;
        float theirs = squaredDistanceToVehicle(other, pixel);
        if (theirs > distance_squared || (theirs == distance_squared && other > nearest)) continue;
        nearest = other;
        distance_squared = theirs;
    }
    return nearest;
}

/// @returns false where the diagram has no such pixel
bool wordOf(ivec2 pixel, out uint word) {
#ifdef PAGED
    uvec2 page = uvec2(pixel) / PAGE_SIDE, within = uvec2(pixel) % PAGE_SIDE;
    uint place = texelFetch(page_table, int(page.y * pages_per_line + page.x)).r;
    word = ((place - first_page) * PAGE_SIDE + within.y) * PAGE_SIDE + within.x;
    return place != 0u && place >= first_page && place - first_page < page_count;
#else
    word = uint(pixel.y) * uint(diagram_size.x) + uint(pixel.x);
    return true;
#endif
}

/// px^2, from whom a pixel belongs to so far. Where nobody looks, that may be somebody who has gone, or a vehicle.
float squaredDistanceToOwner(uint owner, ivec2 pixel) {
    uint slot = owner < first_vehicle ? site_slots[owner] : NO_INDEX;
    return slot == NO_INDEX ? 3.0e38 : squaredDistance(sites[slot].position, pixel);
}

void take(uint self, ivec2 pixel) {
    float distance_squared;
    uint word, nearest = nearestVehicle(self, pixel, distance_squared);
    if (nearest == NO_INDEX || distance_squared > squaredRadius(vehicle_reach) || !wordOf(pixel, word)) return;
    if (squaredDistanceToOwner(owners[word], pixel) > distance_squared) owners[word] = first_vehicle + nearest;
}

void main() {
    uint self = gl_WorkGroupID.x;
    if (self >= VEHICLES || vehicle_boxes[self].half_width <= 0.0) return;
    ivec4 bounds = boundsOf(vehicle_boxes[self], VISITED);
    listThoseBeside(self, bounds);
    uint width = uint(bounds.z - bounds.x), height = uint(bounds.w - bounds.y);
    for (uint i = gl_LocalInvocationIndex; i < width * height; i += PIXEL_GROUP_SIZE)
        take(self, bounds.xy + ivec2(i % width, i / width));
}
