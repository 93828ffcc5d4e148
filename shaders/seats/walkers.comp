// SPDX-License-Identifier: Apache-2.0
// Lists who is on its way in each aisle, or asks to come in: of hundreds who share one they are all that those of other
// rows look at (others.glsl). The list of an aisle begins where those begin who share it.
#include "shaders/shared/simulation_types.h"
#include "shaders/shared/seat_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std430) readonly buffer SeatWays { SeatWay seat_ways[]; };
layout(std430) readonly buffer Sitters { Sitter sitters[]; };
layout(std430) buffer AisleCounts { uint aisle_counts[]; };  // zero before
layout(std430) writeonly buffer AisleWalkers { AisleWalker aisle_walkers[]; };
uniform uint sitter_count;

#include "shaders/seats/on_its_way.glsl"

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= sitter_count) return;
    Sitter self = sitters[index];
    if (!isOnItsWay(self.mode)) return;
    SeatWay way = seat_ways[index];
    // In whatever order: what is seen of them is the same.
    uint place = way.first_of_aisle + atomicAdd(aisle_counts[way.first_of_aisle], 1u);
    aisle_walkers[place] = AisleWalker(index, self.mode, self.side, self.since, self.along, self.share, way.mouth,
                                       way.branch << 16u | way.lane);
}
