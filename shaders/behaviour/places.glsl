// SPDX-License-Identifier: Apache-2.0
// Which of a state's places somebody goes to. Needs the blocks States and BehaviourPlaces, and
// shaders/shared/alive.glsl, shaders/routes/route.glsl and shaders/behaviour/draws.glsl and spots.glsl.

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

/// The nth of the places that it has not been to.
uint unvisited(BehaviourState doing, Mind mind, uint nth) {
    for (uint i = 0u; i < doing.place_count; ++i) {
        if ((mind.visited >> i & 1u) != 0u) continue;
        if (nth == 0u) return i;
        nth -= 1u;
    }
    return 0u;
}

/// Of two of the places that it has not been to, drawn by chance, the nearer to where its party is.
void visitNext(BehaviourState doing, Seeker seeker, inout Mind mind) {
    uint open = doing.place_count - uint(bitCount(mind.visited));
    if (open == 0u) return;
    uint count = 2u * (mind.entered * PICKS_OF_A_STATE + mind.visits_left);
    uint chosen = 0u;
    float least = 1.0e30;
    for (uint i = 0u; i < 2u; ++i) {
        float chance = chanceOf(PURPOSE_PLACE, seeker.leader, count + i);
        uint place = unvisited(doing, mind, min(uint(chance * float(open)), open - 1u));
        vec2 from = isAlive(states[seeker.leader].status) ? states[seeker.leader].position : seeker.position;
        float away = sampleField(behaviour_places[doing.first_place + place].field, from).remaining;
        if (away >= least) continue;
        least = away;
        chosen = place;
    }
    mind.visited |= 1u << chosen;
    mind.place = doing.first_place + chosen;
    mind.visits_left -= 1u;
    mind.picks += 1u;
}
