// SPDX-License-Identifier: Apache-2.0
// From one person to another as they are in home coordinates, wherever their charts lie in the plane. There are no wide
// sites among charts: `rest` has the shift of the chart that somebody is on (cross_seams.comp).
// Needs the block States.

/// m, to the person in row `other`. @param position that of the person in row `self`
vec2 wayTo(uint other, uint self, vec2 position) {
    vec2 way = states[other].position - position;
#ifdef CHARTS
    way -= states[other].rest - states[self].rest;
#endif
    return way;
}
