// SPDX-License-Identifier: Apache-2.0
// Images take over what their people have: after each pass that changes something of people which others look at.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) readonly buffer RowSlots { uint row_slots[]; };

#include "shaders/charts/slot_images.glsl"
#include "shaders/shared/images.glsl"
#ifdef BELTS
layout(std140) uniform ParametersBlock { Parameters parameters; };
#include "shaders/shared/charts.glsl"
#include "shaders/shared/snap.glsl"
#include "shaders/charts/moving_ground.glsl"
#endif

#if defined(FOLLOW_BODIES) || (defined(FOLLOW_WISHES) && defined(BELTS))
layout(std430) buffer Bodies { Body bodies[]; };
#endif
#ifdef FOLLOW_WALKERS
layout(std430) buffer Walkers { Walker walkers[]; };
#endif
#ifdef FOLLOW_WISHES
layout(std430) buffer PreferredVelocities { vec2 preferred_velocities[]; };
#endif
#ifdef FOLLOW_TOUCH
layout(std430) buffer TouchWords { uint touch_words[]; };
#endif
#ifdef FOLLOW_TARGETS
layout(std430) buffer Targets { TARGET targets[]; };
layout(std430) buffer TargetsAfter { TARGET targets_after[]; };
#endif
#ifdef FOLLOW_ROUND
layout(std430) buffer TargetsAfter { TARGET targets_after[]; };
#endif

TARGET shifted(TARGET target, vec2 shift) {
    target.xy += shift;
    return target;
}

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= live_count || !holdsImage(slot)) return;
    SlotImage image = slot_images[slot];
    uint person = row_slots[image.person];
#ifdef FOLLOW_BODIES
    Body body = bodies[person];
    body.position += image.shift;
#ifdef BELTS
    body.velocity += velocitySeenFrom(body.position, bodies[person].position);
#endif
    bodies[slot] = body;
#endif
#ifdef FOLLOW_WALKERS
    walkers[slot] = walkers[person];
    walkers[slot].flags |= WALKER_IS_IMAGE;
#endif
#ifdef FOLLOW_WISHES
    preferred_velocities[slot] = preferred_velocities[person];
#ifdef BELTS
    preferred_velocities[slot] += velocitySeenFrom(bodies[slot].position, bodies[person].position);
#endif
#endif
#ifdef FOLLOW_TOUCH
    touch_words[slot] = touch_words[person];
#endif
#ifdef FOLLOW_TARGETS
    targets[slot] = shifted(targets[person], image.shift);
#endif
#if defined(FOLLOW_TARGETS) || defined(FOLLOW_ROUND)
    targets_after[slot] = shifted(targets_after[person], image.shift);
#endif
}
