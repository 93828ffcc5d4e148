// SPDX-License-Identifier: Apache-2.0
// Strolling about: from spot to spot of a place, rather ahead than back, and only where the straight way is clear. Who
// is still outside goes in first, and then chooses anew.
// Needs shaders/behaviour/outlines.glsl, clear_way.glsl and spots.glsl.

const uint WANDER_TRIES = 16u;
const float NEAREST_SPOT = 2.5;   // m
const float FURTHEST_SPOT = 15.0;  // m
const float WHIM = 1.2;            // so much a chance counts beside going straight on

bool isIn(BehaviourPlace place, vec2 position) { return isInside(position, place.first_corner, place.corner_count); }

/// What somebody thinks of a spot; below -9 it will not do.
float likingOf(Seeker seeker, Mind mind, vec2 spot, uint nth) {
    vec2 offset = spot - seeker.position;
    float away = length(offset);
    if (away < NEAREST_SPOT || away > FURTHEST_SPOT) return -10.0;
    return dot(offset, seeker.ahead) / away + WHIM * chanceOf(PURPOSE_STAY, seeker.leader, pickOf(mind, nth));
}

vec2 nextSpot(Seeker seeker, inout Mind mind) {
    BehaviourPlace place = behaviour_places[mind.place];
    vec2 best = spotOf(place, seeker, mind, 0u);
    mind.flags &= ~MIND_COMES_IN;
    if (!isIn(place, seeker.position)) {
        mind.flags |= MIND_COMES_IN;
        return best;
    }
    float most = -9.0;
    for (uint nth = 0u; nth < WANDER_TRIES; ++nth) {
        vec2 spot = spotOf(place, seeker, mind, nth);
        float liking = likingOf(seeker, mind, spot, nth);
        if (liking <= most || !wayIsClear(seeker.position, spot, seeker.radius)) continue;
        most = liking;
        best = spot;
    }
    return best;
}

/// Whether somebody who came from outside is in, or has not got on for so long that another way is better.
bool choosesAnew(Seeker seeker, Mind mind, float nervousness) {
    const float GIVES_UP = 0.8;
    BehaviourPlace place = behaviour_places[mind.place];
    if ((mind.flags & MIND_COMES_IN) != 0u) return isIn(place, seeker.position);
    return nervousness > GIVES_UP && looksRoundAgain(seeker);
}
