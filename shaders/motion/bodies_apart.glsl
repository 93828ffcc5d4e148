// SPDX-License-Identifier: Apache-2.0
// Bodies apart: those that overlap are pushed away from each other, each by its share. Its loops, and those of
// out_of_walls.glsl, are as capsules_apart.glsl says.
// Needs the blocks Bodies, Weights, TouchLists and TargetsBefore, shaders/cells/cells.glsl and cell_runs.glsl,
// shaders/shared/touch_list.glsl, and shaders/motion/nearest_first.glsl and apart_direction.glsl.

/// What one neighbour adds to the push: direction and depth, and one more to average over.
void addPush(Body self, uint self_slot, vec2 mine, uint slot, vec2 position, inout vec3 push) {
    vec2 offset = position - targets_before[slot];
    float reach = self.radius + bodies[slot].radius + CONTACT_SKIN;
    float size_squared = dot(offset, offset);
    if (size_squared >= reach * reach || slot == self_slot) return;
    float size = sqrt(size_squared);
    float its_weight = 1.0;
#ifdef BRACED
    vec2 its = weights[slot];
    its_weight = its.x / precedence(self_slot, mine.y, slot, its.y, offset);
#endif
    vec2 apart = apartDirection(offset, size, self.row, bodies[slot].row);
    push += vec3(apart * (reach - size) * its_weight / (mine.x + its_weight), 1.0);
}

vec2 pushFromNeighbours(Body self, uint self_slot, uint touching, vec2 position) {
    vec3 push = vec3(0.0);
#ifdef BRACED
    vec2 mine = weights[self_slot];
#else
    vec2 mine = vec2(1.0, 0.0);
#endif
    bool listed = touching <= TOUCH_CAPACITY;
    ivec2 cell = cellOf(self.position);
    int y = listed ? cell.y + 1 : cell.y - 1;
    do {
        uvec2 run = listed ? uvec2(0u, touching) : slotRun(cell.x, y);
        if (run.x < run.y) do {
            addPush(self, self_slot, mine, listed ? touchSlot(self_slot, run.x) : run.x, position, push);
        } while (++run.x < run.y);
    } while (++y <= cell.y + 1);
    // Plain sums overshoot where many push: a mildly over-relaxed average converges and does not ring.
    return push.z > 1.0 ? push.xy * (CONTACT_RELAXATION / push.z) : push.xy;
}
