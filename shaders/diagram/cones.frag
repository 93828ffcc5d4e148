// SPDX-License-Identifier: Apache-2.0
// The depth is the pyramid's own; only the truncation is exact.
#include "shaders/shared/simulation_types.h"

flat in vec2 site_position;
flat in float site_radius;
flat in uint site_id;
layout(location = 0) out uint owner;
uniform float margin;

#include "shaders/diagram/distance.glsl"

void main() {
    float squared = squaredDistance(site_position, ivec2(gl_FragCoord.xy) - ivec2(margin));
    if (squared > squaredRadius(site_radius)) discard;
    owner = site_id;
}
