# SPDX-License-Identifier: Apache-2.0
"""Streets go on where a layout's end: roads, and houses along them where the layout has houses. Nobody walks there."""
import random
import zlib

from .plane import along_of, distance_to, inside

LENGTH = 110.0     # m
HOUSE = 14.0, 12.0  # m along the street, and deep
SIDEWALK = 3.8     # m
TALL = 6.0         # m: closed walls of that height are houses
_FIRST = 7.5       # m from a layout's end to the first house


def free_ends(geometry):
    """[(road, end, the way out of it)] where nothing is ahead for as far as a street goes on."""
    walls = [[tuple(p[:2]) for p in wall["points"]] for wall in geometry.get("walls", [])]
    roads = geometry.get("roads", [])
    found = []
    for road in roads:
        line = [tuple(p[:2]) for p in road["centreline"]]
        if len(line) < 2:
            continue
        for end, before in ((line[0], line[1]), (line[-1], line[-2])):
            (ux, uy), _ = along_of(before, end)
            half = 0.5 * float(road["width"])
            ahead = [(end[0] + ux * s, end[1] + uy * s) for s in range(2, int(LENGTH) + 20, 2)]
            if not any(_blocked(p, half, walls, [r for r in roads if r is not road]) for p in ahead):
                found.append((road, end, (ux, uy)))
    return found


def _blocked(point, half, walls, roads):
    return any(inside(wall, point) or any(distance_to(a, b, point) < half for a, b in zip(wall, wall[1:] + wall[:1]))
               for wall in walls) or \
        any(distance_to(tuple(a[:2]), tuple(b[:2]), point) < half + 0.5 * float(road["width"])
            for road in roads for a, b in zip(road["centreline"], road["centreline"][1:]))


def beyond(geometry):
    """(roads, [(x, y, heading)] of houses): heading is along the street, with the street on the right."""
    roads, houses = [], []
    urban = any(wall.get("closed") and float(wall.get("height", 3.0)) >= TALL for wall in geometry.get("walls", []))
    for number, (road, end, (ux, uy)) in enumerate(free_ends(geometry)):
        far = (end[0] + ux * LENGTH, end[1] + uy * LENGTH)
        name = f"{road.get('id', 'road')} beyond {number}"
        roads.append({"id": name, "centreline": [list(end), list(far)], "width": road["width"],
                      "one_way": road.get("one_way", False)})
        if urban:
            houses += _row(end, (ux, uy), 0.5 * float(road["width"]), zlib.crc32(name.encode()))
    return roads, _apart(houses, geometry, roads)


def _row(end, u, half, seed):
    """Houses on both sides and one across the end, with a lane here and there."""
    chance, found = random.Random(seed), []
    out = half + SIDEWALK + 0.5 * HOUSE[1]
    for side in (-1.0, 1.0):
        at = _FIRST + 0.5 * HOUSE[0]
        while at + 0.5 * HOUSE[0] < LENGTH:
            found.append((end[0] + u[0] * at - u[1] * out * side, end[1] + u[1] * at + u[0] * out * side,
                          (u[0], u[1]) if side > 0.0 else (-u[0], -u[1])))
            at += HOUSE[0] + (5.0 if chance.random() < 0.2 else 0.0)
    across = LENGTH + SIDEWALK + 0.5 * HOUSE[1]
    for shift in (-1.0, 0.0, 1.0):
        found.append((end[0] + u[0] * across - u[1] * shift * HOUSE[0],
                      end[1] + u[1] * across + u[0] * shift * HOUSE[0], (u[1], -u[0])))
    return found


def corners(x, y, u):
    """A house's corners, counter-clockwise."""
    return _places(x, y, u)[:4]


def _places(x, y, u):
    """Its corners, its middle, and the middles of its sides."""
    s, t = 0.5 * HOUSE[0], 0.5 * HOUSE[1]
    return [(x + u[0] * i * s - u[1] * j * t, y + u[1] * i * s + u[0] * j * t)
            for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1), (0, 0), (0, 1), (0, -1), (1, 0), (-1, 0))]


def _apart(houses, geometry, roads):
    """Those that are in no wall, on no road, and not in each other."""
    walls = [[tuple(p[:2]) for p in wall["points"]] for wall in geometry.get("walls", [])]
    kept = []
    for x, y, u in houses:
        points = _places(x, y, u)
        if any(_blocked(p, 1.0, walls, geometry.get("roads", []) + roads) for p in points):
            continue
        ring = points[:4]
        if any(inside(ring, corner) for wall in walls for corner in wall):
            continue
        if any(inside(corners(*other), p) for other in kept for p in _shrunk(points, x, y)):
            continue
        kept.append((x, y, u))
    return kept


def _shrunk(points, x, y):
    return [(x + 0.98 * (px - x), y + 0.98 * (py - y)) for px, py in points]
