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
