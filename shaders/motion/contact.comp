// SPDX-License-Identifier: Apache-2.0
// One round of keeping bodies out of each other and out of walls, by moving positions (position-based dynamics, Mueller
// et al. 2007): avoidance foresees, but in a crush there may be nothing to foresee that works.
//
// All people move at once from the same positions (a Jacobi round), so the result does not depend on the order. Walls come
// last and do not give: whatever neighbours push, a body ends up on the side of the wall on which it began the step.
//
// In a crush a push has to travel through many bodies, and a round carries it one body further. Each round therefore goes on
// in the direction of the last two by Chebyshev's weights (Wang 2015, A Chebyshev semi-iterative approach for accelerating
// projective and position-based dynamics); docs/motion.md says what that gains.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer TouchDispatch { uint touch_groups[3]; uint touch_count; };
layout(std430) readonly buffer TouchSlots { uint touch_slots[]; };
layout(std430) readonly buffer Bodies { Body bodies[]; };
layout(std430) readonly buffer PreferredVelocities { vec2 preferred_velocities[]; };
layout(std430) readonly buffer TouchWords { uint touch_words[]; };
layout(std430) readonly buffer TouchLists { uint touch_lists[]; };
layout(std430) readonly buffer WallSegments { WallSegment wall_segments[]; };
layout(std430) readonly buffer WallStarts { uint wall_starts[]; };
layout(std430) readonly buffer WallItems { uint wall_items[]; };
layout(std430) readonly buffer TargetsBefore { vec2 targets_before[]; };
layout(std430) buffer TargetsAfter { vec2 targets_after[]; };  // those of the round before the last; then the new ones
uniform float momentum;  // 1 = none
uniform float bracing;   // 1 = who is carried off its way gives less than others, 0 = all give alike

#include "shaders/shared/at_most.glsl"
#include "shaders/cells/cells.glsl"
#include "shaders/cells/cell_runs.glsl"
#include "shaders/shared/walls.glsl"

/// Bodies are pushed this much further apart than touching (m), so that rounding and late rounds leave no overlap.
const float SKIN = 0.002;
/// The furthest that contact moves anybody in one step, as a share of its radius: a crush may not fling people.
const float MOST_PUSH = 0.5;

vec2 apartDirection(vec2 offset, float size, uint row, uint other_row) {
    if (size > 1.0e-6) return offset / size;
    // Two bodies in exactly the same place part along a direction that both agree on.
    float angle = float((row ^ other_row) % 64u) * 0.098174770;
    return (row < other_row ? 1.0 : -1.0) * vec2(cos(angle), sin(angle));
}

/// m/s across one's way or back along it: from the first on somebody is being carried off, at the second it stands as fast
/// as it can.
const float CARRIED = 0.3;
const float SWEPT_AWAY = 1.0;
/// How much heavier than others it is to push then.
const float STANDING_FAST = 1.0;

/// How hard somebody is to move out of the way. A platoon would carry whoever it has caught along for its whole length; who
/// stands fast is passed on both sides instead, as a post would be.
float weightOf(uint slot) {
    vec2 wish = preferred_velocities[slot];
    float speed = length(wish);
    if (bracing <= 0.0 || speed <= STANDING_SPEED) return 1.0;
    vec2 way = wish / speed;
    vec2 velocity = bodies[slot].velocity;
    vec2 astray = velocity - way * max(dot(velocity, way), 0.0);
    return 1.0 + bracing * STANDING_FAST * smoothstep(CARRIED, SWEPT_AWAY, length(astray));
}

/// What one neighbour adds to the push: direction and depth, and one more to average over.
void addPush(Body self, uint self_slot, float weight, uint slot, vec2 position, inout vec3 push) {
    vec2 offset = position - targets_before[slot];
    float reach = self.radius + bodies[slot].radius + SKIN;
    float size_squared = dot(offset, offset);
    if (size_squared >= reach * reach || slot == self_slot) return;
    float size = sqrt(size_squared);
    float its_weight = weightOf(slot);
    vec2 apart = apartDirection(offset, size, self.row, bodies[slot].row);
    push += vec3(apart * (reach - size) * its_weight / (weight + its_weight), 1.0);
}

vec2 pushFromNeighbours(Body self, uint self_slot, uint touching, vec2 position) {
    vec3 push = vec3(0.0);
    float weight = weightOf(self_slot);
    if (touching <= TOUCH_CAPACITY) {
        for (uint i = 0u; i < touching; ++i)
            addPush(self, self_slot, weight, touch_lists[self_slot * TOUCH_CAPACITY + i], position, push);
    } else {
        ivec2 cell = cellOf(self.position);
        for (int y = cell.y - 1; y <= cell.y + 1; ++y) {
            uvec2 run = slotRun(cell.x, y);
            for (uint slot = run.x; slot < run.y; ++slot) addPush(self, self_slot, weight, slot, position, push);
        }
    }
    // Plain sums overshoot where many push: a mildly over-relaxed average converges and does not ring.
    return push.z > 1.0 ? push.xy * (1.6 / push.z) : push.xy;
}

/// Moves `position` to the side of the wall that `before` is on, clear of it by the body's radius.
vec2 pushFromWall(WallSegment wall, vec2 before, vec2 position, float radius) {
    vec2 axis = wall.b - wall.a;
    float reach = radius + wall.half_thickness;
    float side_before = axis.x * (before.y - wall.a.y) - axis.y * (before.x - wall.a.x);
    float side_after = axis.x * (position.y - wall.a.y) - axis.y * (position.x - wall.a.x);
    if (side_before * side_after < 0.0) {
        // Did the step pass through the wall itself, or only round its end?
        vec2 crossing = mix(before, position, side_before / (side_before - side_after));
        float along = dot(crossing - wall.a, axis) / max(dot(axis, axis), 1.0e-12);
        if (along >= 0.0 && along <= 1.0) position = crossing + (before - crossing) * 1.0e-3;
    }
    vec2 nearest = nearestOnSegment(position, wall.a, wall.b);
    vec2 offset = position - nearest;
    float size = length(offset);
    if (size >= reach) return position;
    vec2 outward = size > 1.0e-5 ? offset / size
                                 : normalize(vec2(-axis.y, axis.x)) * (side_before >= 0.0 ? 1.0 : -1.0);
    return nearest + outward * reach;
}

vec2 keepOutOfWalls(Body self, vec2 position) {
    uint cell = cellIndex(cellOf(self.position));
    uint first = wall_starts[cell];
    uint last = wall_starts[cell + 1u];
    // Leaving one wall may lead into the next: a few rounds settle corners.
    for (int round = 0; round < 3; ++round)
        for (uint i = first; i < last; ++i)
            position = pushFromWall(wall_segments[wall_items[i]], self.position, position, self.radius);
    return position;
}

void main() {
    // Only those who may touch something are listed; for all others the two target buffers already agree.
    if (gl_GlobalInvocationID.x >= touch_count) return;
    uint slot = touch_slots[gl_GlobalInvocationID.x];
    uint touch_word = touch_words[slot];
    uint touching = touch_word & TOUCH_COUNT_MASK;
    Body self = bodies[slot];
    vec2 position = targets_before[slot];
    vec2 push = pushFromNeighbours(self, slot, touching, position);
    position += atMost(push, MOST_PUSH * self.radius);
    position = mix(targets_after[slot], position, momentum);
    targets_after[slot] = (touch_word & TOUCH_WALL_NEAR) != 0u ? keepOutOfWalls(self, position) : position;
}
