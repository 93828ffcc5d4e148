// SPDX-License-Identifier: Apache-2.0
// From the plane in which people avoid each other to an aisle, and back.
// Needs the blocks ParametersBlock and Bodies, the uniform steps_done, and shaders/cells/cell_runs.glsl and
// shaders/seats/ways.glsl.

/// Whether somebody has come before its aisle. @param stays further off it does not count as gone
bool isBefore(AgentState state, Mind mind, vec2 foot, bool stays) {
    const float BEFORE = 1.0, STILL_BEFORE = 1.2;  // m
    return state.stage - mind.first_stage <= 1u && distance(state.position, foot) < (stays ? STILL_BEFORE : BEFORE);
}

/// Whether nobody stands between somebody and the block, on the way in.
bool hasClearWay(SeatWay way, vec2 place, float radius) {
    const float TO_BLOCK = 0.75;  // m of the way
    const float SQUEEZES = 0.8;   // of two bodies
    vec2 end = placeOnWay(way, TO_BLOCK, FILE_IN);
    vec2 ahead = end - place;
    ivec2 cell = cellOf(end);
    for (int y = cell.y - 1; y <= cell.y + 1; ++y) {
        uvec2 run = slotRun(cell.x, y);
        for (uint slot = run.x; slot < run.y; ++slot) {
            if (bodies[slot].row == way.row) continue;
            vec2 offset = bodies[slot].position - place;
            float along = clamp(dot(offset, ahead) / dot(ahead, ahead), 0.0, 1.0);
            float apart = radius + bodies[slot].radius;
            if (along > 0.0 && length(offset - along * ahead) < SQUEEZES * apart) return false;
        }
    }
    return true;
}

void stepIn(inout Sitter self, inout AgentState state, SeatWay way) {
    self.mode = SITTER_ENTERS;
    self.since = steps_done;
    self.along = 0.0;
    self.speed = min(length(state.velocity), 0.8);
    self.off = state.position - placeOnWay(way, 0.0, FILE_IN);
    state.status = STATUS_SEATED;
    state.leave_step = 0u;
    state.nervousness = 0.0;
}

/// Whether a body has room in the plane; who has waited for long makes do with less, and others make room.
bool hasRoom(vec2 place, float radius, Sitter self) {
    const float LEAST = 0.85;  // of what it would take
    ivec2 cell = cellOf(place);
    float share = mix(LEAST, 1.0, self.share);
    for (int y = cell.y - 1; y <= cell.y + 1; ++y) {
        uvec2 run = slotRun(cell.x, y);
        for (uint slot = run.x; slot < run.y; ++slot) {
            float apart = radius + bodies[slot].radius;
            if (distance(bodies[slot].position, place) < share * apart) return false;
        }
    }
    return true;
}

void stepOut(inout Sitter self, inout AgentState state, uint first_stage) {
    self.mode = SITTER_WALKS;
    self.seated = NO_INDEX;
    state.status = STATUS_WALKING;
    state.stage = first_stage;
    state.stage_end = first_stage + 2u;
    state.leave_step = 0u;
    state.arrival_step = NO_INDEX;
}
