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
layout(std430) readonly buffer RowSlots { uint row_slots[]; };
layout(std430) readonly buffer Neighbours { uint neighbours[]; };
layout(std430) readonly buffer NeighbourCounts { uint neighbour_counts[]; };
layout(std430) writeonly buffer PreferredVelocities { vec2 preferred_velocities[]; };
uniform uint slot_capacity;

#include "shaders/random.glsl"
#include "shaders/route.glsl"

/// The last step's headings: those of this step's wishes are only being made.
vec2 facing(uint slot) { return vec2(cos(bodies[slot].heading), sin(bodies[slot].heading)); }
#include "shaders/oncoming.glsl"

/// Two people who walk straight at each other, and rings of people who all aim at the centre, are in an unstable
/// balance that half-planes never leave. Everybody therefore aims a little beside the mark, by up to this angle (rad).
const float SYMMETRY_BREAKING = 0.02;
const uint PURPOSE_SYMMETRY = 0x51u;

/// Pedestrians who meet others tend to one side, mostly the right (Moussaid et al. 2009). Somebody whom oncoming people
/// have brought to a standstill aims this far to the right of its way (rad), somebody who gets on not at all: knots of
/// people turn and dissolve, and streams sort themselves. For those who are held up by anybody else a little of it is
/// left: more, and people whose ways merely cross would be swept along with each other.
const float SIDE_PREFERENCE = 1.0;
const float SIDE_TENDENCY = 0.25;
const float SIDE_PREFERENCE_FADES = 2.0;  // m before the target: it does not lead round in circles there

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= live_count) return;
    uint row = bodies[slot].row;
    Person person = people[row];
    uint stage = person.first_stage + min(states[row].stage, person.stage_count - 1u);
    RouteAhead ahead = routeAhead(stages[stage], bodies[slot].position);

    float angle = (randomUnit(parameters.seed, row, PURPOSE_SYMMETRY) * 2.0 - 1.0) * SYMMETRY_BREAKING;
    float progress = clamp(dot(bodies[slot].velocity, ahead.direction) / person.preferred_speed, 0.0, 1.0);
    float oncoming = progress < GETTING_ON ? oncomingTraffic(slot, ahead.direction) : 0.0;
    angle -= max(SIDE_PREFERENCE * oncoming, SIDE_TENDENCY) * (1.0 - progress) * min(1.0, ahead.remaining / SIDE_PREFERENCE_FADES);
    vec2 direction = mat2(cos(angle), sin(angle), -sin(angle), cos(angle)) * ahead.direction;
    float speed = person.preferred_speed;
    // Those who stay come to rest at their goal instead of overshooting it.
    bool last = states[row].stage + 1u >= person.stage_count;
    if (last && (person.flags & PERSON_STAYS) != 0u) speed = min(speed, ahead.remaining / 0.5);
    preferred_velocities[slot] = direction * speed;
}
