// SPDX-License-Identifier: Apache-2.0
// The velocity that each person would like, were it alone.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) readonly buffer States { AgentState states[]; };
layout(std430) readonly buffer Bodies { Body bodies[]; };
layout(std430) readonly buffer Walkers { Walker walkers[]; };
layout(std430) readonly buffer Stages { Stage stages[]; };
uniform usamplerBuffer field_cells;  // FieldCell
layout(std430) readonly buffer DetourSlopes { vec2 detour_slopes[]; };
layout(std430) readonly buffer WaitingLines { WaitingLine waiting_lines[]; };
layout(std430) readonly buffer LinePoints { vec2 line_points[]; };
layout(std430) readonly buffer TouchWords { uint touch_words[]; };
layout(std430) writeonly buffer PreferredVelocities { vec2 preferred_velocities[]; };

uniform uint steps_done;  // counted with this one

#include "shaders/shared/random.glsl"
#include "shaders/routes/route.glsl"
#include "shaders/motion/waiting_line.glsl"
#ifdef TERRAIN
#include "shaders/shared/terrain.glsl"
#include "shaders/motion/slope_pace.glsl"
#endif

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

/// Nobody leaves their company behind: who is ahead of somebody by this much (m) slows down, and who is behind hurries.
const float LEAD_BEGINS = 1.0;
const float LEAD_ENDS = 4.0;
const float WAITING_PACE = 0.15;   // of the usual speed: nobody who waits in a stream of people stands quite still
const float HURRYING_PACE = 1.2;

/// Who has lost its company walks towards it as much as to its goal; not for long where something is in between.
const float LOST = 2.0;       // m to the nearest of the party
const float QUITE_LOST = 5.0;

vec2 towardsParty(uint row, Walker walker, vec2 position, vec2 direction) {
    vec2 nearest = vec2(1.0e6);
    for (uint other = walker.party_first; other < walker.party_first + walker.party_size; ++other) {
        if (other == row || states[other].status != STATUS_WALKING || states[other].leave_step != 0u) continue;
        vec2 offset = states[other].position - position;
        if (dot(offset, offset) < dot(nearest, nearest)) nearest = offset;
    }
    float distance = length(nearest);
    if (distance <= LOST || distance > 1.0e5) return direction;
    float pull = smoothstep(LOST, QUITE_LOST, distance) * (1.0 - smoothstep(0.3, 0.6, walker.nervousness));
    vec2 result = direction + pull * nearest / distance;
    float size = length(result);
    return size > 0.3 ? result / size : direction;
}

/// Where two ways are as good, a party takes the one of its first: whoever is near it and would turn off does not.
vec2 wayOfParty(uint row, Walker walker, Stage stage, vec2 position, vec2 direction) {
    for (uint first = walker.party_first; first < row; ++first) {
        if (states[first].status != STATUS_WALKING || states[first].leave_step != 0u) continue;
        if (distance(states[first].position, position) > 2.0 * QUITE_LOST) return direction;
        vec2 its_direction = routeAhead(stage, states[first].position).direction;
        return dot(its_direction, direction) < 0.3 ? its_direction : direction;
    }
    return direction;
}

float paceInParty(uint row, Walker walker, Stage stage, float remaining) {
    uint stages_left = walker.stage_end - walker.stage;
    float lead = -LEAD_ENDS;  // over whoever is furthest behind
    float lag = -LEAD_ENDS;   // behind whoever is furthest ahead
    for (uint other = walker.party_first; other < walker.party_first + walker.party_size; ++other) {
        if (other == row || states[other].status != STATUS_WALKING) continue;
        uint its_stages_left = states[other].stage_end - states[other].stage;
        float its_remaining = routeAhead(stage, states[other].position).remaining;
        float difference = its_stages_left == stages_left ? its_remaining - remaining
                         : its_stages_left > stages_left ? LEAD_ENDS : -LEAD_ENDS;
        lead = max(lead, difference);
        lag = max(lag, -difference);
    }
    float waiting = mix(1.0, WAITING_PACE, smoothstep(LEAD_BEGINS, LEAD_ENDS, lead));
    return waiting < 1.0 ? waiting : mix(1.0, HURRYING_PACE, smoothstep(LEAD_BEGINS, LEAD_ENDS, lag));
}

/// Those who stop come to rest at their place: they slow down by this much (m/s^2), and close in on the last decimetres
/// with this time constant (s), instead of overshooting.
const float STOPPING = 0.7;
const float SETTLING_TIME = 0.8;
/// Who has stopped further away than this (m), because its place was full, stays where it is.
const float CONTENT = 1.0;

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= live_count) return;
    uint row = bodies[slot].row;
    Walker walker = walkers[slot];
    Stage stage = stageOf(walker.stage, walker.ticket);
    RouteAhead ahead = routeAhead(stage, bodies[slot].position);

    if (walker.party_size > 1u) {
        ahead.direction = wayOfParty(row, walker, stage, bodies[slot].position, ahead.direction);
        // Near one's own place, one goes there, wherever the others' are.
        bool arrives = stage.dwell > 0.0 && ahead.remaining < QUITE_LOST;
        if (!arrives) ahead.direction = towardsParty(row, walker, bodies[slot].position, ahead.direction);
    }
    float angle = (randomUnit(parameters.seed, row, PURPOSE_SYMMETRY) * 2.0 - 1.0) * SYMMETRY_BREAKING +
                  ((touch_words[slot] & TOUCH_WALL_NEAR) != 0u ? searchAngle(row, walker.nervousness) : 0.0);
    vec2 direction = mat2(cos(angle), sin(angle), -sin(angle), cos(angle)) * ahead.direction;
    float speed = walker.preferred_speed;
#ifdef TERRAIN
    speed *= slopePace(bodies[slot].position, direction);
#endif
    if (walker.party_size > 1u) speed *= paceInParty(row, walker, stage, ahead.remaining);
    bool stopped = walker.status == STATUS_ARRIVED || walker.leave_step != 0u;
    if (stopped && (stage.flags & STAGE_ANYWHERE) != 0u && ahead.remaining > CONTENT)
        speed = 0.0;
    else if (stage.dwell > 0.0)
        speed = min(speed, min(sqrt(2.0 * STOPPING * ahead.remaining), ahead.remaining / SETTLING_TIME));
    preferred_velocities[slot] = direction * speed;
}
