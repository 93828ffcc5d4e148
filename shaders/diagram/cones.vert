// SPDX-License-Identifier: Apache-2.0
// A tile as a cone seen from its axis (Hoff et al. 1999): depth grows with the distance from the site, so the depth
// test keeps the nearest. A cone of n sides is a pyramid; its faces lie deeper than the cone by up to 1 / cos(pi / n),
// which is the error of this method: pixels near the border of two cells may go to the wrong one.
#include "shaders/shared/simulation_types.h"

layout(std430) readonly buffer Sites { DiagramSite sites[]; };
layout(std430) readonly buffer SiteSlots { uint site_slots[]; };
uniform vec2 target_size;  // px, the window and its margin on all sides
uniform float margin;
uniform float depth_scale;  // per px of distance
uniform uint sides;

flat out vec2 site_position;
flat out float site_radius;
flat out uint site_id;

void main() {
    uint index = site_slots[gl_InstanceID];
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    site_position = vec2(0.0);
    site_radius = 0.0;
    site_id = NO_INDEX;
    if (index == NO_INDEX) return;
    DiagramSite site = sites[index];
    site_position = site.position;
    site_radius = site.radius;
    site_id = site.id;
    // Three vertices a side: the apex and two on the rim. The rim lies outside the tile's circle, with half a pixel for
    // the rasteriser's snapping.
    uint corner = uint(gl_VertexID) % 3u;
    float turn = 6.28318530718 / float(sides);
    float angle = turn * float(uint(gl_VertexID) / 3u + (corner == 2u ? 1u : 0u));
    float rim = corner == 0u ? 0.0 : (site.radius + 0.5) / cos(0.5 * turn);
    vec2 place = site.position + rim * vec2(cos(angle), sin(angle));
    gl_Position = vec4((place + margin) / target_size * 2.0 - 1.0, 2.0 * rim * depth_scale - 1.0, 1.0);
}
