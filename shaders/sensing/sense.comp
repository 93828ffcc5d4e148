// SPDX-License-Identifier: Apache-2.0
// What each person perceives: the nearest sites, found by marching rays through the truncated Voronoi diagram
// (De Gyves, Toledo and Rudomin 2013, equations (1) and (2)).
//
// A pixel's owner is the nearest site, so any site whose cell is wider than the gap between samples is met by one of
// them. The samples lie on the rays r_j = a + j b inside the field of view. Inner circles need fewer rays than the
// outermost one for the same gap, so the pattern (sim/sensing_pattern.h) thins them out. Samples only say who is there;
// distances are then taken from the exact positions, and the k nearest are kept.
//
// Crowding cuts cells until samples miss some of them, and nobody sees behind; people still feel who touches them. So
// everybody within the contact range is asked for exactly, whatever the field of view, through the cells.
//
// Candidates are first appended without a branch and then inserted into the sorted list: on wide SIMD units that costs
// half of inserting at every sample, because the lanes stay together.
#include "shaders/shared/simulation_types.h"

#include "shaders/sensing/neighbour_list.glsl"
#include "shaders/diagram/owners.glsl"
#include "shaders/diagram/band_slots.glsl"
#include "shaders/charts/slot_images.glsl"

#ifdef TRAFFIC
#include "shaders/sensing/vehicles_met.glsl"
uniform uint first_vehicle;  // of the sites' ids: those after the walls'
#endif

layout(std430) readonly buffer WallTiles { WallTile wall_tiles[]; };
/// m, in the person's own frame: where it looks, two samples to an element. Uniforms of no block would not do: devices
/// have room for as few as 512 of them.
layout(std140) uniform SensingPattern { vec4 pattern[SENSING_SAMPLES / 2]; };

/// Site ids met by the samples, without those met among the last three; at most one per sample. The samples come in the
/// order of their angle, so what lies in one direction is met in one go and few ids come twice.
uint candidates[SENSING_SAMPLES];

int candidate_count = 0;
uvec3 recent = uvec3(NO_INDEX);  // met last

/// @param offset px, from `centre`, in the plane
void lookAt(vec2 centre, vec2 offset, uint self_slot) {
    vec2 upper = vec2(parameters.diagram_width, parameters.diagram_height) - 1.0;
    vec2 pixel = centre + offset;
#ifdef CHARTS
    // In single precision, sums differ from one part of the plane to another.
    pixel = floor(centre) + floor(fract(centre) + offset);
#endif
    uvec2 at = uvec2(clamp(pixel, vec2(0.0), upper));
    uint owner = ownerAt(at);
    bool fresh = owner != NO_INDEX && owner != self_slot && owner != recent.x && owner != recent.y && owner != recent.z;
    candidates[candidate_count] = owner;
    candidate_count += fresh ? 1 : 0;
    recent = fresh ? uvec3(owner, recent.xy) : recent;
}

void marchRays(Body self, uint self_slot) {
    vec2 centre = (self.position - parameters.diagram_minimum) * parameters.pixels_per_metre;
    vec2 forward = vec2(cos(self.heading), sin(self.heading)) * parameters.pixels_per_metre;
    candidate_count = 0;
    recent = uvec3(self_slot);
    for (int i = 0; i < SENSING_SAMPLES / 2; ++i) {
        vec4 two = pattern[i];
        lookAt(centre, vec2(forward.x * two.x - forward.y * two.y, forward.y * two.x + forward.x * two.y), self_slot);
        lookAt(centre, vec2(forward.x * two.z - forward.y * two.w, forward.y * two.z + forward.x * two.w), self_slot);
    }
}

void weighBody(Body self, uint slot) {
    if (isKept(slot)) return;
    vec2 offset = bodies[slot].position - self.position;
    keepNearest(dot(offset, offset), slot);
}

void main() {
    uint slot;
    if (!findSlot(slot) || holdsImage(slot)) return;
    Body self = bodies[slot];
    forgetEverybody();
    uint touch_word = feelContacts(self, slot);
    marchRays(self, slot);
#ifdef TRAFFIC
    hearVehicles(self);
#endif
    for (int i = 0; i < candidate_count; ++i) {
        uint site = candidates[i];
        if (site < parameters.site_rows)
            weighBody(self, site);
#ifdef TRAFFIC
        else if (site >= first_vehicle)
            weighVehicle(self, site - first_vehicle, true);
#endif
        else
            weighWall(self.position, wall_tiles[site - parameters.site_rows].segment);
    }
    publish(slot, touch_word);
#ifdef TRAFFIC
    publishVehicles(slot);
#endif
}
