// SPDX-License-Identifier: Apache-2.0
// The Voronoi method of pedestrian dynamics (Steffen and Seyfried 2010): a person's density is one over the area of its
// cell. The cell is truncated at the tile radius r, so nobody has less than 1 / (pi r^2).
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer People { Person people[]; };
layout(std430) readonly buffer States { AgentState states[]; };
layout(std430) readonly buffer PixelCounts { uint pixel_counts[]; };
layout(std430) writeonly buffer StreamBlock { float densities[]; };

#include "shaders/shared/alive.glsl"

void main() {
    uint row = gl_GlobalInvocationID.x;
    if (row >= parameters.row_count) return;
    bool alive = isAlive(states[row].status);
    float pixel_area = 1.0 / (parameters.pixels_per_metre * parameters.pixels_per_metre);
    // Somebody who shares a pixel with a nearer one may own none; half a pixel keeps the density finite.
    float area = alive ? max(float(pixel_counts[row]), 0.5) * pixel_area : 0.0;
    float tile_radius = max(parameters.tile_radius, people[row].radius);
    float whole = 3.14159265 * tile_radius * tile_radius;
    densities[3u * row] = alive ? 1.0 / area : 0.0;
    densities[3u * row + 1u] = area;
    densities[3u * row + 2u] = min(area / whole, 1.0);
}
