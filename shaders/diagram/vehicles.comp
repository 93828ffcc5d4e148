// SPDX-License-Identifier: Apache-2.0
// Vehicles in the diagram, as walls that move: a pixel is a vehicle's where that is nearer than the owner, and no
// further than a wall's tile reaches. Their outlines are boxes, so none of the ways to build a diagram has them among
// its sites: they are laid over whatever it has built.
//
// One group a vehicle goes through the pixels about it. Where two are near to each other, each finds the winner among
// all of them, and only the winner reads and writes the pixel: the result does not depend on the order.
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

const uint MOST_BESIDE = 32u;
uint beside[MOST_BESIDE];  // vehicles that may reach the same pixels
uint beside_count = 0u;

/// Pixels within its reach, clipped to the window: corner and one past the opposite corner.
ivec4 boundsOf(VehicleBox box) {
    vec2 rear = pixelsOf(box.rear), front = pixelsOf(box.front);
    float reach = box.half_width * pixels_per_metre + vehicle_reach + 1.0;
    vec2 lower = min(rear, front) - reach, upper = max(rear, front) + reach + 1.0;
    return ivec4(clamp(lower, vec2(0.0), diagram_size), clamp(upper, vec2(0.0), diagram_size));
}

void findThoseBeside(uint self, ivec4 bounds) {
    for (uint other = 0u; other < VEHICLES && beside_count < MOST_BESIDE; ++other) {
        if (other == self || vehicle_boxes[other].half_width <= 0.0) continue;
        ivec4 theirs = boundsOf(vehicle_boxes[other]);
        if (any(lessThan(theirs.zw, bounds.xy)) || any(lessThan(bounds.zw, theirs.xy))) continue;
        beside[beside_count++] = other;
    }
}

bool isNearest(uint self, float distance_squared, ivec2 pixel) {
    for (uint i = 0u; i < beside_count; ++i) {
        float theirs = squaredDistanceToVehicle(beside[i], pixel);
        if (theirs < distance_squared || (theirs == distance_squared && beside[i] < self)) return false;
    }
    return true;
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

void take(uint self, ivec2 pixel) {
    float distance_squared = squaredDistanceToVehicle(self, pixel);
    uint word;
    if (distance_squared > squaredRadius(vehicle_reach) || !wordOf(pixel, word)) return;
    if (!isNearest(self, distance_squared, pixel)) return;
    uint owner = owners[word];
    // Where nobody looks, what was a vehicle's may still be so.
    if (owner < first_vehicle &&
        squaredDistance(sites[site_slots[owner]].position, pixel) <= distance_squared)
        return;
    owners[word] = first_vehicle + self;
}

void main() {
    uint self = gl_WorkGroupID.x;
    if (self >= VEHICLES || vehicle_boxes[self].half_width <= 0.0) return;
    ivec4 bounds = boundsOf(vehicle_boxes[self]);
    findThoseBeside(self, bounds);
    uint width = uint(bounds.z - bounds.x), height = uint(bounds.w - bounds.y);
    for (uint i = gl_LocalInvocationIndex; i < width * height; i += PIXEL_GROUP_SIZE)
        take(self, bounds.xy + ivec2(i % width, i / width));
}
