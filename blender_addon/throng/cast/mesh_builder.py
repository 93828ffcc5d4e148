# SPDX-License-Identifier: Apache-2.0
"""Lofts: rings of points joined into skins, at several levels of detail.

A ring is a flat tuple of nine numbers: its centre and two half axes, of which every point is a sum; the points are
worked out last, and only those that a level of detail keeps. What a figure is made of (its parts, their faces and
materials) is the same in all poses.
"""
import math
from dataclasses import dataclass
from functools import lru_cache

import numpy

# How far (m) a level's skin may be from the full one where it leaves out rings, and how many points its rings have.
TOLERANCES = (0.004, 0.013, 0.045)
_POINTS = ({}, {12: 6, 8: 5, 6: 4}, {12: 5, 10: 4, 8: 3, 6: 3, 4: 3})
_CLOTH_POINTS = (12, 8, 6)  # of what hangs over legs


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def scale(a, f):
    return (a[0] * f, a[1] * f, a[2] * f)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def length(a):
    return math.sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2])


def unit(a):
    size = length(a)
    return scale(a, 1.0 / size) if size > 1e-9 else (0.0, 0.0, 1.0)


def mix(a, b, t):
    return (a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t, a[2] + (b[2] - a[2]) * t)


def turn_z(v, angle):
    c, s = math.cos(angle), math.sin(angle)
    return (v[0] * c - v[1] * s, v[0] * s + v[1] * c, v[2])


def turn_y(v, angle):
    """Positive tips +z towards +x: a forward lean."""
    c, s = math.cos(angle), math.sin(angle)
    return (v[0] * c + v[2] * s, v[1], -v[0] * s + v[2] * c)


def ring(centre, x_axis, y_axis, rx, ry):
    """An ellipse; its loft says how many points it has and how square it is."""
    return (*centre, x_axis[0] * rx, x_axis[1] * rx, x_axis[2] * rx, y_axis[0] * ry, y_axis[1] * ry, y_axis[2] * ry)


def _power(square):
    return 1.0 - 0.45 * min(square, 1.0)


def extent_at(share, square):
    """How far a ring of half axes 1 reaches along one axis, at a share of the other one."""
    return max(0.0, 1.0 - share ** (2.0 / _power(square))) ** (0.5 * _power(square))


@lru_cache(maxsize=None)
def outline(count, square=0.0):
    """The points of a ring of half axes 1: a circle, blended towards a box with round corners; boxes begin at one."""
    power, first = _power(square), 0.5 if square >= 1.0 else 0.0
    if square > 1.0:
        power = 0.25
    points = []
    for i in range(count):
        a = 2.0 * math.pi * (i + first) / count
        c, s = (0.0 if abs(v) < 1e-9 else math.copysign(abs(v) ** power, v) for v in (math.cos(a), math.sin(a)))
        points.append((c, s))
    return tuple(points)


def _area(points):
    return 0.5 * sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(points, points[1:] + points[:1]))


@lru_cache(maxsize=None)
def outline_at(count, square, level, stands=False, drapes=False):
    """That with the points of a level of detail, grown so that it covers the same area: silhouettes stay as wide."""
    if drapes:  # it stays outside of what it covers, which is angular, too
        points = min(count, _CLOTH_POINTS[level])
        # the coarsest, half so
        grown = (math.cos(math.pi / count) / math.cos(math.pi / points)) ** (1.0 if level < 2 else 0.5)
        return tuple((c * grown, s * grown) for c, s in outline(points, square))
    if stands:
        return outline(max(4, _POINTS[level].get(count, count)), square)
    full, fewer = outline(count, square), outline(_POINTS[level].get(count, count), square)
    grown = min(1.25, math.sqrt(_area(full) / _area(fewer)))  # but triangles would stick out
    return tuple((c * grown, s * grown) for c, s in fewer)


@dataclass(frozen=True)
class Part:
    """A loft: so many of the figure's rings from `first` on."""
    first: int
    rings: int
    count: int       # points in a ring
    square: float    # 0 an ellipse, 1 a rounded box, 2 a box
    material: int
    caps: tuple      # whether (start, end) are closed
    until: int       # the last level of detail that has it
    stands: bool     # on the ground: it must not grow into it where it has fewer points
    drapes: bool     # over legs, which must not show through it


class MeshBuilder:
    """The rings of a figure in one pose, and the parts that they are joined to."""

    def __init__(self):
        self.rings = []
        self.parts = []

    def loft(self, rings, material, count, square=0.0, caps=(True, True), until=2, stands=False, drapes=False):
        self.parts.append(Part(len(self.rings), len(rings), count, square, material, caps, until, stands, drapes))
        self.rings += rings

    def limb(self, start, end, profile, material, count=8, flat=1.0, side=(0.0, 1.0, 0.0), caps=(False, False),
             until=2):
        """A tube from start to end; profile is [(share of the length, radius)], `flat` narrows it fore and aft."""
        along = sub(end, start)
        axis = unit(along)
        across = unit(cross(side, axis))
        (ax, ay, az), (bx, by, bz) = across, cross(axis, across)
        (x, y, z), (dx, dy, dz) = start, along
        self.loft([(x + dx * t, y + dy * t, z + dz * t, ax * r * flat, ay * r * flat, az * r * flat, bx * r, by * r,
                    bz * r) for t, r in profile], material, count, caps=caps, until=until)

    def ball(self, centre, radii, material, count=10, levels=6, tilt=0.0, until=2):
        x, up = turn_y((1.0, 0.0, 0.0), tilt), turn_y((0.0, 0.0, radii[2]), tilt)
        rings = []
        for k in range(levels + 1):
            a = math.pi * (k + 0.15) / (levels + 0.3)
            r = math.sin(a)
            rings.append(ring(add(centre, scale(up, -math.cos(a))), x, (0.0, 1.0, 0.0), radii[0] * r, radii[1] * r))
        self.loft(rings, material, count, until=until)

    def box(self, centre, half, yaw, material, taper=1.0, count=8, square=1.0, tilt=0.0):
        """A box with soft edges; `half` are its half sizes, `taper` how much narrower its top is, `tilt` its lean."""
        x, y, up = (turn_z(turn_y(axis, tilt), yaw) for axis in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)))
        self.loft([ring(add(centre, scale(up, half[2] * z)), x, y, half[0] * f, half[1] * f)
                   for z, f in ((-1.0, 0.86), (-0.84, 1.0), (0.80, taper), (1.0, 0.82 * taper))], material, count,
                  square)


def _off(rings, i, j, k):
    """How far ring j is from where the skin between i and k would be."""
    a, b, c = rings[i], rings[j], rings[k]
    along = sub(c, a)
    square = along[0] ** 2 + along[1] ** 2 + along[2] ** 2
    if square > 1e-12:
        t = min(1.0, max(0.0, sum(along[n] * (b[n] - a[n]) for n in range(3)) / square))
    else:
        t = (j - i) / (k - i)
    return max(math.dist(b[n:n + 3], mix(a[n:n + 3], c[n:n + 3], t)) for n in (0, 3, 6))


def _kept(part, samples, tolerance):
    """The rings of a part that a level keeps: without the others no sample's skin is off by more than the tolerance."""
    kept = list(range(part.first, part.first + part.rings))
    while len(kept) > 2 and tolerance > 0.0:
        costs = [max(_off(rings, i, j, k) for rings in samples for j in range(i + 1, k))
                 for i, k in zip(kept, kept[2:])]
        least = min(costs)
        if least > tolerance:
            break
        del kept[costs.index(least) + 1]
    return kept


class Plan:
    """The mesh of a figure at a level of detail, but for where its vertices are: that is the poses' own.

    `samples` are the rings of some poses: what is left out is what none of them needs.
    """

    def __init__(self, parts, samples, level):
        self.faces, self.materials = [], []
        rings, outlines = [], []  # of each vertex
        base = 0
        for part in parts:
            if part.until < level:
                continue
            points = outline_at(part.count, part.square, level, part.stands, part.drapes)
            kept = _kept(part, samples, TOLERANCES[level] * (0.4 if part.stands or part.drapes else 1.0))
            rings += [index for index in kept for _ in points]
            outlines += list(points) * len(kept)
            self._join(base, len(kept), len(points), part)
            base += len(kept) * len(points)
        self.count = base
        self._rings = numpy.array(rings, int)
        self._outlines = numpy.array(outlines, float).reshape(-1, 2)

    def _join(self, base, rings, count, part):
        faces = [(a + i, a + (i + 1) % count, a + count + (i + 1) % count, a + count + i)
                 for a in range(base, base + (rings - 1) * count, count) for i in range(count)]
        if part.caps[0]:
            faces.append(tuple(base + i for i in reversed(range(count))))
        if part.caps[1]:
            faces.append(tuple(base + (rings - 1) * count + i for i in range(count)))
        self.faces += faces
        self.materials += [part.material] * len(faces)

    @property
    def triangles(self):
        return sum(len(face) - 2 for face in self.faces)

    def vertices(self, rings):
        """The vertices of a pose, (V, 3), from its rings."""
        own = numpy.array(rings, float)[self._rings]
        return own[:, :3] + own[:, 3:6] * self._outlines[:, :1] + own[:, 6:] * self._outlines[:, 1:]
