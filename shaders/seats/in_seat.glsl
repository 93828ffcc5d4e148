// SPDX-License-Identifier: Apache-2.0
// Before the seat and in it: turn, sit down, sit, and stand up for others or to leave.
// Needs the blocks ParametersBlock and Minds, the uniform steps_done, and shaders/seats/ways.glsl and others.glsl.

const float TURNS_FOR = 0.8;       // s
const float STANDS_UP_FOR = 0.7;   // s
const float SITS_DOWN_FOR = 0.9;   // s
const float LETS_GO_FOR = 0.9;     // s; as of who stands (shaders/behaviour/letting_go.glsl)

float smoothed(float share) { return share * share * (3.0 - 2.0 * share); }

void setMode(inout Sitter self, uint mode) {
    self.mode = mode;
    self.since = steps_done;
}

/// One's back to the seat.
void turnBack(inout Sitter self, inout AgentState state, SeatWay way, Others seen, float seconds) {
    float share = clamp(seconds / TURNS_FOR, 0.0, 1.0);
    vec2 before = state.position;
    state.position = mix(placeOnWay(way, way.length, FILE_IN) + self.off, way.stand, smoothed(share));
    state.velocity = (state.position - before) / parameters.step_seconds;
    state.walked += length(state.position - before);
    state.heading = turnTowards(state.heading, vec2(cos(way.heading), sin(way.heading)));
    if (share < 1.0) return;
    self.off = vec2(0.0);
    self.speed = 0.0;
    self.share = 1.0;
    state.heading = way.heading;
    setMode(self, seen.passes ? SITTER_STANDS_FOR : SITTER_SETTLES);
}

/// Somewhere between sitting and standing; how far is told with it, and the place goes with it.
void moveUp(inout Sitter self, float seconds) {
    self.share = clamp(self.share + parameters.step_seconds / seconds, 0.0, 1.0);
}

void beginToLeave(inout Sitter self, SeatWay way) {
    self.along = way.length;
    self.speed = 0.0;
    self.off = way.stand - placeOnWay(way, way.length, FILE_OUT);
    self.side = 0u;
    self.seated = NO_INDEX;
    setMode(self, SITTER_LEAVES);
}

void stayInSeat(inout Sitter self, inout AgentState state, SeatWay way, Others seen, bool wants) {
    float seconds = float(steps_done - self.since) * parameters.step_seconds;
    state.velocity = vec2(0.0);
    switch (self.mode) {
        case SITTER_TURNS: turnBack(self, state, way, seen, seconds); return;
        case SITTER_SETTLES:
            moveUp(self, -SITS_DOWN_FOR);
            if (seen.passes)
                setMode(self, SITTER_STANDS_FOR);
            else if (self.share == 0.0)
                setMode(self, SITTER_SITS);
            break;
        case SITTER_SITS:
            if (self.seated == NO_INDEX) self.seated = steps_done;
            if (seen.passes || (!wants && !seen.goes_in)) setMode(self, SITTER_LETS_GO);
            break;
        case SITTER_LETS_GO:
            if (seconds < LETS_GO_FOR) break;
            self.activity = ACTIVITY_SIT;
            if (seen.passes)
                setMode(self, SITTER_STANDS_FOR);
            else
                setMode(self, wants ? SITTER_SITS : SITTER_RISES);
            break;
        case SITTER_STANDS_FOR:
            moveUp(self, seen.passes ? STANDS_UP_FOR : -SITS_DOWN_FOR);
            if (!wants && !seen.goes_in) setMode(self, SITTER_RISES);
            if (self.share == 0.0) setMode(self, SITTER_SITS);
            break;
        case SITTER_RISES:
            moveUp(self, STANDS_UP_FOR);
            if (self.share < 1.0 || seen.line_taken || seen.goes_in) break;
            beginToLeave(self, way);
            break;
    }
    state.position = mix(way.place, way.stand, smoothed(self.share));
    state.heading = way.heading;
}

/// What its state says.
void sitAsTold(inout Sitter self, inout AgentState state, BehaviourState doing) {
    self.activity = doing.activity;
    if ((doing.flags & STATE_FOR_GOOD) != 0u && state.arrival_step == NO_INDEX) state.arrival_step = steps_done;
}
