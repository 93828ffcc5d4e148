// SPDX-License-Identifier: Apache-2.0
// Headway in peace: those who were given no headway keep a short one while they are patient and everybody they sense
// goes their way. A platoon that walks on by itself spreads; a tight one would enclose whoever crosses its way and
// carry them off. Where streams meet they close up, because there a headway only gives room away to those who come
// across.
// Needs shaders/motion/walking_behind.glsl.

/// Whether somebody sensed does not disturb the peace.
bool isPeaceful(float alike) { return followed(alike) > 0.0; }

/// s.
float headwayInPeace(float impatience) { return HEADWAY_IN_PEACE_HEADWAY * (1.0 - impatience); }
