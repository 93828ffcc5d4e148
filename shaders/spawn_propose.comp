// SPDX-License-Identifier: Apache-2.0
// People whose time has come look for room: one group per queue, one invocation per waiting person.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = SPAWN_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) readonly buffer People { Person people[]; };
layout(std430) readonly buffer Queues { SpawnQueue queues[]; };
layout(std430) readonly buffer Entries { Entry entries[]; };
layout(std430) readonly buffer EntryPoints { vec2 entry_points[]; };
layout(std430) readonly buffer Bodies { Body bodies[]; };
layout(std430) readonly buffer CellStarts { uint cell_starts[]; };
layout(std430) buffer States { AgentState states[]; };
layout(std430) buffer QueueHeads { uint queue_heads[]; };
layout(std430) writeonly buffer Proposals { SpawnProposal proposals[]; };
uniform float now;  // s

#include "shaders/random.glsl"
#include "shaders/cells.glsl"
#include "shaders/cell_runs.glsl"

/// Room to leave around a newcomer (m): those already there do not know of it before the next step.
const float SPAWN_MARGIN = 0.1;
const uint PURPOSE_ENTRY = 0xe7u;

shared uint head;

bool hasRoom(vec2 position, float radius) {
    ivec2 cell = cellOf(position);
    for (int y = cell.y - 1; y <= cell.y + 1; ++y) {
        uvec2 run = slotRun(cell.x, y);
        for (uint slot = run.x; slot < run.y; ++slot)
            if (distance(bodies[slot].position, position) < radius + bodies[slot].radius + SPAWN_MARGIN) return false;
    }
    return true;
}

void main() {
    uint queue = gl_WorkGroupID.x;
    uint lane = gl_LocalInvocationID.x;
    uint index = gl_GlobalInvocationID.x;
    uint rows = queues[queue].row_count;

    // The head moves past those who have entered; holes behind it are skipped over below.
    if (lane == 0u) head = rows;
    barrier();
    uint candidate = queue_heads[queue] + lane;
    if (candidate < rows && states[queues[queue].first_row + candidate].status == STATUS_WAITING) atomicMin(head, candidate);
    barrier();
    if (lane == 0u) queue_heads[queue] = head == rows ? min(queue_heads[queue] + SPAWN_GROUP_SIZE, rows) : head;

    SpawnProposal proposal = SpawnProposal(vec2(0.0), 0.0, NO_INDEX);
    uint place = head + lane;
    if (place < rows) {
        uint row = queues[queue].first_row + place;
        Person person = people[row];
        if (states[row].status == STATUS_WAITING && person.spawn_time <= now) {
            vec2 position = person.spawn_position;
            if ((person.flags & PERSON_FIXED_SPAWN) == 0u) {
                Entry entry = entries[person.entry];
                uint pick = randomWord(parameters.seed ^ PURPOSE_ENTRY, row, states[row].attempts) % entry.point_count;
                position = entry_points[entry.first_point + pick];
            }
            states[row].attempts += 1u;
            proposal.position = position;
            proposal.radius = person.radius;
            if (hasRoom(position, person.radius)) proposal.row = row;
        }
    }
    proposals[index] = proposal;
}
