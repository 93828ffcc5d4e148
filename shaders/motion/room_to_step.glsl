// SPDX-License-Identifier: Apache-2.0
// Room to step: those who walk behind each other leave a little more than touching while they are patient.
// Needs shaders/motion/walking_behind.glsl.

/// m.
float roomToStep(float alike, float patience) {
    return ROOM_TO_STEP_ENABLED ? ROOM_TO_STEP_GAP * followed(alike) * patience : 0.0;
}
