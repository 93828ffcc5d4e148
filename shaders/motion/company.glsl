// SPDX-License-Identifier: Apache-2.0
// Walking together (Moussaid et al. 2010, equations 3 to 5, with its figures): people who belong together would like to see
// each other without turning their heads by more than a right angle, stay near, and leave each other an arm's length. Two
// walk abreast then, three in a V and four in a U, and in a crowd the V closes. Needs the block States.

const float SEEING_EACH_OTHER = 4.0;  // 1/s per rad of turning the head
const float STAYING_NEAR = 3.0;       // m/s^2
const float ARMS_LENGTH = 0.8;        // m
const float LEAVING_ROOM = 1.0;       // m/s^2
/// Who is further away than this (m) is no company to walk beside; one waits for it and looks for it instead
/// (shaders/motion/steer.comp).
const float OUT_OF_COMPANY = 4.0;

/// m/s^2: what walking with its party makes of somebody's way.
vec2 company(Body self, uint first, uint size, vec2 way) {
    vec2 sum = vec2(0.0), apart = vec2(0.0);
    float others = 0.0;
    for (uint row = first; row < first + size; ++row) {
        if (row == self.row || states[row].status != STATUS_WALKING) continue;
        vec2 offset = states[row].position - self.position;
        float distance = length(offset);
        if (distance > OUT_OF_COMPANY || distance < 1.0e-3) continue;
        sum += offset;
        others += 1.0;
        if (distance < ARMS_LENGTH) apart -= offset / distance;
    }
    if (others == 0.0) return vec2(0.0);
    vec2 to_others = sum / others;
    float distance = max(length(to_others), 1.0e-3);
    float turning = max(acos(clamp(dot(way, to_others) / distance, -1.0, 1.0)) - 1.5707963, 0.0);
    // The middle of the party, oneself included.
    vec2 to_middle = sum / (others + 1.0);
    vec2 near = length(to_middle) > 0.5 * others ? STAYING_NEAR * to_others / distance : vec2(0.0);
    return near - SEEING_EACH_OTHER * turning * self.velocity + LEAVING_ROOM * apart;
}
