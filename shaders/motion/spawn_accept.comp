// SPDX-License-Identifier: Apache-2.0
// Of those who found room, the ones that would stand in each other's way give way to the smaller row, and the rest
// enter.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = SPAWN_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer People { Person people[]; };
layout(std430) readonly buffer Stages { Stage stages[]; };
layout(std430) readonly buffer DetourSlopes { vec2 detour_slopes[]; };
layout(std430) readonly buffer WaitingLines { WaitingLine waiting_lines[]; };
layout(std430) readonly buffer LinePoints { vec2 line_points[]; };
layout(std430) readonly buffer Proposals { SpawnProposal proposals[]; };
layout(std430) buffer States { AgentState states[]; };
uniform usamplerBuffer field_cells;  // FieldCell
uniform uint steps_done;  // counted with this one

#ifdef BODIES
layout(std430) writeonly buffer Chests { Chest chests[]; };
#endif

#include "shaders/routes/route.glsl"
#include "shaders/motion/waiting_line.glsl"

void main() {
    SpawnProposal mine = proposals[gl_GlobalInvocationID.x];
    if (mine.row == NO_INDEX) return;
    uint count = parameters.queue_count * SPAWN_GROUP_SIZE;
    for (uint i = 0u; i < count; ++i) {
        SpawnProposal other = proposals[i];
        float apart = other.radius + mine.radius + ENTERING_BESIDE;
        if (other.row < mine.row && distance(other.position, mine.position) < apart) return;
    }
    Person person = people[mine.row];
    AgentState state = states[mine.row];
    RouteAhead ahead = routeAhead(stageOf(state.stage, state.ticket, mine.position), mine.position);
    bool turned = (person.flags & PERSON_FIXED_SPAWN) == 0u && ahead.direction != vec2(0.0);
    state.heading = turned ? atan(ahead.direction.y, ahead.direction.x) : person.heading;
    state.position = mine.position;
    // People walk in rather than start from a stand.
    state.velocity = turned ? ahead.direction * person.preferred_speed * ENTERING_PACE : vec2(0.0);
    state.status = STATUS_WALKING;
    state.spawn_step = steps_done;
    states[mine.row] = state;
#ifdef BODIES
    chests[mine.row].angle = state.heading;
    chests[mine.row].rate = 0.0;
#endif
}
