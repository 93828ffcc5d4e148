// SPDX-License-Identifier: Apache-2.0
// Bodies apart, for bodies that are no discs: two capsules touch where their segments are nearest to each other, and a
// push there moves them and turns them, each by what its mass and its moment of inertia make of it (position-based
// dynamics of rigid bodies: Mueller, Macklin, Chentanez, Jeschke and Kim 2020).
// Needs the blocks ParametersBlock, Bodies, Weights, TouchLists and TargetsBefore, shaders/cells/cells.glsl and
// cell_runs.glsl, shaders/shared/body_shape.glsl, shoulders.glsl, nearest_first.glsl and
// apart_direction.glsl.

/// What others make of somebody in a round: it is moved, turned, by how many.
struct Push {
    vec2 way;
    float turn;
    float count;
};

/// How much of a push at this arm turns a body, per metre that the same push moves it.
float turnPerMetre(float arm, float radius, float thickness) { return arm / inertiaOf(radius, thickness); }

void addPush(Body self, uint self_slot, vec2 mine, uint slot, vec4 target, inout Push push) {
    vec4 other = targets_before[slot];
    float its_radius = bodies[slot].radius;
    vec2 offset = target.xy - other.xy;
    float bound = self.radius + its_radius + CONTACT_SKIN;
    if (slot == self_slot || dot(offset, offset) >= bound * bound) return;
    float thickness = thicknessOf(self.radius, target.zw), its_thickness = thicknessOf(its_radius, other.zw);
    vec2 along = nearestAlong(offset, target.zw, other.zw);
    vec2 gap = offset + along.x * target.zw - along.y * other.zw;
    float size = length(gap);
    float depth = thickness + its_thickness + CONTACT_SKIN - size;
    if (depth <= 0.0) return;
    vec2 apart = gap / max(size, 1.0e-6);
    if (size <= 1.0e-5) {  // the segments cross: the bodies part as their middles are apart
        size = length(offset);
        apart = apartDirection(offset, size, self.row, bodies[slot].row);
        depth += abs(dot(target.zw, apart)) + abs(dot(other.zw, apart)) - size;
        along = vec2(0.0);
    }
    float its_weight = 1.0;
    if (bracing > 0.0) {
        vec2 its = weights[slot];
        its_weight = its.x / precedence(self_slot, mine.y, slot, its.y, offset);
    }
    float arm = crossOf(along.x * target.zw, apart), its_arm = crossOf(along.y * other.zw, apart);
    float turn = turnPerMetre(arm, self.radius, thickness);
    float its_turn = turnPerMetre(its_arm, its_radius, its_thickness);
    float share = its_weight / (its_weight * (1.0 + arm * turn) + mine.x * (1.0 + its_arm * its_turn));
    push.way += apart * (depth * share);
    push.turn += turn * depth * share;
    push.count += 1.0;
}

Push pushFromNeighbours(Body self, uint self_slot, uint touching, vec4 target) {
    Push push = Push(vec2(0.0), 0.0, 0.0);
    vec2 mine = bracing > 0.0 ? weights[self_slot] : vec2(1.0, 0.0);
    if (touching <= TOUCH_CAPACITY) {
        for (uint i = 0u; i < touching; ++i)
            addPush(self, self_slot, mine, touch_lists[self_slot * TOUCH_CAPACITY + i], target, push);
    } else {
        ivec2 cell = cellOf(self.position);
        for (int y = cell.y - 1; y <= cell.y + 1; ++y) {
            uvec2 run = slotRun(cell.x, y);
            for (uint slot = run.x; slot < run.y; ++slot) addPush(self, self_slot, mine, slot, target, push);
        }
    }
    // Plain sums overshoot where many push: a mildly over-relaxed average converges and does not ring.
    float share = push.count > 1.0 ? CONTACT_RELAXATION / push.count : 1.0;
    return Push(push.way * share, push.turn * share, push.count);
}
