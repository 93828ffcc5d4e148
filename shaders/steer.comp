// SPDX-License-Identifier: Apache-2.0
// The velocity that each person would like, were it alone.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) readonly buffer People { Person people[]; };
layout(std430) readonly buffer States { AgentState states[]; };
layout(std430) readonly buffer Bodies { Body bodies[]; };
layout(std430) readonly buffer Stages { Stage stages[]; };
layout(std430) readonly buffer Fields { FieldCell fields[]; };
layout(std430) readonly buffer DetourSlopes { vec2 detour_slopes[]; };
layout(std430) writeonly buffer PreferredVelocities { vec2 preferred_velocities[]; };

#include "shaders/random.glsl"
#include "shaders/route.glsl"

/// Two people who walk straight at each other, and rings of people who all aim at the centre, are in an unstable
/// balance that half-planes never leave. Everybody therefore aims a little beside the mark, by up to this angle (rad).
const float SYMMETRY_BREAKING = 0.02;
const uint PURPOSE_SYMMETRY = 0x51u;

/// Those who stay come to rest at their goal: they slow down by this much (m/s^2), and close in on the last decimetres
/// with this time constant (s), instead of overshooting.
const float STOPPING = 0.7;
const float SETTLING_TIME = 0.8;

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= live_count) return;
    uint row = bodies[slot].row;
    Person person = people[row];
    uint stage = person.first_stage + min(states[row].stage, person.stage_count - 1u);
    RouteAhead ahead = routeAhead(stages[stage], bodies[slot].position);

    float angle = (randomUnit(parameters.seed, row, PURPOSE_SYMMETRY) * 2.0 - 1.0) * SYMMETRY_BREAKING;
    vec2 direction = mat2(cos(angle), sin(angle), -sin(angle), cos(angle)) * ahead.direction;
    float speed = person.preferred_speed;
    bool last = states[row].stage + 1u >= person.stage_count;
    if (last && (person.flags & PERSON_STAYS) != 0u)
        speed = min(speed, min(sqrt(2.0 * STOPPING * ahead.remaining), ahead.remaining / SETTLING_TIME));
    preferred_velocities[slot] = direction * speed;
}
