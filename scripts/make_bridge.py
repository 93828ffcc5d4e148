#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes examples/bridge-terrain.glb: a street between pavements, and over it a footbridge with stairs of two flights
at either end and a ramp that turns.

Usage: make_bridge.py
"""
import pathlib

import terrain_glb

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAVEMENT, HALF, DECK = 0.12, 2.66, 5.2   # m: heights
STREET = 6.0                             # m, half of its width
WEST, EAST, SOUTH, NORTH = -32.0, 40.0, -22.0, 22.0
RISERS = 15                              # of a flight, which is 4 m long
SLAB, RAIL, RAIL_HEIGHT = 0.3, 0.08, 1.1


class Mesh:
    def __init__(self):
        self.points, self.corners = [], []

    def face(self, *points):
        """Convex, counter-clockwise from where it is seen."""
        first = len(self.points)
        self.points += points
        for k in range(1, len(points) - 1):
            self.corners += [first, first + k, first + k + 1]

    def solid(self, outline, top, bottom):
        """Between two heights for each corner of an outline, counter-clockwise."""
        upper = [(x, y, z) for (x, y), z in zip(outline, top)]
        lower = [(x, y, z) for (x, y), z in zip(outline, bottom)]
        self.face(*upper)
        self.face(*reversed(lower))
        for k in range(len(outline)):
            n = (k + 1) % len(outline)
            self.face(lower[k], lower[n], upper[n], upper[k])

    def box(self, x0, y0, x1, y1, bottom, top):
        self.solid([(x0, y0), (x1, y0), (x1, y1), (x0, y1)], [top] * 4, [bottom] * 4)

    def slab(self, x0, y0, x1, y1, z):
        self.box(x0, y0, x1, y1, z - SLAB, z)

    def sloping(self, a, b, half_width, low, high, thickness, lift=0.0):
        """From a to b, as wide to either side, rising evenly; its top is `lift` over that."""
        length = ((b[0] - a[0]) ** 2 + (b[1] - a[1]) ** 2) ** 0.5
        across = (-(b[1] - a[1]) / length * half_width, (b[0] - a[0]) / length * half_width)
        outline = [(a[0] - across[0], a[1] - across[1]), (b[0] - across[0], b[1] - across[1]),
                   (b[0] + across[0], b[1] + across[1]), (a[0] + across[0], a[1] + across[1])]
        top = [low + lift, high + lift, high + lift, low + lift]
        self.solid(outline, top, [z - thickness for z in top])

    def rail(self, a, b, low, high=None):
        """A parapet on a line, from below the floor to a hand's height."""
        self.sloping(a, b, 0.5 * RAIL, low, low if high is None else high, RAIL_HEIGHT + 0.2, RAIL_HEIGHT)

    def flight(self, a, b, half_width, low, high):
        """Treads, the last of which is level with the upper floor, and parapets on both sides."""
        length = ((b[0] - a[0]) ** 2 + (b[1] - a[1]) ** 2) ** 0.5
        way, rise = ((b[0] - a[0]) / length, (b[1] - a[1]) / length), (high - low) / RISERS
        at = lambda share: (a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]))
        for k in range(RISERS):
            z = low + (k + 1) * rise
            self.sloping(at(k / RISERS), at((k + 1) / RISERS), half_width, z, z, rise + 0.12)
        for side in (-1.0, 1.0):
            off = (-way[1] * side * half_width, way[0] * side * half_width)
            self.rail((a[0] + off[0], a[1] + off[1]), (b[0] + off[0], b[1] + off[1]), low + rise, high)


def street():
    mesh = Mesh()
    mesh.face((-STREET, SOUTH, 0.0), (STREET, SOUTH, 0.0), (STREET, NORTH, 0.0), (-STREET, NORTH, 0.0))
    for x0, x1, kerb in ((WEST, -STREET, -STREET), (STREET, EAST, STREET)):
        mesh.face((x0, SOUTH, PAVEMENT), (x1, SOUTH, PAVEMENT), (x1, NORTH, PAVEMENT), (x0, NORTH, PAVEMENT))
        low, high = (SOUTH, NORTH) if kerb < 0.0 else (NORTH, SOUTH)
        mesh.face((kerb, low, 0.0), (kerb, high, 0.0), (kerb, high, PAVEMENT), (kerb, low, PAVEMENT))
    return mesh


def bridge():
    mesh = Mesh()
    mesh.slab(-13.0, -2.0, 13.0, 2.0, DECK)
    mesh.rail((-13.0, 2.0), (13.0, 2.0), DECK)
    mesh.rail((-13.0, -2.0), (10.0, -2.0), DECK)
    for x, y0, y1 in ((-13.0, -2.0, -1.5), (-13.0, 1.5, 2.0), (13.0, -2.0, -1.7), (13.0, 0.5, 2.0)):
        mesh.rail((x, y0), (x, y1), DECK)
    # In the west the stairs go on straight.
    mesh.flight((-17.0, 0.0), (-13.0, 0.0), 1.5, HALF, DECK)
    mesh.slab(-20.0, -2.0, -17.0, 2.0, HALF)
    mesh.flight((-24.0, 0.0), (-20.0, 0.0), 1.5, PAVEMENT, HALF)
    for y in (-2.0, 2.0):
        mesh.rail((-20.0, y), (-17.0, y), HALF)
        for x in (-20.0, -17.0):
            mesh.rail((x, y), (x, 0.75 * y), HALF)
    # In the east they turn off.
    mesh.flight((11.5, -6.0), (11.5, -2.0), 1.45, HALF, DECK)
    mesh.slab(10.0, -9.0, 13.0, -6.0, HALF)
    mesh.flight((11.5, -13.0), (11.5, -9.0), 1.45, PAVEMENT, HALF)
    for x in (10.0, 13.0):
        mesh.rail((x, -9.0), (x, -6.0), HALF)
    # The ramp.
    mesh.sloping((13.0, -0.6), (34.6, -0.6), 1.1, DECK, HALF, SLAB)
    mesh.slab(34.6, -2.0, 37.4, 5.0, HALF)
    mesh.sloping((34.6, 3.6), (13.0, 3.6), 1.1, HALF, PAVEMENT, SLAB)
    for y, low in ((-1.7, DECK), (0.5, DECK)):
        mesh.rail((13.0, y), (34.6, y), low, HALF)
    for y in (2.5, 4.7):
        mesh.rail((13.0, y), (34.6, y), PAVEMENT, HALF)
    for a, b in (((34.6, -2.0), (37.4, -2.0)), ((37.4, -2.0), (37.4, 5.0)), ((37.4, 5.0), (34.6, 5.0)),
                 ((34.6, -2.0), (34.6, -1.7)), ((34.6, 0.5), (34.6, 2.5)), ((34.6, 4.7), (34.6, 5.0))):
        mesh.rail(a, b, HALF)
    for x, y, half, z in ((-9.6, 0.0, 1.2, DECK), (9.6, 0.0, 1.2, DECK), (-18.5, 0.0, 1.2, HALF),
                          (11.5, -7.5, 0.9, HALF), (20.0, -0.6, 0.7, 4.3), (27.5, -0.6, 0.7, 3.4),
                          (36.0, 1.5, 1.5, HALF)):
        mesh.box(x - 0.3, y - half, x + 0.3, y + half, 0.0, z - 0.1)
    return mesh


def main():
    parts = [(name, mesh.points, mesh.corners) for name, mesh in (("street", street()), ("bridge", bridge()))]
    terrain_glb.write(ROOT / "examples" / "bridge-terrain.glb", "scripts/make_bridge.py", parts)


main()
