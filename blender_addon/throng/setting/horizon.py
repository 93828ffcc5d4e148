# SPDX-License-Identifier: Apache-2.0
"""The country round a place, out to the horizon."""
import math

from .plane import area

REACH = 6000.0  # m beyond the place's own ground
_RINGS = (0.0, 15.0, 50.0, 130.0, 300.0, 600.0, 1000.0, 1500.0, 2100.0, 2800.0, 3600.0, 4500.0, REACH)
_LEVEL_FROM = 300.0               # m: up to here the ground comes to its mean level
_HILLS_FROM, _HILLS_TO = 700.0, 3600.0
_HIGHEST = 105.0                  # m, about
_HAIR = 1e-6                      # m, or of a share


def rectangle(low, high, pieces=24):
    """A rectangle's outline, counter-clockwise, each side in pieces."""
    (x0, y0), (x1, y1) = low, high
    corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
    return [(a[0] + (b[0] - a[0]) * i / pieces, a[1] + (b[1] - a[1]) * i / pieces)
            for a, b in zip(corners, corners[1:] + corners[:1]) for i in range(pieces)]


def outline(corners, count):
    """The corners round a mesh of triangles, counter-clockwise as the triangles are: the longest way along edges that
    only one of them has. Nothing where there is none.

    @param corners three numbers of corners for each triangle
    @param count how many corners there are
    """
    edges = set()
    for i in range(0, len(corners), 3):
        a, b, c = corners[i:i + 3]
        edges.update(((a, b), (b, c), (c, a)))
    after = {}
    for a, b in edges:
        if (b, a) not in edges:
            after[a] = b
    best, seen = [], set()
    for start in sorted(after):
        way = []
        while start in after and start not in seen:
            seen.add(start)
            way.append(start)
            start = after[start]
        if len(way) > len(best) and len(way) <= count:
            best = way
    return best


def border_of(positions, corners):
    """(border, lid) of a terrain for country(): its outline. Where that is no simple ring round everything, a rectangle
    below all of the edge, with a lid, which lies under the terrain."""
    places = list(zip(positions[0::3], positions[1::3], positions[2::3]))
    ring = [places[i] for i in outline(corners, len(places))]
    low, high = (tuple(pick(p[axis] for p in places) for axis in range(2)) for pick in (min, max))
    whole = (high[0] - low[0]) * (high[1] - low[1])
    if len(ring) > 2 and _is_star(ring) and area(ring) > 0.5 * whole:
        return ring, False
    floor = min(p[2] for p in places) - 0.05
    return [(x, y, floor) for x, y in rectangle(low, high)], True


def _is_star(ring):
    """Whether all of a ring is seen from its middle, counter-clockwise."""
    middle = tuple(sum(p[axis] for p in ring) / len(ring) for axis in range(2))
    return all((a[0] - middle[0]) * (b[1] - middle[1]) - (a[1] - middle[1]) * (b[0] - middle[0]) > 0.0
               for a, b in zip(ring, ring[1:] + ring[:1]))


def hills(x, y):
    """Between 0 and 1: the same country everywhere."""
    value = weight = 0.0
    for length, turn, share in ((2600.0, 0.4, 1.0), (1450.0, 1.9, 0.6), (760.0, 3.3, 0.35), (390.0, 5.1, 0.16)):
        along, across = x * math.cos(turn) + y * math.sin(turn), y * math.cos(turn) - x * math.sin(turn)
        value += share * math.sin(math.tau * along / length + 2.1 * math.sin(math.tau * across / (1.7 * length)))
        weight += share
    return 0.5 + 0.5 * value / weight


def _step(value, low, high):
    t = min(1.0, max(0.0, (value - low) / (high - low)))
    return t * t * (3.0 - 2.0 * t)


def _height(edge, mean, out, x, y):
    """At a place so many metres beyond a border of this height."""
    level = edge + (mean - edge) * _step(out, 0.0, _LEVEL_FROM)
    return level + _HIGHEST * hills(x, y) * _step(out, _HILLS_FROM, _HILLS_TO)


def country(border):
    """Ground from a border outwards: it levels, and there are hills far away. (corners, quads).

    @param border (x, y, z) of a place's edge, counter-clockwise
    """
    count = len(border)
    middle = tuple(sum(p[axis] for p in border) / count for axis in range(3))
    corners, quads = [], []
    for ring, out in enumerate(_RINGS):
        for x, y, z in border:
            away = math.hypot(x - middle[0], y - middle[1]) or 1.0
            stretch = (away + out) / away
            px, py = middle[0] + (x - middle[0]) * stretch, middle[1] + (y - middle[1]) * stretch
            corners.append((px, py, _height(z, middle[2], out, px, py)))
        if ring:
            for i in range(count):
                inner, after = (ring - 1) * count + i, (ring - 1) * count + (i + 1) % count
                quads.append((inner, inner + count, after + count, after))
    return corners, quads


def height(border, x, y):
    """How high country() is at a place outside a border."""
    count = len(border)
    middle = tuple(sum(p[axis] for p in border) / count for axis in range(3))
    dx, dy = x - middle[0], y - middle[1]
    for a, b in zip(border, border[1:] + border[:1]):
        ax, ay, bx, by = a[0] - middle[0], a[1] - middle[1], b[0] - middle[0], b[1] - middle[1]
        turn = ax * by - ay * bx
        s, t = (dx * by - dy * bx) / turn if turn else -1.0, (ax * dy - ay * dx) / turn if turn else -1.0
        if min(s, t) < -_HAIR or s + t <= 0.0:
            continue
        # In the sector between two corners of the border; beyond the border by `out`.
        share = t / (s + t)
        edge = (ax + (bx - ax) * share, ay + (by - ay) * share)
        away = math.hypot(dx, dy)
        out = min(REACH, max(0.0, away - math.hypot(*edge)))
        low = max(ring for ring in _RINGS[:-1] if ring <= out + _HAIR)
        high = _RINGS[_RINGS.index(low) + 1]
        ends = []
        for ring in (low, high):
            stretch = (away - out + ring) / away
            ends.append(_height(a[2] + (b[2] - a[2]) * share, middle[2], ring, middle[0] + dx * stretch,
                                middle[1] + dy * stretch))
        return ends[0] + (ends[1] - ends[0]) * (out - low) / (high - low)
    return middle[2]
