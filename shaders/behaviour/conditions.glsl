// SPDX-License-Identifier: Apache-2.0
// What ends a state. A new condition is a constant IF_* (shaders/shared/behaviour_types.h), a case of holds(), and its
// words in the layout (authoring/layout/behaviour_reader.cpp).
// Needs the blocks ParametersBlock, Bodies, BehaviourPoints, Censuses and Tallies, the uniforms now and steps_done, and
// shaders/behaviour/draws.glsl and outlines.glsl.

const float CROWD_RADIUS = 2.0;  // m

/// Somebody who asks whether a condition holds.
struct Asking {
    uint row;
    uint leader;  // the first of its party
    vec2 position;
    Mind mind;
    bool arrived;
    bool is_counted;  // in censuses: who is between rows is in none
};

/// How many people stand no further than this from a place: of some rows, or of all.
uint peopleNear(vec2 position, float reach, uint first_row, uint row_count, uint self) {
    uint found = 0u;
    int rings = int(ceil(reach / parameters.cell_size));
    ivec2 cell = cellOf(position);
    for (int y = max(cell.y - rings, 0); y <= min(cell.y + rings, int(parameters.cells_height) - 1); ++y) {
        uint line = uint(y) * parameters.cells_width;
        uint first = cellStart(line + uint(max(cell.x - rings, 0)));
        uint end = cellStart(line + uint(min(cell.x + rings, int(parameters.cells_width) - 1)) + 1u);
        for (uint slot = first; slot < end; ++slot) {
            uint row = bodies[slot].row;
            if (row != self && row - first_row < row_count && distance(bodies[slot].position, position) <= reach)
                ++found;
        }
    }
    return found;
}

bool isCrowded(Asking who, float density) {
    uint others = peopleNear(who.position, CROWD_RADIUS, 0u, NO_INDEX, who.row);
    return float(others + 1u) > density * 3.14159265358979 * CROWD_RADIUS * CROWD_RADIUS;
}

/// Whether nobody else of the census is inside.
bool isEmpty(Asking who, uint number) {
    Census census = censuses[number];
    bool counted = who.is_counted && who.row - census.first_row < census.row_count &&
                   isInside(who.position, census.first_corner, census.corner_count);
    return tallies[number].inside == (counted ? 1u : 0u);
}

bool isOpen(BehaviourRule rule) {
    bool open = rule.subject != 0u;
    for (uint i = rule.first; i < rule.first + rule.count; ++i)
        if (behaviour_points[i].x <= now) open = !open;
    return open;
}

/// By a signal, which goes round for ever.
bool isGreen(BehaviourRule rule) {
    float into = mod(now + rule.time.mean, rule.number);
    if (into >= rule.number) into -= rule.number;  // as it may come out, where division is not exact
    for (uint i = rule.first; i < rule.first + rule.count; ++i)
        if (into >= behaviour_points[i].x && into < behaviour_points[i].y) return true;
    return false;
}

bool holds(BehaviourRule rule, uint number, Asking who) {
    switch (rule.condition) {
        case IF_AFTER:
            return float(steps_done - who.mind.since) * parameters.step_seconds >=
                   drawnNumber(rule.time, PURPOSE_TIME + number * 256u, who.leader, who.mind.entered);
        case IF_AT: return now >= drawnNumber(rule.time, PURPOSE_TIME + number * 256u, who.leader, 0u);
        case IF_ARRIVED: return who.arrived;
        case IF_NEAR_PLACE: return awayFrom(who.position, rule.first, rule.count) <= rule.number;
        case IF_NEAR_PEOPLE: return peopleNear(who.position, rule.number, rule.first, rule.count, who.row) > 0u;
        case IF_CROWDED: return isCrowded(who, rule.number);
        case IF_CHANCE:
            return chanceOf(PURPOSE_CHANCE + number * 256u, who.leader, steps_done) <
                   1.0 - pow(1.0 - rule.number, parameters.decision_seconds);
        case IF_EMPTY: return isEmpty(who, rule.subject);
        case IF_ALL_HERE: return tallies[rule.subject].inside == tallies[rule.subject].present;
        case IF_OPEN: return isOpen(rule);
        case IF_CLOSED: return !isOpen(rule);
        case IF_GREEN: return isGreen(rule);
        case IF_RED: return !isGreen(rule);
    }
    return false;
}
