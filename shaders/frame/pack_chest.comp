// SPDX-License-Identifier: Apache-2.0
// Which way the chests of people with bodies that are no discs point, from where they face, how fast they turn, and how
// broad people are across the way that they face.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer People { Person people[]; };
layout(std430) readonly buffer States { AgentState states[]; };
layout(std430) readonly buffer Chests { Chest chests[]; };
layout(std430) writeonly buffer StreamBlock { float values[]; };

#include "shaders/shared/alive.glsl"

void main() {
    uint row = gl_GlobalInvocationID.x;
    if (row >= parameters.row_count) return;
    bool alive = isAlive(states[row].status);
    float half_axis = people[row].half_axis;
    Chest chest = Chest(0.0, 0.0, 0.0, 0.0);
    if (half_axis != 0.0) chest = chests[row];  // where all are discs, nobody has one
    float turned = chest.angle - states[row].heading;
    float twist = half_axis != 0.0 ? atan(sin(turned), cos(turned)) : 0.0;
    float across = abs(half_axis * (half_axis >= 0.0 ? cos(twist) : sin(twist)));
    values[3u * row] = alive ? twist : 0.0;
    values[3u * row + 1u] = alive ? chest.rate : 0.0;
    values[3u * row + 2u] = alive ? 2.0 * (people[row].radius - abs(half_axis) + across) : 0.0;
}
