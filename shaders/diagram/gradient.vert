// SPDX-License-Identifier: Apache-2.0
// A tile as a point sprite (Denny 2003). Sites are drawn in the order of their ids, so that of two at the same
// distance the smaller id has been drawn first and stays.
#include "shaders/shared/simulation_types.h"

layout(std430) readonly buffer Sites { DiagramSite sites[]; };
layout(std430) readonly buffer SiteSlots { uint site_slots[]; };
uniform vec2 target_size;  // px, the window and its margin on all sides
// px: a sprite is clipped by its centre, so centres outside the window must still be inside the target.
uniform float margin;

flat out vec2 site_position;
flat out float site_radius;
flat out uint site_id;

void main() {
    uint index = site_slots[gl_VertexID];
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    gl_PointSize = 1.0;
    site_position = vec2(0.0);
    site_radius = 0.0;
    site_id = NO_INDEX;
    if (index == NO_INDEX) return;
    DiagramSite site = sites[index];
    site_position = site.position;
    site_radius = site.radius;
    site_id = site.id;
    gl_Position = vec4((site.position + margin) / target_size * 2.0 - 1.0, 0.0, 1.0);
    // Half a pixel on each side covers the rasteriser's snapping of the centre.
    gl_PointSize = 2.0 * site.radius + 1.0;
}
