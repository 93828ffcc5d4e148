// SPDX-License-Identifier: Apache-2.0
// Climbing: on stairs people look where they put their feet, and keep room for them. Whoever walks there behind
// somebody has a headway, and does not press on. Without it stairs that are pressed upon take half as many again as
// have been counted on any (IMO MSC.1/Circ.1533; SFPE handbook: 0.3 to 0.6 m/s at 1.65 to 2.6 persons/m^2).

/// s; 0 where nobody climbs.
float headwayOnStairs(uint walker_flags) {
    if (!CLIMBING_ENABLED) return 0.0;
    if ((walker_flags & WALKER_CLIMBS) != 0u) return CLIMBING_UP;
    return (walker_flags & WALKER_DESCENDS) != 0u ? CLIMBING_DOWN : 0.0;
}

bool isOnStairs(uint walker_flags) { return (walker_flags & (WALKER_CLIMBS | WALKER_DESCENDS)) != 0u; }

/// Whether somebody comes the other way to somebody who goes up or down. Where its way leads through tells so only of
/// whom it is not known otherwise: those who have come down often walk back beside the stairs.
bool comesOnStairs(uint flags, vec2 wish, Walker other, vec2 its_wish) {
    if (isOnStairs(other.flags)) return ((flags ^ other.flags) & (WALKER_CLIMBS | WALKER_DESCENDS)) != 0u;
    vec2 through = unpackSnorm2x16(other.way_through);
    return dot(wish, its_wish) < 0.0 && dot(wish, through) < NEAREST_FIRST_ONCOMING * length(wish);
}
