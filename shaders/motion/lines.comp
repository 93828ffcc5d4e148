// SPDX-License-Identifier: Apache-2.0
// Keeps the lines that people wait in: one invocation per line, so that the order does not depend on anything else.
#include "shaders/shared/simulation_types.h"

layout(local_size_x = AGENT_GROUP_SIZE) in;
layout(std430) buffer WaitingLines { WaitingLine waiting_lines[]; };
layout(std430) buffer Tickets { uint tickets[]; };  // rows, by line and number
layout(std430) buffer States { AgentState states[]; };
layout(std430) readonly buffer Stages { Stage stages[]; };
uniform uint line_count;

/// Where a number's row is kept: as many at once as there are people who may wait there.
uint placeOf(WaitingLine line, uint number) { return line.first_ticket + number % line.ticket_count; }

/// Whether whoever is next is no longer there: served, called away, or in another line by now.
bool isGone(WaitingLine line, uint index) {
    AgentState next = states[tickets[placeOf(line, line.served)]];
    return next.ticket != line.served || stages[next.stage].line != index;
}

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= line_count) return;
    WaitingLine line = waiting_lines[index];
    while (line.served < line.given && isGone(line, index))
        ++line.served;
    // One joins per step. Who was called away in this very step does not.
    uint row = line.candidate;
    line.candidate = NO_INDEX;
    if (row != NO_INDEX && line.given - line.served < line.ticket_count && stages[states[row].stage].line == index) {
        tickets[placeOf(line, line.given)] = row;
        states[row].ticket = line.given++;
    }
    waiting_lines[index] = line;
}
