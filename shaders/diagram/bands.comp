// SPDX-License-Identifier: Apache-2.0
// Who looks round while a band of the diagram is kept: all in some lines of cells, as slots are in the order of cells.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = 1) in;
layout(std430) writeonly buffer Bands { Band bands[]; };
uniform uvec2 cells_across;
uniform uint lines_per_band;  // of cells

#include "shaders/cells/cell_starts.glsl"

void main() {
    uint band = gl_WorkGroupID.x;
    uint line = band * lines_per_band;
    uint first = cellStart(line * cells_across.x);
    uint end = cellStart(min(line + lines_per_band, cells_across.y) * cells_across.x);
    bands[band] = Band((end - first + AGENT_GROUP_SIZE - 1u) / AGENT_GROUP_SIZE, 1u, 1u, first, end);
}
