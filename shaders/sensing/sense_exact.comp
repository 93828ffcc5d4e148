// SPDX-License-Identifier: Apache-2.0
// The same contract as sense.comp, served without the diagram: everybody within the reach of the rays and the field of
// view, exactly. With EVERYBODY, by comparing all with all; otherwise through the cells around the person, as spatial
// hashing on the GPU does it (Bleiweiss 2009). They are what the diagram is measured against.
#include "shaders/shared/simulation_types.h"

#include "shaders/sensing/neighbour_list.glsl"
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
#include "shaders/charts/slot_images.glsl"

#ifdef TRAFFIC
#include "shaders/sensing/vehicles_met.glsl"
#endif

#ifdef EVERYBODY
uniform uint wall_count;
#else
layout(std430) readonly buffer FarWallStarts { uint far_wall_starts[]; };  // walls within the reach of each cell
layout(std430) readonly buffer FarWallItems { uint far_wall_items[]; };
#endif
uniform float reach;      // m
uniform float half_view;  // rad

/// @param forward the direction of view, of unit length
bool isInView(vec2 forward, vec2 offset) {
    if (half_view > 3.1415) return true;
    float ahead = dot(forward, offset);
    float aside = abs(forward.x * offset.y - forward.y * offset.x);
    return atan(aside, ahead) <= half_view;
}

/// Whether the line from the eye along `edge` (its length is the reach) meets the segment; all relative to the eye.
bool edgeMeets(vec2 edge, vec2 a, vec2 b) {
    vec2 along = b - a;
    float crossing = edge.x * along.y - edge.y * along.x;
    if (abs(crossing) < 1.0e-9) return false;
    float on_edge = (a.x * along.y - a.y * along.x) / crossing;
    float on_wall = (a.x * edge.y - a.y * edge.x) / crossing;
    return on_edge >= 0.0 && on_edge <= 1.0 && on_wall >= 0.0 && on_wall <= 1.0;
}

/// A wall is seen if its nearest point is, or if it reaches into the view across one of the view's edges.
bool isWallInView(vec2 position, vec2 forward, uint segment) {
    WallSegment wall = wall_segments[segment];
    vec2 offset = nearestOnSegment(position, wall.a, wall.b) - position;
    if (length(offset) > reach + wall.half_thickness) return false;
    if (isInView(forward, offset)) return true;
    vec2 turn = vec2(cos(half_view), sin(half_view));
    vec2 left = reach * vec2(forward.x * turn.x - forward.y * turn.y, forward.x * turn.y + forward.y * turn.x);
    vec2 right = reach * vec2(forward.x * turn.x + forward.y * turn.y, forward.y * turn.x - forward.x * turn.y);
    return edgeMeets(left, wall.a - position, wall.b - position) ||
           edgeMeets(right, wall.a - position, wall.b - position);
}

void weighSlots(Body self, vec2 forward, uint first, uint last) {
    float felt = parameters.contact_range * parameters.contact_range;
    for (uint slot = first; slot < last; ++slot) {
        vec2 offset = bodies[slot].position - self.position;
        float distance_squared = dot(offset, offset);
        // Those within the contact range are listed already, and nobody is farther than the last of a full list.
        if (distance_squared <= felt || distance_squared > reach * reach) continue;
        if (distance_squared > nearest_distance[NEIGHBOURS - 1] || !isInView(forward, offset)) continue;
        keepNearest(distance_squared, slot);
    }
}

#ifdef TRAFFIC
void weighVehicles(Body self, vec2 forward) {
    hearVehicles(self);
    for (uint vehicle = 0u; vehicle < VEHICLES; ++vehicle) {
        VehicleBox box = vehicle_boxes[vehicle];
        vec2 outward;
        float away = distanceToBox(self.position, box.rear, box.front, box.half_width, outward);
        if (away <= reach && isInView(forward, -away * outward)) weighVehicle(self, vehicle, true);
    }
}
#endif

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= live_count || holdsImage(slot)) return;
    Body self = bodies[slot];
    forgetEverybody();
    uint touch_word = feelContacts(self, slot);
    vec2 forward = vec2(cos(self.heading), sin(self.heading));
#ifdef EVERYBODY
    weighSlots(self, forward, 0u, live_count);
    for (uint wall = 0u; wall < wall_count; ++wall)
        if (isWallInView(self.position, forward, wall)) weighWall(self.position, wall);
#else
    ivec2 cell = cellOf(self.position);
    ivec2 lower = cellOf(self.position - reach);
    ivec2 upper = cellOf(self.position + reach);
    // The own line first: the nearest come early, and the rest are turned away by their distance alone.
    for (int i = 0; i <= 2 * max(cell.y - lower.y, upper.y - cell.y); ++i) {
        int y = cell.y + ((i & 1) == 1 ? (i + 1) / 2 : -(i / 2));
        if (y < lower.y || y > upper.y) continue;
        uint line = uint(y) * parameters.cells_width;
        weighSlots(self, forward, cellStart(line + uint(lower.x)), cellStart(line + uint(upper.x) + 1u));
    }
    uint number = cellIndex(cell);
    for (uint i = far_wall_starts[number]; i < far_wall_starts[number + 1u]; ++i)
        if (isWallInView(self.position, forward, far_wall_items[i])) weighWall(self.position, far_wall_items[i]);
#endif
    publish(slot, touch_word);
#ifdef TRAFFIC
    weighVehicles(self, forward);
    publishVehicles(slot);
#endif
}
