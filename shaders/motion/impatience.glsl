// SPDX-License-Identifier: Apache-2.0
// Impatience. Who is held up for long stops making room and pushes: the nervousness 1 - v / v0 of Helbing, Farkas and
// Vicsek (2000), followed over some seconds. Braking and swerving fade with it, except swerving for oncoming people,
// and contact keeps bodies apart. That is how streams that cross at right angles get through each other.

/// 0 (as polite as can be) to 1 (makes no room any more).
float impatienceOf(float nervousness) {
    if (!IMPATIENCE_ENABLED) return 0.0;
    return clamp((nervousness - IMPATIENCE_BEGINS) / (IMPATIENCE_COMPLETE - IMPATIENCE_BEGINS), 0.0, 1.0);
}

/// 1 where somebody does not get on at all, 0 where it walks as it wishes or wants to stand. Walking behind others at
/// their pace is not being held up.
float heldUp(vec2 wish, float pace, vec2 velocity) {
    float speed = length(wish);
    return speed > STANDING_SPEED ? clamp(1.0 - dot(velocity, wish) / (speed * pace), 0.0, 1.0) : 0.0;
}

/// Nervousness after one more step.
float grownNervous(float nervousness, float held_up, float seconds) {
    return nervousness + (held_up - nervousness) * min(seconds / IMPATIENCE_MEMORY, 1.0);
}
