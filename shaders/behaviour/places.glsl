// SPDX-License-Identifier: Apache-2.0
// Which of a state's places somebody goes to. Needs the block BehaviourPlaces, shaders/routes/route.glsl and
// shaders/behaviour/draws.glsl and spots.glsl.

uint nearestPlace(BehaviourState doing, vec2 position) {
    uint nearest = doing.first_place;
    float least = 1.0e30;
    for (uint i = doing.first_place; i < doing.first_place + doing.place_count; ++i) {
        float away = sampleField(behaviour_places[i].field, position).remaining;
        if (away >= least) continue;
        least = away;
        nearest = i;
    }
    return nearest;
}

uint choosePlace(BehaviourState doing, Seeker seeker, Mind mind) {
    if ((doing.flags & STATE_NEAREST) != 0u) return nearestPlace(doing, seeker.position);
    float left = 0.0;
    for (uint i = 0u; i < doing.place_count; ++i) left += behaviour_places[doing.first_place + i].weight;
    left *= chanceOf(PURPOSE_PLACE, seeker.leader, pickOf(mind, 0u));
    for (uint i = 0u; i + 1u < doing.place_count; ++i) {
        float weight = behaviour_places[doing.first_place + i].weight;
        if (left < weight) return doing.first_place + i;
        left -= weight;
    }
    return doing.first_place + doing.place_count - 1u;
}

/// One of those that it has not been to.
void visitNext(BehaviourState doing, Seeker seeker, inout Mind mind) {
    uint open = doing.place_count - uint(bitCount(mind.visited));
    if (open == 0u) return;
    float chance = chanceOf(PURPOSE_PLACE, seeker.leader, mind.entered * PICKS_OF_A_STATE + mind.visits_left);
    uint nth = min(uint(chance * float(open)), open - 1u);
    for (uint i = 0u; i < doing.place_count; ++i) {
        if ((mind.visited >> i & 1u) != 0u) continue;
        if (nth-- > 0u) continue;
        mind.visited |= 1u << i;
        mind.place = doing.first_place + i;
        break;
    }
    mind.visits_left -= 1u;
    mind.picks += 1u;
}
