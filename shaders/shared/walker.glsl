// SPDX-License-Identifier: Apache-2.0
// What walkers of only some scenes have a word for, of any scene's.

/// Whether its body is no disc: it strides, and does not press.
bool hasBody(Walker walker) {
#ifdef BODIES
    return walker.half_axis != 0.0;
#else
    return false;
#endif
}

/// s: of free way kept to those walked behind.
float ownHeadwayOf(Walker walker) {
#ifdef HEADWAYS
    return walker.headway;
#else
    return 0.0;
#endif
}

/// The row of the first of those who walk together.
uint partyFirstOf(Walker walker, uint row) {
#ifdef PARTIES
    return walker.party_first;
#else
    return row;
#endif
}

uint partySizeOf(Walker walker) {
#ifdef PARTIES
    return walker.party_size;
#else
    return 1u;
#endif
}

/// Its number in the line that it stands in, or NO_INDEX.
uint ticketOf(Walker walker) {
#ifdef WAITING_LINES
    return walker.ticket;
#else
    return NO_INDEX;
#endif
}
