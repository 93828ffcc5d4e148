// SPDX-License-Identifier: Apache-2.0
// The velocity that each person would like, were it alone.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) readonly buffer States { AgentState states[]; };
layout(std430) readonly buffer Bodies { Body bodies[]; };
layout(std430) buffer Walkers { Walker walkers[]; };
layout(std430) readonly buffer Stages { Stage stages[]; };
uniform usamplerBuffer field_cells;  // FieldCell
layout(std430) readonly buffer DetourSlopes { vec2 detour_slopes[]; };
layout(std430) readonly buffer WaitingLines { WaitingLine waiting_lines[]; };
layout(std430) readonly buffer LinePoints { vec2 line_points[]; };
layout(std430) readonly buffer NeighbourCounts { uint neighbour_counts[]; };
layout(std430) readonly buffer TouchWords { uint touch_words[]; };
layout(std430) writeonly buffer PreferredVelocities { vec2 preferred_velocities[]; };

uniform uint steps_done;  // counted with this one

#include "shaders/shared/random.glsl"
#include "shaders/shared/images.glsl"
#include "shaders/routes/route.glsl"
#include "shaders/motion/waiting_line.glsl"
#include "shaders/motion/symmetry_breaking.glsl"
#include "shaders/motion/walking_behind.glsl"
#include "shaders/motion/headway.glsl"
#include "shaders/motion/taking_turns.glsl"
#include "shaders/motion/way_through.glsl"
#include "shaders/motion/search_beside_walls.glsl"
#include "shaders/motion/foresight.glsl"
#ifdef PARTIES
#include "shaders/motion/waiting_for_company.glsl"
#endif
#include "shaders/motion/coming_to_rest.glsl"
#ifdef BELTS
#include "shaders/shared/charts.glsl"
#include "shaders/shared/snap.glsl"
#include "shaders/charts/moving_ground.glsl"
#include "shaders/motion/riding.glsl"
#include "shaders/motion/wish_on_belts.glsl"
#endif
#ifdef TRAFFIC
#include "shaders/shared/traffic_types.h"
layout(std430) readonly buffer Crossings { TrafficCrossing crossings[]; };
layout(std430) readonly buffer CrossingPoints { vec2 crossing_points[]; };
layout(std430) readonly buffer Lights { uint lights[]; };
#include "shaders/traffic/crossings.glsl"
#include "shaders/traffic/held_at_red.glsl"
#endif
#ifdef TERRAIN
#include "shaders/shared/terrain.glsl"
#include "shaders/motion/climbing.glsl"
#include "shaders/motion/slope_pace.glsl"
#endif

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= live_count || isImage(walkers[slot].flags)) return;
    uint row = bodies[slot].row;
    vec2 position = bodies[slot].position;
    Walker walker = walkers[slot];
    Stage stage = stageOf(walker.stage, ticketOf(walker), position);
    bool narrow = (touch_words[slot] & TOUCH_IN_NARROWS) != 0u;
    bool on_stairs = false;
#ifdef TERRAIN
    vec2 ground = smoothGround(position);
    on_stairs = mostlyStairs(stairsOf(ground));
#endif
    RouteAhead ahead = wayAhead(stage, position, bodies[slot].velocity, neighbour_counts[slot], walker.nervousness,
                                heedsJams(walker, narrow, on_stairs));

    walkers[slot].way_through = packSnorm2x16(narrow ? wayThrough(stage, position, ahead) : ahead.direction);

#ifdef PARTIES
    bool in_party = WAITING_FOR_COMPANY_ENABLED && walker.party_size > 1u;
    if (in_party) ahead.direction = wayWithParty(row, walker, stage, position, ahead);
#endif
    float angle = ownAngle(row) + searchAngle(row, walker, touch_words[slot], steps_done);
    vec2 direction = mat2(cos(angle), sin(angle), -sin(angle), cos(angle)) * ahead.direction;

#ifdef BELTS
    Ride ride = rideAt(position, direction);
    walkers[slot].flags |= flagsOf(ride);
    bool rides = RIDING_ENABLED && ride.chart != NO_CHART;
    bool walks = rides && walksOnBelt(ride, partyFirstOf(walker, row));
    if (rides) direction = wayOnBelt(ride, walks, direction);
#endif

    float speed = walker.preferred_speed;
#ifdef TERRAIN
    Incline incline = inclineAt(position, direction, ground);
    walkers[slot].flags |= climbingFlags(incline);
    speed *= paceOn(incline);
#endif
#ifdef PARTIES
    if (in_party) {
        float pace = paceInParty(row, walker, stage, ahead.remaining);
        if (COMPANY_ENABLED && pace < COMPANY_LETTING_GO) walkers[slot].flags |= WALKER_WAITS;
        speed *= pace;
    }
#endif
    bool stopped = walker.status == STATUS_ARRIVED || walker.leave_step != 0u;
    speed = speedBeforeRest(speed, stage, ahead, stopped);
    if (hasComeToRest(walker, stage, ahead, stopped, bodies[slot].heading)) {
        walkers[slot].flags |= WALKER_AT_REST;
        speed = 0.0;
    }
#ifdef TRAFFIC
    Hold hold = heldAtRed(stage, position, ahead, bodies[slot].radius, row);
    if (hold.is_held) {
        walkers[slot].flags |= WALKER_HELD;
        direction = hold.direction;
        speed = min(speed, hold.speed);
        if (speed == 0.0) walkers[slot].flags |= WALKER_AT_REST;
    }
#endif
    vec2 wish = direction * speed;
#ifdef BELTS
    if (rides && ride.on) {
        wish = wishOnBelt(ride, walks, speed);
        if (wish == vec2(0.0)) walkers[slot].flags |= WALKER_AT_REST;
    }
#endif
    preferred_velocities[slot] = wish;
}
