// SPDX-License-Identifier: Apache-2.0
// What everybody wanted in the last step: people are still in the slots that they had then. Who has come in since, or
// before the first step, wants to walk the way it faces.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) readonly buffer People { Person people[]; };
layout(std430) readonly buffer States { AgentState states[]; };
layout(std430) readonly buffer RowCells { uint row_cells[]; };
layout(std430) readonly buffer Bodies { Body bodies[]; };
layout(std430) readonly buffer PreferredVelocities { vec2 preferred_velocities[]; };
layout(std430) writeonly buffer StreamBlock { float wishes[]; };

#include "shaders/shared/alive.glsl"
#include "shaders/charts/slot_images.glsl"

void put(uint row, vec2 wish) {
    bool alive = isAlive(states[row].status);
    wishes[3u * row] = alive ? wish.x : 0.0;
    wishes[3u * row + 1u] = alive ? wish.y : 0.0;
    wishes[3u * row + 2u] = alive ? states[row].nervousness : 0.0;
}

void main() {
    // A slot and a row of the same number have nothing to do with each other: each row is put by one or the other.
    uint index = gl_GlobalInvocationID.x;
    if (index >= parameters.row_count) return;
    // Images have slots, too: there may be more of them than rows.
    for (uint slot = index; slot < live_count; slot += parameters.row_count)
        if (!holdsImage(slot)) put(bodies[slot].row, preferred_velocities[slot]);
    if (row_cells[index] != NO_INDEX) return;
    float heading = states[index].heading;
    put(index, people[index].preferred_speed * vec2(cos(heading), sin(heading)));
}
