// SPDX-License-Identifier: Apache-2.0
// Puts every row into its cell's run of slots, in whatever order the device runs: bodies_gather mends that.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer RowCells { uint row_cells[]; };
layout(std430) buffer CellCounts { uint cell_counts[]; };
layout(std430) writeonly buffer LooseRows { uint loose_rows[]; };
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
layout(std430) writeonly buffer SiteSlots { uint site_slots[]; };
uniform uint ids_are_rows;  // of the sites, see bodies_gather.comp

#include "shaders/cells/cell_starts.glsl"

/// The next slot of a cell that is free, from its last one on. That leaves no count behind: ready for the next step.
uint takeSlot(uint cell) { return cellStart(cell) + atomicAdd(cell_counts[cell], -1u) - 1u; }

void main() {
    uint row = gl_GlobalInvocationID.x;
    if (row >= parameters.site_rows) return;
    uint cell = row_cells[row];
    bool site_exists = ids_are_rows != 0u ? cell != NO_INDEX : row < live_count;
    if (!site_exists) site_slots[row] = NO_INDEX;
    if (cell != NO_INDEX)
        loose_rows[takeSlot(cell)] = row;
}
