// SPDX-License-Identifier: Apache-2.0
// Nobody leaves their company behind: who is ahead of somebody slows down, who is behind hurries, who has lost its
// company walks towards it as much as to its goal, and where two ways are as good, a party takes the one of its first.
// Walking abreast is another rule (shaders/motion/company.glsl). Needs the block States and shaders/routes/route.glsl.
#include "shaders/charts/way_between.glsl"
#include "shaders/motion/letting_company_be.glsl"

/// Whether one's own way is longer than it would be straight over to a place and on from there.
bool isBehindWall(Stage stage, float remaining, vec2 position, vec2 place) {
    return remaining > distance(position, place) + routeAhead(stage, place).remaining + WAITING_FOR_COMPANY_BEHIND_WALL;
}

/// A way towards the nearest of the party, for who has lost it; not for long where somebody is in between, and not at
/// all where a wall is.
vec2 towardsParty(uint row, Walker walker, Stage stage, vec2 position, RouteAhead ahead, vec2 direction) {
    const float NOBODY = 1.0e5;
    vec2 nearest = vec2(10.0 * NOBODY);
    for (uint other = walker.party_first; other < walker.party_first + walker.party_size; ++other) {
        if (other == row || states[other].status != STATUS_WALKING || states[other].leave_step != 0u) continue;
        vec2 offset = wayTo(other, row, position);
        if (dot(offset, offset) < dot(nearest, nearest)) nearest = offset;
    }
    float distance = length(nearest);
    if (distance <= WAITING_FOR_COMPANY_LOST || distance > NOBODY) return direction;
    if (isBehindWall(stage, ahead.remaining, position, position + nearest)) return direction;
    float pull = smoothstep(WAITING_FOR_COMPANY_LOST, WAITING_FOR_COMPANY_QUITE_LOST, distance) *
                 (1.0 - lettingCompanyBe(walker.nervousness));
    vec2 result = direction + pull * nearest / distance;
    float size = length(result);
    return size > 0.3 ? result / size : direction;  // shorter: the two pull against each other
}

/// Whoever is near the first of its party and would turn off does not.
vec2 wayOfParty(uint row, Walker walker, Stage stage, vec2 position, RouteAhead ahead) {
    vec2 direction = ahead.direction;
    for (uint first = walker.party_first; first < row; ++first) {
        if (states[first].status != STATUS_WALKING || states[first].leave_step != 0u) continue;
        if (length(wayTo(first, row, position)) > 2.0 * WAITING_FOR_COMPANY_QUITE_LOST) return direction;
        if (isBehindWall(stage, ahead.remaining, position, states[first].position)) return direction;
        vec2 its_direction = routeAhead(stage, states[first].position).direction;
        return dot(its_direction, direction) < WAITING_FOR_COMPANY_SAME_WAY ? its_direction : direction;
    }
    return direction;
}

vec2 wayWithParty(uint row, Walker walker, Stage stage, vec2 position, RouteAhead ahead) {
    // Near one's own place, one goes there, wherever the others' are.
    bool arrives = stage.dwell > 0.0 && ahead.remaining < WAITING_FOR_COMPANY_QUITE_LOST;
    if (arrives) return ahead.direction;
    return towardsParty(row, walker, stage, position, ahead, wayOfParty(row, walker, stage, position, ahead));
}

/// The factor on somebody's speed.
float paceInParty(uint row, Walker walker, Stage stage, float remaining) {
    const float ENDS = WAITING_FOR_COMPANY_LEAD_ENDS;
    uint stages_left = walker.stage_end - walker.stage;
    float lead = -ENDS;  // over whoever is furthest behind
    float lag = -ENDS;   // behind whoever is furthest ahead
    for (uint other = walker.party_first; other < walker.party_first + walker.party_size; ++other) {
        if (other == row || states[other].status != STATUS_WALKING) continue;
        uint its_stages_left = states[other].stage_end - states[other].stage;
        float its_remaining = routeAhead(stage, states[other].position).remaining;
        float difference = its_stages_left == stages_left ? its_remaining - remaining
                         : its_stages_left > stages_left ? ENDS : -ENDS;
        lead = max(lead, difference);
        lag = max(lag, -difference);
    }
    const float BEGINS = WAITING_FOR_COMPANY_LEAD_BEGINS;
    float waiting = mix(1.0, WAITING_FOR_COMPANY_WAITING_PACE, smoothstep(BEGINS, ENDS, lead));
    return waiting < 1.0 ? waiting : mix(1.0, WAITING_FOR_COMPANY_HURRYING_PACE, smoothstep(BEGINS, ENDS, lag));
}
