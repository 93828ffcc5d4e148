// SPDX-License-Identifier: Apache-2.0
// How fast people go between rows: one behind the other, up and down steps, and stopping where they have to.
// Needs the block ParametersBlock, and shaders/seats/others.glsl.

const float IN_AISLE = 0.8;      // m/s at most
const float IN_ROW = 0.6;        // m/s at most
const float AISLE_GAP = 0.55;    // m from one to the next
const float ROW_GAP = 0.45;
const float CORNER = 0.7;        // m around the mouth of a row: ways are shorter round it than along the lines
const float CORNER_GAP = 0.75;
const float AFTER = 0.5;         // s behind the next
const float GAINS = 1.5;         // m/s^2
const float PATIENCE = 4.0;      // s
const float THERE = 0.02;        // m
const float BEFORE_AISLE = 0.75; // m into the row, where one waits to step into the aisle
const float BEFORE_END = 0.12;   // m of the aisle, where one waits for room on the ground
const float TO_SIDE = 1.2;       // m of the row, after which one keeps to a side of an aisle that forks
const float COMES_TO_WAY = 0.5;  // m walked, until one is on it

/// m that somebody may still go.
float roomAhead(Sitter self, SeatWay way, Others seen) {
    bool inwards = self.mode == SITTER_ENTERS;
    float room = inwards ? min(way.length, seen.halt) - self.along : self.along - max(seen.halt, 0.0);
    float gap = self.along > way.mouth ? ROW_GAP : AISLE_GAP;
    if (abs(self.along - way.mouth) < CORNER) gap = CORNER_GAP;
    if (way.fork != NO_FORK && self.along > way.fork - CORNER && self.along < way.fork + MERGES) gap = CORNER_GAP;
    room = min(room, seen.gap - gap);
    float line = way.mouth - BEFORE_ROW;
    if (inwards && seen.comes_out && self.along < line + THERE) room = min(room, line - self.along);
    float waits = way.mouth + BEFORE_AISLE;
    if (!inwards && seen.aisle_taken && self.along > waits - THERE) room = min(room, self.along - waits);
    return max(room, 0.0);
}

void walk(inout Sitter self, SeatWay way, Others seen, float preferred) {
    float dt = parameters.step_seconds;
    float room = roomAhead(self, way, seen);
    float most = min(preferred, self.along > way.mouth ? IN_ROW : IN_AISLE);
    self.speed = min(min(most, self.speed + GAINS * dt), max(room / AFTER, min(room / dt, 0.1)));
    float step = min(self.speed * dt, room);
    if (self.mode == SITTER_LEAVES) {
        self.share = step > 0.0 ? 1.0 : max(0.0, self.share - dt / PATIENCE);
        // Out on the side of its row, while nobody comes in there.
        float decides = way.fork == NO_FORK ? way.mouth : min(way.mouth + TO_SIDE, way.length - HAIR);
        if (self.along > decides) self.side = seen.comes_in ? 0u : way.free_side;
    }
    self.along += self.mode == SITTER_ENTERS ? step : -step;
    float away = length(self.off);
    if (away > 0.0) self.off *= max(0.0, 1.0 - step / (COMES_TO_WAY * max(away, 0.3)));
}

/// What somebody walks, and which way it looks.
void takeSteps(inout AgentState state, vec2 before) {
    const float SLOW = 0.05;  // m/s
    vec2 moved = state.position - before;
    state.velocity = moved / parameters.step_seconds;
    state.walked += length(moved);
    if (length(state.velocity) > SLOW) state.heading = turnTowards(state.heading, state.velocity);
}
