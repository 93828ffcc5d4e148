// SPDX-License-Identifier: Apache-2.0
// People whose time has come look for room: one group per queue, one invocation per waiting person.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = SPAWN_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) readonly buffer People { Person people[]; };
layout(std430) readonly buffer PlanChanges { PlanChange plan_changes[]; };
layout(std430) readonly buffer Queues { SpawnQueue queues[]; };
layout(std430) readonly buffer Entries { Entry entries[]; };
layout(std430) readonly buffer EntryPoints { vec2 entry_points[]; };
layout(std430) readonly buffer Bodies { Body bodies[]; };
layout(std430) buffer States { AgentState states[]; };
layout(std430) buffer QueueHeads { uint queue_heads[]; };
layout(std430) writeonly buffer Proposals { SpawnProposal proposals[]; };
uniform float now;        // s
uniform uint steps_done;  // counted with this one

#include "shaders/shared/random.glsl"
#include "shaders/cells/cells.glsl"
#include "shaders/cells/cell_runs.glsl"

const uint PURPOSE_ENTRY = 0xe7u;

/// Of so many points, those who belong to somebody who is there already take the nearest to it.
const uint TRIES_TO_JOIN = 96u;

shared uint head;

bool hasRoom(vec2 position, float radius) {
    ivec2 cell = cellOf(position);
    for (int y = cell.y - 1; y <= cell.y + 1; ++y) {
        uvec2 run = slotRun(cell.x, y);
        for (uint slot = run.x; slot < run.y; ++slot)
            if (distance(bodies[slot].position, position) < radius + bodies[slot].radius + ENTERING_ROOM) return false;
    }
    return true;
}

/// Who is told to go elsewhere before it comes in does not come in.
bool isCalledOff(Person person) {
    return person.change_count > 0u && plan_changes[person.first_change].start_step <= steps_done;
}

/// Who is given comes when its way begins, whoever stands there (shaders/given).
bool isGiven(Person person) { return (person.flags & PERSON_IS_GIVEN) != 0u; }

/// The first of a party comes in first, and the others beside it.
bool isFirstAwaited(uint row, Person person) {
    return (person.flags & PERSON_FIXED_SPAWN) == 0u && person.party_first != row &&
           states[person.party_first].status == STATUS_WAITING;
}

vec2 entryPoint(Entry entry, uint row, uint attempt) {
    uint pick = randomWord(parameters.seed ^ PURPOSE_ENTRY, row, attempt) % entry.point_count;
    return entry_points[entry.first_point + pick];
}

/// Where to come in: anywhere, or beside those one walks with.
vec2 chooseEntry(uint row, Person person) {
    Entry entry = entries[person.entry];
    uint attempt = states[row].attempts;
    for (uint other = person.party_first; other < row; ++other) {
        if (states[other].status != STATUS_WALKING) continue;
        vec2 best = entryPoint(entry, row, attempt * TRIES_TO_JOIN);
        for (uint i = 1u; i < TRIES_TO_JOIN; ++i) {
            vec2 point = entryPoint(entry, row, attempt * TRIES_TO_JOIN + i);
            if (distance(point, states[other].position) < distance(best, states[other].position) &&
                distance(point, states[other].position) > person.radius + people[other].radius + ENTERING_ROOM)
                best = point;
        }
        return best;
    }
    return entryPoint(entry, row, attempt);
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
    if (candidate < rows && states[queues[queue].first_row + candidate].status == STATUS_WAITING)
        atomicMin(head, candidate);
    barrier();
    if (lane == 0u) queue_heads[queue] = head == rows ? min(queue_heads[queue] + SPAWN_GROUP_SIZE, rows) : head;

    SpawnProposal proposal = SpawnProposal(vec2(0.0), 0.0, NO_INDEX);
    uint place = head + lane;
    if (place < rows) {
        uint row = queues[queue].first_row + place;
        Person person = people[row];
        if (states[row].status == STATUS_WAITING && person.spawn_time <= now && !isGiven(person) &&
            !isCalledOff(person) && !isFirstAwaited(row, person)) {
            bool fixed_place = (person.flags & PERSON_FIXED_SPAWN) != 0u;
            vec2 position = fixed_place ? person.spawn_position : chooseEntry(row, person);
            states[row].attempts += 1u;
            proposal.position = position;
            proposal.radius = person.radius;
            if (hasRoom(position, person.radius)) proposal.row = row;
        }
    }
    proposals[index] = proposal;
}
