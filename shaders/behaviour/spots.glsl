// SPDX-License-Identifier: Apache-2.0
// Spots of people's own in a place: drawn by counting among points that are clear of walls, the first of several on
// which nobody stands. Who walks together stands in a ring round one of them.
// Needs the blocks Bodies, BehaviourPlaces and BehaviourPoints, the uniform steps_done, and
// shaders/behaviour/draws.glsl and shaders/cells/cell_runs.glsl.

const float RING = 0.45;        // m (authoring/scene/behaviours.cpp leaves room for it)
const float BESIDE = 0.1;       // m between two who stand
const uint SPOT_TRIES = 24u;
const uint PICKS_OF_A_STATE = 64u;

/// Somebody who looks for a place to go to.
struct Seeker {
    uint slot, row, leader, member, party_size;
    vec2 position;
    vec2 ahead;  // where it looks
    float radius;
};

/// Once in some decisions, at others than its neighbours.
bool looksRoundAgain(Seeker seeker) {
    const uint ONCE_IN = 16u;  // decisions
    uint decision = uint(float(steps_done) * parameters.step_seconds / parameters.decision_seconds);
    return (decision + seeker.row) % ONCE_IN == 0u;
}

bool isOfParty(Seeker seeker, uint row) { return row - seeker.leader < seeker.party_size; }

/// Whether somebody else stands there. @param slower m/s: who is faster does not count
bool isTaken(Seeker seeker, vec2 spot, float slower) {
    ivec2 cell = cellOf(spot);
    for (int y = cell.y - 1; y <= cell.y + 1; ++y) {
        uvec2 run = slotRun(cell.x, y);
        for (uint other = run.x; other < run.y; ++other)
            if (!isOfParty(seeker, bodies[other].row) && length(bodies[other].velocity) <= slower &&
                distance(bodies[other].position, spot) < seeker.radius + bodies[other].radius + BESIDE)
                return true;
    }
    return false;
}

/// The same number for all of a party that has done as much.
uint pickOf(Mind mind, uint nth) { return (mind.entered * PICKS_OF_A_STATE + mind.picks) * 64u + nth; }

vec2 spotOf(BehaviourPlace place, Seeker seeker, Mind mind, uint nth) {
    uint pick = randomWord(parameters.seed ^ PURPOSE_SPOT, seeker.leader, pickOf(mind, nth));
    return behaviour_points[place.first_point + pick % place.point_count];
}

/// From the middle of a party to one of it.
vec2 ringOffset(Seeker seeker) {
    if (seeker.party_size < 2u) return vec2(0.0);
    float turn = float(seeker.member) / float(seeker.party_size) + 0.618034 * float(seeker.leader % 89u);
    return RING * vec2(cos(6.28318530717959 * turn), sin(6.28318530717959 * turn));
}

/// The middle of those who stand there together.
vec2 freeSpot(BehaviourPlace place, Seeker seeker, Mind mind) {
    vec2 offset = ringOffset(seeker);
    for (uint nth = 0u; nth < SPOT_TRIES; ++nth) {
        vec2 spot = spotOf(place, seeker, mind, nth);
        if (!isTaken(seeker, spot + offset, 1.0e9)) return spot;
    }
    return spotOf(place, seeker, mind, 0u);
}
