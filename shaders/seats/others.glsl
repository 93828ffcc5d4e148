// SPDX-License-Identifier: Apache-2.0
// What somebody between the rows sees of the others who come by the same aisle: nobody overtakes anybody, and who sits
// stands up before anybody passes.
// Needs the blocks SeatWays, Sitters, SeatLanes, LaneMates and AisleCounts, and the sampler aisle_walkers.

const float ROOM = 0.5;            // m of the row that who sits takes
const float BEFORE_KNEES = 0.45;   // m: so near one comes to somebody who does not stand yet
const float BEFORE_ROW = 0.75;     // m before a row, where one waits for those who come out of it
const float FAR_ENOUGH = 1.0e6;    // m
const float MADE_ROOM = 0.85;      // so far up, one may be passed
const float MERGES = 1.5;          // m behind a fork

/// What of it matters to one of them.
struct Others {
    float gap;         // m to the next one ahead
    float halt;        // m along the way: it stops there, before somebody who sits
    bool comes_out;    // somebody of the same row, who leaves it
    bool goes_in;      // somebody who goes into the same row
    bool passes;       // somebody near by, before one's seat
    bool line_taken;   // somebody walks before one's seat
    bool aisle_taken;  // somebody is where one steps into the aisle
    bool comes_first;  // somebody has asked to go in before
    bool comes_in;     // somebody is on the way in, or has asked to go in
    bool against;      // somebody comes out where those walk who go in
};

AisleWalker walkerAt(uint place) {
    uvec4 who = texelFetch(aisle_walkers, int(2u * place)), where = texelFetch(aisle_walkers, int(2u * place + 1u));
    return AisleWalker(who.x, who.y, who.z, who.w, uintBitsToFloat(where.x), uintBitsToFloat(where.y),
                       uintBitsToFloat(where.z), where.w);
}

uint laneOf(AisleWalker walker) { return walker.lane_and_branch & 0xffffu; }
uint branchOf(AisleWalker walker) { return walker.lane_and_branch >> 16u; }

/// Whether two places on the ways of two people are on what they share: where ways to the front and to the back meet,
/// people go in in the order in which they come, as if all came along one line.
bool areTogether(SeatWay way, AisleWalker other, float place, float their_place) {
    return way.branch == branchOf(other) || max(place, their_place) < way.fork + MERGES;
}

/// Whether two who leave walk on one side of the aisle. Who keeps to the side beside those who come in may meet any.
bool areInOneFile(SeatWay way, Sitter self, AisleWalker other) {
    return other.side == self.side || (way.fork != NO_FORK && (other.side == 0u || self.side == 0u));
}

bool isEarlier(AisleWalker other, Sitter self, uint index) {
    return other.since < self.since || (other.since == self.since && other.number < index);
}

/// Whether one who goes to `goal` has yet to pass a seat, or is just doing so, and is near.
bool isPassing(Sitter walker, SeatWay goal, float seat) {
    const float SEEN = 1.3;    // m
    const float PASSED = 0.4;  // m
    if (goal.length <= seat + 0.1) return false;
    float ahead = walker.mode == SITTER_ENTERS ? seat - walker.along : walker.along - seat;
    return (walker.mode == SITTER_ENTERS || walker.mode == SITTER_LEAVES) && ahead > -PASSED && ahead < SEEN;
}

/// Whether somebody between the aisle and its seat lets nobody through yet.
bool isInTheWay(Sitter other) {
    bool in_seat = other.mode >= SITTER_TURNS && other.mode <= SITTER_RISES;
    bool stands = (other.mode == SITTER_STANDS_FOR || other.mode == SITTER_RISES) && other.share >= MADE_ROOM;
    return in_seat && !stands;
}

void seeAhead(inout Others seen, Sitter self, SeatWay way, uint index, AisleWalker other) {
    const float STILL_IN_AISLE = 0.3;  // m into a row
    const float STEPS_OUT = 0.7;       // m from the aisle, which is its own from there on
    bool inwards = self.mode != SITTER_LEAVES;
    if (other.mode != (inwards ? SITTER_ENTERS : SITTER_LEAVES)) return;
    bool same_row = laneOf(other) == way.lane;
    bool own_row = self.along > way.mouth;
    if (!inwards && !same_row && !areInOneFile(way, self, other)) return;
    bool apart = inwards && way.branch != branchOf(other);
    float parting = apart ? min(other.mouth, way.fork) : other.mouth;
    if (!same_row && (own_row || other.along > parting + (inwards ? STILL_IN_AISLE : STEPS_OUT))) return;
    float place = same_row ? other.along : min(other.along, parting);
    if (!inwards && !areTogether(way, other, self.along, place)) return;
    float ahead = inwards ? place - self.along : self.along - place;
    if (ahead > 0.0 || (ahead == 0.0 && other.number < index)) seen.gap = min(seen.gap, ahead);
}

void seeRow(inout Others seen, Sitter self, SeatWay way, Sitter other, SeatWay theirs) {
    bool in_row = other.along > theirs.mouth - BEFORE_ROW;
    seen.comes_out = seen.comes_out || other.mode == SITTER_RISES ||
                     (other.mode == SITTER_LEAVES && other.along > theirs.mouth - 0.05);
    seen.goes_in = seen.goes_in || (other.mode == SITTER_ENTERS && in_row);
    seen.passes = seen.passes || isPassing(other, theirs, way.length);
    bool walks = other.mode == SITTER_ENTERS || other.mode == SITTER_LEAVES;
    seen.line_taken = seen.line_taken || (walks && abs(other.along - way.length) < ROOM + 0.1);
    if (!isInTheWay(other) || theirs.length > way.length - 0.1) return;
    if (self.mode == SITTER_ENTERS && theirs.length > self.along - 0.1)
        seen.halt = min(seen.halt, theirs.length - BEFORE_KNEES);
    if (self.mode == SITTER_LEAVES && theirs.length < self.along + 0.1)
        seen.halt = max(seen.halt, theirs.length + BEFORE_KNEES);
}

/// Who comes out of a row lets those by who are in the aisle, and at the same height who has left before.
void seeAisle(inout Others seen, Sitter self, SeatWay way, uint index, AisleWalker other) {
    const float BELOW = 0.55, ABOVE = 0.8;  // m
    const float AT_MOUTH = 0.85;            // m into a row
    const float DUE = 0.4;                  // of its patience left
    if (other.mode == SITTER_ENTERS || other.mode == SITTER_ASKS) seen.comes_in = true;
    if (other.mode != SITTER_LEAVES || laneOf(other) == way.lane) return;
    if (other.side != 0u && other.along <= other.mouth) seen.against = true;
    // Rows on other branches are out of reach; who comes out of them merges before the opening (seeAhead).
    if (way.branch != branchOf(other) || !areInOneFile(way, self, other)) return;
    // Who has waited for long is let in.
    bool is_due = other.along > other.mouth && other.along < other.mouth + AT_MOUTH && other.share < DUE;
    if (is_due && self.along <= way.mouth && self.along > other.mouth + ABOVE)
        seen.halt = max(seen.halt, other.mouth + ABOVE);
    float beyond = other.along - way.mouth;
    bool in_aisle = other.along <= other.mouth;
    bool waits = !in_aisle && other.along < other.mouth + AT_MOUTH && abs(other.mouth - way.mouth) < BELOW;
    if (in_aisle && beyond > -BELOW && beyond < ABOVE) seen.aisle_taken = true;
    if (waits && isEarlier(other, self, index)) seen.aisle_taken = true;
}

Others lookAround(uint index, Sitter self, SeatWay way) {
    Others seen = Others(FAR_ENOUGH, self.mode == SITTER_LEAVES ? -FAR_ENOUGH : FAR_ENOUGH, false, false, false, false,
                         false, false, false, false);
    // Who has sat down minds only its row. Who is on the way in it is seen twice, which makes no difference; nor does
    // the order.
    uint walkers = isOnItsWay(self.mode) ? aisle_counts[way.first_of_aisle] : 0u;
    for (uint i = 0u; i < walkers; ++i) {
        AisleWalker other = walkerAt(way.first_of_aisle + i);
        if (other.number == index) continue;
        seeAhead(seen, self, way, index, other);
        seeAisle(seen, self, way, index, other);
        if (other.mode == SITTER_ASKS && isEarlier(other, self, index)) seen.comes_first = true;
    }
    SeatLane lane = seat_lanes[index];
    for (uint i = lane.first; i < lane.first + lane.count; ++i) {
        uint number = lane_mates[i];
        if (number != index) seeRow(seen, self, way, sitters[number], seat_ways[number]);
    }
    return seen;
}
