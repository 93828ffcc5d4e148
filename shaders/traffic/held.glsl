// SPDX-License-Identifier: Apache-2.0
// Who is held before a red crossing (shaders/traffic/held_at_red.glsl), or waits for a lift (shaders/lifts/wish.comp),
// queues there and does not press. Only with TRAFFIC or LIFTS.

const float HELD_HEADWAY = 1.0;  // s

bool isHeld(uint walker_flags) { return (walker_flags & WALKER_HELD) != 0u; }

/// s.
float headwayBeforeRed(uint walker_flags) { return isHeld(walker_flags) ? HELD_HEADWAY : 0.0; }
