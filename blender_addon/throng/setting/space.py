# SPDX-License-Identifier: Apache-2.0
"""What room there is for the things of a set: not where people walk, not in walls, not in each other."""
import math

import numpy

from .plane import along_of, distance_to, inside

_TAKEN = 0.4  # m, a cell of what is taken


def samples(x, y, heading, length, width, apart=0.3):
    """Points all over a rectangle, its edges included."""
    ux, uy = math.cos(heading), math.sin(heading)
    along, across = (max(1, math.ceil(extent / apart)) for extent in (length, width))
    return [(x + ux * s - uy * t, y + uy * s + ux * t)
            for s in (length * (i / along - 0.5) for i in range(along + 1))
            for t in (width * (j / across - 0.5) for j in range(across + 1))]


class Space:
    """Room round the walls and roads of a layout that people of a bake walk in."""

    def __init__(self, geometry, trodden):
        self.trodden, self.taken = trodden, set()
        self.solids, self.edges, self.roads = [], [], []
        for wall in geometry.get("walls", []):
            points = [tuple(p[:2]) for p in wall["points"]]
            ring = points + points[:1] if wall.get("closed") else points
            half = 0.0 if wall.get("closed") else 0.5 * float(wall.get("thickness", 0.2))
            self.edges += [(a, b, half) for a, b in zip(ring, ring[1:])]
            if wall.get("closed"):
                self.solids.append(points)
        for road in geometry.get("roads", []):
            line = [tuple(p[:2]) for p in road["centreline"]]
            self.roads += [(a, b, 0.5 * float(road["width"])) for a, b in zip(line, line[1:])]
        self._ends = numpy.array([(*a, *b, half) for a, b, half in self.edges], float).reshape(-1, 5)
        self.areas = [[tuple(p[:2]) for p in area["polygon"]] for area in geometry.get("areas", [])]

    def fits(self, x, y, heading, length, width, *, margin, clearance=0.1, own_road=None):
        """Whether a rectangle is free.

        @param margin how near somebody may come, in metres
        @param clearance how near a wall may be
        @param own_road the piece of a road that it may be on
        """
        points = samples(x, y, heading, length, width)
        if any(self._cell(p) in self.taken for p in points):
            return False
        if not self.trodden.free(points, margin):
            return False
        reach = 0.5 * math.hypot(length, width) + clearance
        near = self._edges_within(x, y, reach)
        if any(distance_to(a, b, p) < clearance + half for a, b, half in near for p in points):
            return False
        if any(inside(solid, p) for solid in self.solids for p in (points[0], points[-1], (x, y))):
            return False
        return not any(self.on_road(p, own_road) for p in points)

    def _edges_within(self, x, y, reach):
        """The walls' edges that may be as near to a place; those whose boxes are further are not."""
        ends = self._ends
        apart = numpy.maximum(numpy.minimum(ends[:, :2], ends[:, 2:4]) - (x, y),
                              (x, y) - numpy.maximum(ends[:, :2], ends[:, 2:4]))
        return [self.edges[index] for index in numpy.nonzero((apart <= reach + ends[:, 4:]).all(axis=1))[0]]

    def on_road(self, point, but=None):
        """Whether a place is on a road, or past its end by less than half its width."""
        return any(piece is not but and distance_to(piece[0], piece[1], point) < piece[2] for piece in self.roads)

    def take(self, x, y, heading, length, width):
        self.taken.update(self._cell(p) for p in samples(x, y, heading, length + 0.3, width + 0.3))

    @staticmethod
    def _cell(point):
        return int(point[0] // _TAKEN), int(point[1] // _TAKEN)


def crossings(space, piece):
    """Where other roads cross a piece: [(from, to)] along it, sorted."""
    a, b, _ = piece
    (ux, uy), size = along_of(a, b)
    gaps = []
    for c, d, half in space.roads:
        (vx, vy), other = along_of(c, d)
        turn = ux * vy - uy * vx
        if (c, d) == (a, b) or abs(turn) < 0.2:
            continue
        s = ((c[0] - a[0]) * vy - (c[1] - a[1]) * vx) / turn
        t = ((c[0] - a[0]) * uy - (c[1] - a[1]) * ux) / turn
        if -half <= s <= size + half and -half <= t <= other + half:
            gaps.append((s - half / abs(turn), s + half / abs(turn)))
    return sorted(gaps)
