// SPDX-License-Identifier: Apache-2.0

/// Whether a row takes part: others see it, the diagram has its tile, the frame shows it.
bool isAlive(uint status) { return status == STATUS_WALKING || status == STATUS_ARRIVED; }
