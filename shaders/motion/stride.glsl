// SPDX-License-Identifier: Apache-2.0
// Stride: where a velocity takes somebody in a step, unless bodies touch.
// Needs shaders/shared/snap.glsl, the blocks ParametersBlock, Targets, TargetsAfter and Ways, and
// shaders/motion/wide_site.glsl; where ground moves, the block Walkers and shaders/charts/belts.glsl; for bodies that
// are no discs also the blocks Bodies and Walkers, and shaders/shared/body_shape.glsl and shoulders.glsl.

/// @param rest m that rounding has dropped from the position; wide sites only
/// @param twist rad: how far the shoulders are to be turned
void stride(uint slot, vec2 position, vec2 velocity, vec2 rest, float twist) {
    vec2 way = snapped(velocity * parameters.step_seconds);
#ifdef BELTS
    way += carriedInStep(walkers[slot].flags);
#endif
    vec2 target = position + way;
#ifdef WIDE_SITE
    way += rest;
    ways[slot] = way;
    target = placeAfter(position, way);
#endif
#ifdef BODIES
    // Chests turn on meanwhile.
    Walker walker = walkers[slot];
    float wanted = chestWanted(bodies[slot].heading, walker.chest, twist, bodies[slot].row);
    float turn = chestRate(walker.chest, walker.chest_rate, wanted) * parameters.step_seconds;
    vec4 shape = vec4(target, axisAt(walker.chest + turn, walker.half_axis));
#else
    vec2 shape = target;
#endif
    targets[slot] = shape;
    targets_after[slot] = shape;
}
