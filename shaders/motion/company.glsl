// SPDX-License-Identifier: Apache-2.0
// Company: walking together (Moussaid et al. 2010, equations 3 to 5, with its figures). People who belong together
// would like to see each other without turning their heads by more than a right angle, stay near, and leave each other
// an arm's length. Two walk abreast then, three in a V and four in a U, and in a crowd the V closes. Who is too far
// away is no company to walk beside; one waits for it and looks for it instead
// (shaders/motion/waiting_for_company.glsl).
// Needs the block States.
#ifdef PARTIES
#include "shaders/charts/way_between.glsl"
#include "shaders/shared/walker.glsl"
#include "shaders/motion/letting_company_be.glsl"

/// m/s^2: what walking with those from row `first` on makes of somebody's way.
vec2 besideParty(Body self, uint first, uint size, vec2 way) {
    vec2 sum = vec2(0.0), apart = vec2(0.0);
    float others = 0.0;
    for (uint row = first; row < first + size; ++row) {
        if (row == self.row || states[row].status != STATUS_WALKING) continue;
        vec2 offset = wayTo(row, self.row, self.position);
        float distance = length(offset);
        if (distance > COMPANY_OUT_OF_REACH || distance < 1.0e-3) continue;
        sum += offset;
        others += 1.0;
        if (distance < COMPANY_ARMS_LENGTH) apart -= offset / distance;
    }
    if (others == 0.0) return vec2(0.0);
    vec2 to_others = sum / others;
    float distance = max(length(to_others), 1.0e-3);
    float turning = max(acos(clamp(dot(way, to_others) / distance, -1.0, 1.0)) - 1.5707963, 0.0);
    // The middle of the party, oneself included.
    vec2 to_middle = sum / (others + 1.0);
    vec2 near = length(to_middle) > 0.5 * others ? COMPANY_STAYING_NEAR * to_others / distance : vec2(0.0);
    return near - COMPANY_SEEING_EACH_OTHER * turning * self.velocity + COMPANY_LEAVING_ROOM * apart;
}

/// 0 to 1: how much of being held back by its company somebody lets be. Two parties between each other, each with
/// somebody ahead of both who waits, would stand for good where people stride and do not press.
float lettingGoOf(Walker walker) { return hasBody(walker) ? lettingCompanyBe(walker.nervousness) : 0.0; }

/// m/s^2. Who slows down for its place lets go of its company; who strides and does not get on is not held back by it.
vec2 company(Body self, Walker walker, vec2 way, float speed) {
    if (!COMPANY_ENABLED || walker.party_size <= 1u || speed <= STANDING_SPEED) return vec2(0.0);
    vec2 beside = besideParty(self, walker.party_first, walker.party_size, way) *
                  smoothstep(0.0, COMPANY_LETTING_GO, speed / walker.preferred_speed);
    return beside - way * (min(dot(beside, way), 0.0) * lettingGoOf(walker));
}

/// m/s^2: of the room that others want, what somebody makes who waits for its company. It makes way to a side, but is
/// not driven on.
vec2 notLedAway(Walker walker, vec2 way, vec2 room) {
    if ((walker.flags & WALKER_WAITS) == 0u) return room;
    return room - way * max(dot(room, way), 0.0);
}
#else
vec2 company(Body self, Walker walker, vec2 way, float speed) { return vec2(0.0); }
vec2 notLedAway(Walker walker, vec2 way, vec2 room) { return room; }
#endif
