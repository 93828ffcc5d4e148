// SPDX-License-Identifier: Apache-2.0
// Cells of the coarse map that show the ground of another chart (authoring/storeys/charts.h) have what the cells have
// that they show: with SLOPES how fast jams make the way longer, otherwise the distances.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = PIXEL_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer ShownCells { uvec2 shown_cells[]; };  // where, and what
#ifdef SLOPES
layout(std430) buffer DetourSlopes { vec2 detour_slopes[]; };
#else
layout(std430) buffer DetourDistances { float detour_distances[]; };
layout(std430) writeonly buffer ChangedBlocks { uint changed_blocks[]; };
#endif
uniform uint shown_count;
uniform uint first_field;  // of this round
uniform uint field_count;

#include "shaders/shared/flat_index.glsl"
#include "shaders/routes/detour_blocks.glsl"

void main() {
    uint index = flatIndex();
    if (index >= shown_count * field_count) return;
    uvec2 divided = quotientAndRemainder(index, shown_count);
    uint field = first_field + divided.x;
    uvec2 shown = shown_cells[divided.y];
    uint at = field * cellsOfMap() + shown.x, from = field * cellsOfMap() + shown.y;
#ifdef SLOPES
    detour_slopes[at] = detour_slopes[from];
#else
    if (detour_distances[at] == detour_distances[from]) return;
    detour_distances[at] = detour_distances[from];
    // Several may write, all the same.
    changed_blocks[field * blocksOfMap() + shown.x / PIXEL_GROUP_SIZE] = 1u;
#endif
}
