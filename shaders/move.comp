// SPDX-License-Identifier: Apache-2.0
// Ends a step: positions become real, the heading follows, the gait advances, routes advance, people arrive.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) readonly buffer People { Person people[]; };
layout(std430) readonly buffer Bodies { Body bodies[]; };
layout(std430) readonly buffer PreferredVelocities { vec2 preferred_velocities[]; };
layout(std430) readonly buffer Paces { float paces[]; };
layout(std430) readonly buffer Targets { vec2 targets[]; };
layout(std430) readonly buffer Stages { Stage stages[]; };
layout(std430) readonly buffer Fields { FieldCell fields[]; };
layout(std430) readonly buffer DetourSlopes { vec2 detour_slopes[]; };
layout(std430) buffer States { AgentState states[]; };
uniform uint steps_done;  // counted with this one

#include "shaders/route.glsl"

const float PI = 3.14159265358979;
const float TURN_TIME = 0.22;          // s: the heading closes in on the velocity's direction with this time constant
const float TURN_LIMIT = 2.6;          // rad/s, about 150 degrees per second

const float PATIENCE_TIME = 2.0;       // s: nervousness follows what happens with this time constant

/// 1 where somebody does not get on at all, 0 where it walks as it wishes or wants to stand
/// (Helbing, Farkas and Vicsek 2000).
/// Walking behind others at their pace is not being held up.
float heldUp(vec2 wish, float pace, vec2 velocity) {
    float speed = length(wish);
    return speed > STANDING_SPEED ? clamp(1.0 - dot(velocity, wish) / (speed * pace), 0.0, 1.0) : 0.0;
}

float wrapAngle(float angle) { return angle - 2.0 * PI * floor((angle + PI) / (2.0 * PI)); }

float turnTowards(float heading, vec2 velocity, float speed) {
    if (speed < STANDING_SPEED) return heading;
    float turn = wrapAngle(atan(velocity.y, velocity.x) - heading);
    float most = TURN_LIMIT * parameters.step_seconds;
    return wrapAngle(heading + clamp(turn * (1.0 - exp(-parameters.step_seconds / TURN_TIME)), -most, most));
}

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= live_count) return;
    Body self = bodies[slot];
    Person person = people[self.row];
    AgentState state = states[self.row];

    vec2 moved = targets[slot] - self.position;
    float distance_moved = length(moved);
    state.position = targets[slot];
    state.velocity = moved / parameters.step_seconds;
    float speed = length(state.velocity);
    // A push may be faster than legs are; the next step does not build on it.
    if (speed > person.maximum_speed) state.velocity *= person.maximum_speed / speed;
    state.nervousness += (heldUp(preferred_velocities[slot], paces[slot], state.velocity) - state.nervousness) *
                         min(parameters.step_seconds / PATIENCE_TIME, 1.0);
    state.heading = turnTowards(self.heading, state.velocity, speed);
    state.phase += distance_moved / person.stride_length;
    state.walked += distance_moved;

    uint stage = min(state.stage, person.stage_count - 1u);
    if (state.status == STATUS_WALKING &&
        routeAhead(stages[person.first_stage + stage], state.position).remaining <= stages[person.first_stage + stage].tolerance) {
        state.stage = stage + 1u;
        if (state.stage == person.stage_count) {
            state.status = STATUS_ARRIVED;
            state.arrival_step = steps_done;
        }
    }
    states[self.row] = state;
}
