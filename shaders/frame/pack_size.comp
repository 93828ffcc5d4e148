// SPDX-License-Identifier: Apache-2.0
// How much room bodies take: times their own size, and how broad and deep they are.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer People { Person people[]; };
layout(std430) writeonly buffer StreamBlock { float values[]; };

void main() {
    uint row = gl_GlobalInvocationID.x;
    if (row >= parameters.row_count) return;
    float radius = people[row].radius, half_axis = people[row].half_axis;
    float thickness = radius - abs(half_axis);
    values[3u * row] = radius / people[row].own_radius;
    values[3u * row + 1u] = 2.0 * (half_axis >= 0.0 ? radius : thickness);
    values[3u * row + 2u] = 2.0 * (half_axis > 0.0 ? thickness : radius);
}
