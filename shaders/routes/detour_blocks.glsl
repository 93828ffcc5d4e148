// SPDX-License-Identifier: Apache-2.0
// The coarse map in blocks of one group of invocations each. Where the crowd is thin and nothing has changed round
// about, nothing will: only the other blocks are listed and worked on, so that a jam costs as much as it is large, and
// not as the map is. A listed block has the number field * blocksOfMap() + block.

uint cellsOfMap() { return parameters.detour_width * parameters.detour_height; }
uint blocksOfMap() { return (cellsOfMap() + PIXEL_GROUP_SIZE - 1u) / PIXEL_GROUP_SIZE; }
