// SPDX-License-Identifier: Apache-2.0
// One round of keeping bodies out of each other and out of walls, by moving positions (position-based dynamics, Mueller
// et al. 2007): avoidance foresees, but in a crush there may be nothing to foresee that works.
//
// All people move at once from the same positions (a Jacobi round), so the result does not depend on the order. Walls
// come last and do not give: whatever neighbours push, a body ends up on the side of the wall on which it began the
// step.
//
// In a crush a push has to travel through many bodies, and a round carries it one body further. Each round therefore
// goes on in the direction of the last two by Chebyshev's weights (Wang 2015, A Chebyshev semi-iterative approach for
// accelerating projective and position-based dynamics); docs/motion.md says what that gains.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer TouchDispatch { uint touch_groups[3]; uint touch_count; };
layout(std430) readonly buffer TouchSlots { uint touch_slots[]; };
layout(std430) readonly buffer Bodies { Body bodies[]; };
#ifdef BODIES
layout(std430) readonly buffer Walkers { Walker walkers[]; };
#ifdef FIRST_ROUND
layout(std430) writeonly buffer NearLists { uint near_lists[]; };  // NEAR_WORDS each
#else
layout(std430) readonly buffer NearLists { uint near_lists[]; };
#endif
#endif
layout(std430) readonly buffer PreferredVelocities { vec2 preferred_velocities[]; };
layout(std430) readonly buffer TouchWords { uint touch_words[]; };
layout(std430) readonly buffer Weights { vec2 weights[]; };  // weight, and urgency (urgency.glsl)
layout(std430) readonly buffer TouchLists { uint touch_lists[]; };
layout(std430) readonly buffer WallSegments { WallSegment wall_segments[]; };
layout(std430) readonly buffer WallStarts { uint wall_starts[]; };
layout(std430) readonly buffer WallItems { uint wall_items[]; };
layout(std430) readonly buffer TargetsBefore { TARGET targets_before[]; };
layout(std430) buffer TargetsAfter { TARGET targets_after[]; };  // those before the last round's; then new ones
uniform float momentum;  // 1 = none

#include "shaders/shared/at_most.glsl"
#include "shaders/shared/snap.glsl"
#include "shaders/cells/cells.glsl"
#include "shaders/cells/walls_near.glsl"
#include "shaders/cells/cell_runs.glsl"
#include "shaders/shared/touch_list.glsl"
#include "shaders/shared/walls.glsl"
#include "shaders/motion/walking_behind.glsl"
#include "shaders/motion/urgency.glsl"
#include "shaders/motion/nearest_first.glsl"
#include "shaders/motion/apart_direction.glsl"
#ifdef BODIES
#include "shaders/shared/body_shape.glsl"
#include "shaders/motion/shoulders.glsl"
#include "shaders/motion/capsules_apart.glsl"
#include "shaders/motion/capsules_out_of_walls.glsl"
#else
#include "shaders/motion/bodies_apart.glsl"
#include "shaders/motion/out_of_walls.glsl"
#endif

/// On in the direction of the last two rounds.
TARGET goneOn(TARGET before, TARGET now) {
#ifdef CHARTS
    TARGET way = momentum * (now - before);
    way.xy = snapped(way.xy);
    return before + way;
#else
    return mix(before, now, momentum);
#endif
}

#ifndef BODIES
vec2 outOfWalls(Body self, vec2 position) {
#ifdef CHARTS
    return self.position + snapped(keepOutOfWalls(self, position) - self.position);
#else
    return keepOutOfWalls(self, position);
#endif
}
#endif

void main() {
    // Only those who may touch something are listed; for all others the two target buffers already agree.
    if (gl_GlobalInvocationID.x >= touch_count) return;
    uint slot = touch_slots[gl_GlobalInvocationID.x];
#if defined(BODIES) && !defined(FIRST_ROUND)
    uint touch_word = near_lists[slot * NEAR_WORDS];
#else
    uint touch_word = touch_words[slot];
#endif
    Body self = bodies[slot];
#ifdef BODIES
    vec2 start = vec2(walkers[slot].axis_x, walkers[slot].axis_y);
    vec4 target = targets_before[slot];
    Push push = pushFromNeighbours(self, slot, touchesListed(touch_word), target);
    target.xy += snapped(atMost(push.way, CONTACT_MOST_PUSH * self.radius));
    target.zw = turnedBy(target.zw, push.turn);
    target = goneOn(targets_after[slot], target);
    target.zw = withinATurn(target.zw, start);
#ifdef FIRST_ROUND
    bool walls = (touch_word & TOUCH_WALL_NEAR) != 0u;
    if (walls) target = keepOutOfWalls(self, slot, 0u, start, target);
    uint noted = walls ? min(noteWalls(self, slot), NEAR_WALLS + 1u) << NEAR_WALLS_AT | TOUCH_WALL_NEAR : 0u;
    near_lists[slot * NEAR_WORDS] = near | noted;
#else
    // Who is pushed far in a step may meet walls that are not on its list.
    uint noted = (touch_word & ~TOUCH_WALL_NEAR) >> NEAR_WALLS_AT;
    bool all_noted = noted <= NEAR_WALLS && distance(target.xy, self.position) < NEAR_ENOUGH;
    if ((touch_word & TOUCH_WALL_NEAR) != 0u && (noted > 0u || !all_noted))
        target = keepOutOfWalls(self, slot, all_noted ? noted : 0u, start, target);
#endif
    targets_after[slot] = target;
#else
    vec2 position = targets_before[slot];
    vec2 push = pushFromNeighbours(self, slot, touchesListed(touch_word), position);
    position += snapped(atMost(push, CONTACT_MOST_PUSH * self.radius));
    position = goneOn(targets_after[slot], position);
    targets_after[slot] = (touch_word & TOUCH_WALL_NEAR) != 0u ? outOfWalls(self, position) : position;
#endif
}
