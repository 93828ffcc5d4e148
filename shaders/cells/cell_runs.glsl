// SPDX-License-Identifier: Apache-2.0
// Runs of slots around a cell.

#include "shaders/cells/cell_starts.glsl"

/// The slots of up to three cells of line `y` around column `x`: first and one past the last.
uvec2 slotRun(int x, int y) {
    if (y < 0 || y >= int(parameters.cells_height)) return uvec2(0u);
    uint first = uint(max(x - 1, 0));
    uint last = uint(min(x + 1, int(parameters.cells_width) - 1));
    uint line = uint(y) * parameters.cells_width;
    return uvec2(cellStart(line + first), cellStart(line + last + 1u));
}
