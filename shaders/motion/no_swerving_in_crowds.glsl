// SPDX-License-Identifier: Apache-2.0
// In a crowd nobody swerves for those who cross: where many others are near, a swerve only sweeps one along with them.

/// 0 (swerve freely) to 1 (not at all any more), by how many others are sensed.
float crowdingAmong(uint sensed) {
    if (!NO_SWERVING_IN_CROWDS_ENABLED) return 0.0;
    return clamp((float(sensed) - NO_SWERVING_IN_CROWDS_FREELY) /
                     (NO_SWERVING_IN_CROWDS_NO_MORE - NO_SWERVING_IN_CROWDS_FREELY), 0.0, 1.0);
}
