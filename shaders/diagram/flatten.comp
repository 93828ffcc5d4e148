// SPDX-License-Identifier: Apache-2.0
// Lays the pages of a diagram out as one picture.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = PIXEL_GROUP_SIZE) in;
layout(std430) writeonly buffer WholeOwners { uint whole_owners[]; };
uniform uvec2 diagram_size;

#include "shaders/shared/flat_index.glsl"
#include "shaders/diagram/owners.glsl"

void main() {
    uint index = flatIndex();
    if (index >= diagram_size.x * diagram_size.y) return;
    whole_owners[index] = ownerAt(uvec2(index % diagram_size.x, index / diagram_size.x));
}
