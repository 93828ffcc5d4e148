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
layout(std430) readonly buffer TouchWords { uint touch_words[]; };
layout(std430) writeonly buffer PreferredVelocities { vec2 preferred_velocities[]; };

uniform uint steps_done;  // counted with this one

#include "shaders/random.glsl"
#include "shaders/route.glsl"

/// Two people who walk straight at each other, and rings of people who all aim at the centre, are in an unstable
/// balance that half-planes never leave. Everybody therefore aims a little beside the mark, by up to this angle (rad).
const float SYMMETRY_BREAKING = 0.02;
const uint PURPOSE_SYMMETRY = 0x51u;

/// Who does not get on at all beside a wall looks for another way: by up to this angle (rad) aside, another one every so
/// often. It is what breaks the arches that form before narrow doors (the fluctuations of Helbing, Farkas and Vicsek 2000).
const float MOST_SEARCH = 2.0;
const float SEARCH_TIME = 1.0;  // s
const uint PURPOSE_SEARCH = 0x5eu;

float searchAngle(uint row, float nervousness) {
    float despair = smoothstep(0.7, 0.95, nervousness);
    if (despair <= 0.0) return 0.0;
    uint turn = uint(float(steps_done) * parameters.step_seconds / SEARCH_TIME + randomUnit(parameters.seed, row, PURPOSE_SEARCH));
    return despair * MOST_SEARCH * (randomUnit(parameters.seed ^ PURPOSE_SEARCH, row, turn) * 2.0 - 1.0);
}

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

    float angle = (randomUnit(parameters.seed, row, PURPOSE_SYMMETRY) * 2.0 - 1.0) * SYMMETRY_BREAKING +
                  ((touch_words[slot] & TOUCH_WALL_NEAR) != 0u ? searchAngle(row, states[row].nervousness) : 0.0);
    vec2 direction = mat2(cos(angle), sin(angle), -sin(angle), cos(angle)) * ahead.direction;
    float speed = person.preferred_speed;
    bool last = states[row].stage + 1u >= person.stage_count;
    if (last && (person.flags & PERSON_STAYS) != 0u)
        speed = min(speed, min(sqrt(2.0 * STOPPING * ahead.remaining), ahead.remaining / SETTLING_TIME));
    preferred_velocities[slot] = direction * speed;
}
