// SPDX-License-Identifier: Apache-2.0
// Nearest first: of two who are held up on the same way at a narrow passage, the one who is ahead gives next to nothing
// in the first rounds of contact, and the other makes way.
//
// Bodies that are round and press evenly form arches before doors: each holds up the next, however long they press. In
// experiments people before a narrow passage go one after another instead, in layers that overlap like the teeth of a
// zip (Hoogendoorn and Daamen 2005, Transportation Science 39): somebody is first, and the others let it pass. Who is
// ahead is decided between two along the sum of their ways, so both decide alike, nobody is ahead of all who are ahead
// of it, and whoever is first of all is held up by nobody.
//
// Only in and before narrow passages, which the scene's geometry tells (authoring/scene/narrow_places.h): where streams
// meet beside long walls, whoever is caught between a heavy neighbour and those who come the other way has nowhere to
// go, and bodies overlap (docs/motion-notebook.md).
// Needs the block PreferredVelocities, and shaders/motion/walking_behind.glsl and urgency.glsl.

/// By what factor somebody is heavier (above 1) or lighter than usual beside another.
/// @param urgency one's own (urgency.glsl); @param its the other's; @param offset from the other to oneself, m
float precedence(uint self_slot, float urgency, uint slot, float its_urgency, vec2 offset) {
    if (!NEAREST_FIRST_ENABLED || !(takesTurns(urgency) || takesTurns(its_urgency))) return 1.0;
    float impatience = max(abs(urgency), abs(its_urgency));
    vec2 mine = preferred_velocities[self_slot];
    vec2 its = preferred_velocities[slot];
    if (impatience <= 0.0 || length(mine) <= STANDING_SPEED || length(its) <= STANDING_SPEED) return 1.0;
    vec2 way = normalize(mine);
    float alike = followed(likeness(way, its));
    if (alike <= 0.0) return 1.0;
    float lead = clamp(dot(offset, normalize(way + normalize(its))) / NEAREST_FIRST_LEAD, -1.0, 1.0);
    return pow(NEAREST_FIRST_WEIGHT, impatience * alike * lead);
}
