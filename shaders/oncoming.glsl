// SPDX-License-Identifier: Apache-2.0
// How much oncoming traffic somebody has to deal with. Needs the blocks Bodies, RowSlots, Neighbours, NeighbourCounts,
// and a function facing(slot): where somebody wants to go, of any length.

const float ONCOMING_NEAR = 1.0;  // m: nearer than this counts fully
const float ONCOMING_FAR = 3.0;   // m: further than this not at all
const float GETTING_ON = 0.75;    // of the wished speed: from here on nobody counts as held up, and need not look

/// How much `direction` goes against `way`, of unit length: 0 up to 107 degrees, 1 from 143.
float against(vec2 way, vec2 direction) {
    return smoothstep(0.3, 0.8, -dot(direction, way) / max(length(direction), 1.0e-3));
}

/// 0 where nobody within ONCOMING_FAR comes towards somebody who goes `way`, 1 where somebody near does.
float oncomingTraffic(uint slot, vec2 way) {
    float most = 0.0;
    vec2 position = bodies[slot].position;
    uint sensed = neighbour_counts[slot];
    for (uint i = 0u; i < sensed; ++i) {
        uint key = neighbours[i * slot_capacity + slot];
        if ((key & NEIGHBOUR_IS_WALL) != 0u) continue;
        uint other = row_slots[key];
        vec2 offset = bodies[other].position - position;
        float away = length(offset);
        if (dot(offset, way) < 0.4 * away) continue;
        most = max(most, against(way, facing(other)) * smoothstep(ONCOMING_FAR, ONCOMING_NEAR, away));
    }
    return most;
}
