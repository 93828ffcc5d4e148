// SPDX-License-Identifier: Apache-2.0
// Bodies apart, for bodies that are no discs: two capsules touch where their segments are nearest to each other, and a
// push there moves them and turns them, each by what its mass and its moment of inertia make of it (position-based
// dynamics of rigid bodies: Mueller, Macklin, Chentanez, Jeschke and Kim 2020).
//
// Touch lists hold all whom a disc round the body may meet until the next decision, as fast as both may be: in a crush
// twelve to eighteen, of whom few are near enough for the pushes of one step. The first round, which looks at all
// of them anyway, notes those (and whether a wall is near) for the rounds that follow.
//
// Loops are such that they run once for each who is near, and never once more: where invocations run in step, whoever
// is done waits for the others, and a loop that asks before each turn takes one turn for nothing.
// Needs the blocks ParametersBlock, Bodies, Weights, TouchLists, NearLists and TargetsBefore, shaders/cells/cells.glsl
// and cell_runs.glsl, shaders/shared/touch_list.glsl, body_shape.glsl, shoulders.glsl, nearest_first.glsl and
// apart_direction.glsl.

/// m: whoever is further apart than this after the first round does not touch in the others.
const float NEAR_ENOUGH = 3.0e-1;
const float FAR_APART = 1.0e5;

/// What others make of somebody in a round: it is moved, turned, by how many.
struct Push {
    vec2 way;
    float turn;
    float count;
};

/// How much of a push at this arm turns a body, per metre that the same push moves it.
float turnPerMetre(float arm, float radius, float thickness) { return arm / inertiaOf(radius, thickness); }

/// How hard the other is to move, and oneself; only the first rounds know weights.
vec2 weightsBetween(vec2 mine, uint self_slot, uint slot, vec2 offset) {
#ifdef BRACED
    vec2 its = weights[slot];
    return vec2(its.x / precedence(self_slot, mine.y, slot, its.y, offset), mine.x);
#else
    return vec2(1.0);
#endif
}

/// @returns m: how deep the other is in oneself, below 0 where they are apart
float addPush(Body self, uint self_slot, vec2 mine, uint slot, vec4 target, inout Push push) {
    vec4 other = targets_before[slot];
    float its_radius = bodies[slot].radius;
    vec2 offset = target.xy - other.xy;
    float thickness = thicknessOf(self.radius, target.zw), its_thickness = thicknessOf(its_radius, other.zw);
    vec2 along = nearestAlong(offset, target.zw, other.zw);
    vec2 gap = offset + along.x * target.zw - along.y * other.zw;
    float size = length(gap);
    float depth = slot == self_slot ? -FAR_APART : thickness + its_thickness + CONTACT_SKIN - size;
    if (depth <= 0.0) return depth;
    vec2 apart = gap / max(size, 1.0e-6);
    if (size <= 1.0e-5) {  // the segments cross: the bodies part as their middles are apart
        size = length(offset);
        apart = apartDirection(offset, size, self.row, bodies[slot].row);
        depth += abs(dot(target.zw, apart)) + abs(dot(other.zw, apart)) - size;
        along = vec2(0.0);
    }
    vec2 weight = weightsBetween(mine, self_slot, slot, offset);
    float arm = crossOf(along.x * target.zw, apart), its_arm = crossOf(along.y * other.zw, apart);
    float turn = turnPerMetre(arm, self.radius, thickness);
    float its_turn = turnPerMetre(its_arm, its_radius, its_thickness);
    float share = weight.x / (weight.x * (1.0 + arm * turn) + weight.y * (1.0 + its_arm * its_turn));
    push.way += apart * (depth * share);
    push.turn += turn * depth * share;
    push.count += 1.0;
    return depth;
}

#ifdef FIRST_ROUND

const uint LISTED = TOUCH_CAPACITY;
uint listed(uint self_slot, uint nth) { return touchSlot(self_slot, nth); }

uint near = 0u;  // how many are; the list holds the first NEAR_CAPACITY

void note(uint self_slot, uint slot, float depth) {
    if (depth <= -NEAR_ENOUGH) return;
    if (near < NEAR_CAPACITY) near_lists[self_slot * NEAR_WORDS + 1u + near] = slot;
    ++near;
}

#else

const uint LISTED = NEAR_CAPACITY;
uint listed(uint self_slot, uint nth) { return near_lists[self_slot * NEAR_WORDS + 1u + nth]; }
void note(uint self_slot, uint slot, float depth) {}

#endif

/// @param count how many are in the list; where it does not hold them all, the cells do
Push pushFromNeighbours(Body self, uint self_slot, uint count, vec4 target) {
    Push push = Push(vec2(0.0), 0.0, 0.0);
#ifdef BRACED
    vec2 mine = weights[self_slot];
#else
    vec2 mine = vec2(1.0, 0.0);
#endif
    ivec2 cell = cellOf(self.position);
    int y = count <= LISTED ? cell.y + 1 : cell.y - 1;
    do {
        uvec2 run = count <= LISTED ? uvec2(0u, count) : slotRun(cell.x, y);
        if (run.x < run.y) do {
            uint slot = count <= LISTED ? listed(self_slot, run.x) : run.x;
            note(self_slot, slot, addPush(self, self_slot, mine, slot, target, push));
        } while (++run.x < run.y);
    } while (++y <= cell.y + 1);
    // Plain sums overshoot where many push: a mildly over-relaxed average converges and does not ring.
    float share = push.count > 1.0 ? CONTACT_RELAXATION / push.count : 1.0;
    return Push(push.way * share, push.turn * share, push.count);
}
