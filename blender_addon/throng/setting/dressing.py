# SPDX-License-Identifier: Apache-2.0
"""What stands in a set, and where: cars along kerbs, trees, benches, bins, bollards and planters. All of it where
nobody of the bake ever walks, and nothing but cars on a road."""
import math
import random
import zlib
from typing import NamedTuple

from . import horizon
from .plane import along_of, area
from .relief import Relief
from .space import Space, crossings


class Thing(NamedTuple):
    kind: str
    x: float
    y: float
    heading: float  # radians
    size: float     # 1 as it comes


# kind: length, width and how near people may come, in metres
CAR, BENCH, BIN, BOLLARD = (4.6, 1.85, 0.9), (1.7, 0.6, 0.6), (0.5, 0.5, 0.5), (0.25, 0.25, 0.45)
PLANTER, TREE, TREE_ON_HILL = (1.5, 0.6, 0.6), (0.9, 0.9, 0.6), (1.5, 1.5, 4.0)
CARS, STREET_TREES = ("hatchback", "saloon", "van"), ("plane tree", "lime tree")
FIELD_TREES = ("oak", "poplar", "bush")
MOST = {"cars": 140, "trees": 160, "furniture": 160, "fields": 260, "hill": 40}
_CROWN = 2.3  # m: from a street's tree to a wall, at least


def dress(geometry, trodden, bounds, name, beyond=(), houses=(), lamps=()):
    """[Thing] of a flat set.

    @param geometry the layout's, in the manifest's form
    @param trodden where people walk
    @param bounds ((x, y), (x, y)) of the layout
    @param name what chance goes by: the same name, the same set
    @param beyond roads that go on where the layout's end
    @param houses corners of houses along those
    @param lamps places that are taken
    """
    chance = random.Random(zlib.crc32(name.encode()))
    whole = dict(geometry, roads=[*geometry.get("roads", []), *beyond],
                 walls=[*geometry.get("walls", []), *({"points": house, "closed": True} for house in houses)])
    space, found = Space(whole, trodden), []
    for x, y in lamps:
        space.take(x, y, 0.0, 0.5, 0.5)
    for piece in space.roads:
        found += _park(space, piece, chance, MOST["cars"] - len(found))
    trees = []
    for piece in space.roads:
        trees += _plant(space, piece, chance, MOST["trees"] - len(trees))
    furniture = []
    for wall in whole["walls"]:
        furniture += _furnish(space, wall, chance, MOST["furniture"] - len(furniture))
    for piece in space.roads:
        furniture += _bollards(space, piece, MOST["furniture"] - len(furniture))
    return found + trees + furniture + _fields(space, bounds, chance)


def dress_country(positions, corners, geometry, trodden, name):
    """[(kind, x, y, heading, size, z)] of trees on and round a terrain; positions and corners are its mesh."""
    chance, ground = random.Random(zlib.crc32(name.encode())), Relief(positions, corners)
    border, _ = horizon.border_of(positions, corners)
    space = Space({key: geometry.get(key, []) for key in ("walls", "roads")}, trodden)
    found = []
    for kind, x, y, heading, size in _scattered(space, ground.bounds, chance):
        z = ground.height(x, y)
        found.append((kind, x, y, heading, size, (horizon.height(border, x, y) if z is None else z) - 0.1))
    return found


def _scattered(space, bounds, chance):
    """Trees in groups over a rectangle and for some way round it, not in front of cameras."""
    (x0, y0), (x1, y1) = bounds
    inner = []
    for _ in range(MOST["hill"]):
        place = (chance.uniform(x0, x1), chance.uniform(y0, y1))
        kind = chance.choices(FIELD_TREES, (1, 0, 5))[0]
        trees = _put(space, kind, place, chance.uniform(0.0, math.tau), TREE_ON_HILL, clearance=3.0)
        inner += [tree._replace(size=chance.uniform(0.4, 0.8)) for tree in trees]
    return inner + _fields(space, bounds, chance, paved=8.0)


def _put(space, kind, place, heading, form, **rules):
    """[Thing], or nothing where there is no room."""
    length, width, margin = form
    if not space.fits(*place, heading, length, width, margin=margin, **rules):
        return []
    space.take(*place, heading, length, width)
    return [Thing(kind, *place, heading, 1.0)]


def _beside(piece, at, out, side):
    """A place beside a piece of a road, and the way along it."""
    (a, b, half), (u, _) = piece, along_of(*piece[:2])
    across = side * (half + out)
    return (a[0] + u[0] * at - u[1] * across, a[1] + u[1] * at + u[0] * across), math.atan2(u[1], u[0])


def _clear(gaps, at, margin):
    return not any(low - margin < at < high + margin for low, high in gaps)


def _park(space, piece, chance, most):
    """Cars along both kerbs, on the road, as they drive on the right; not near crossings."""
    size, half, found = along_of(*piece[:2])[1], piece[2], []
    gaps = crossings(space, piece)
    if half < 3.0:
        return []
    for side in (-1.0, 1.0):
        at = 5.0
        while at < size - 4.0 and len(found) < most:
            place, heading = _beside(piece, at, -0.25 - 0.5 * CAR[1], side)
            turn = heading + (math.pi if side > 0.0 else 0.0) + chance.uniform(-0.02, 0.02)
            kind = chance.choices(CARS, (5, 4, 1))[0]
            if chance.random() < 0.78 and _clear(gaps, at, 9.0):
                found += _put(space, kind, place, turn, CAR, own_road=piece)
            at += chance.uniform(5.6, 6.6)
    return found


def _plant(space, piece, chance, most):
    """Trees along both kerbs where a crown has room."""
    size, found = along_of(*piece[:2])[1], []
    gaps = crossings(space, piece)
    kind = chance.choice(STREET_TREES)
    for side in (-1.0, 1.0):
        at = 4.5
        while at < size - 2.0 and len(found) < most:
            place, _ = _beside(piece, at, 1.0, side)
            if _clear(gaps, at, 4.0):
                trees = _put(space, kind, place, chance.uniform(0.0, math.tau), TREE, clearance=_CROWN)
                found += [tree._replace(size=chance.uniform(0.85, 1.1)) for tree in trees]
            at += chance.uniform(8.5, 10.5)
    return found


def _furnish(space, wall, chance, most):
    """Benches, bins and planters along the walls of houses, backs to them."""
    points = [tuple(p[:2]) for p in wall["points"]]
    if not wall.get("closed") or len(points) < 3:
        return []
    found, turned = [], 1.0 if area(points) > 0.0 else -1.0
    for a, b in zip(points, points[1:] + points[:1]):
        (ux, uy), size = along_of(a, b)
        out = (uy * turned, -ux * turned)
        at, turn = 2.2, 0
        while at < size - 2.0 and len(found) < most:
            kind, form = (("bench", BENCH), ("bin", BIN), ("planter", PLANTER))[turn % 3]
            away = 0.5 * form[1] + 0.25
            place = (a[0] + ux * at + out[0] * away, a[1] + uy * at + out[1] * away)
            found += _put(space, kind, place, math.atan2(out[0], -out[1]), form, clearance=0.2)
            turn, at = turn + 1, at + (1.9 if turn % 3 == 0 else chance.uniform(4.0, 8.0))
    return found


def _bollards(space, piece, most):
    """Rows of bollards at the corners of crossings."""
    found = []
    for low, high in crossings(space, piece):
        for side in (-1.0, 1.0):
            for step in range(4):
                for at in (low - 1.2 - 1.4 * step, high + 1.2 + 1.4 * step):
                    if 0.0 < at < along_of(*piece[:2])[1] and len(found) < most:
                        place, heading = _beside(piece, at, 0.48, side)
                        found += _put(space, "bollard", place, heading, BOLLARD)
    return found


def _fields(space, bounds, chance, paved=36.0, far=420.0):
    """Trees and bushes in groups outside the paved ground, and never in line with a road: cameras look along those."""
    (x0, y0), (x1, y1) = bounds
    middle, found = (0.5 * (x0 + x1), 0.5 * (y0 + y1)), []
    while len(found) < MOST["fields"]:
        turn, out = chance.uniform(0.0, math.tau), paved + (far - paved) * chance.random() ** 1.5
        group = _edge(middle, bounds, turn, out)
        kind = chance.choices(FIELD_TREES, (5, 2, 3))[0]
        for _ in range(chance.randint(2, 9)):
            place = (group[0] + chance.gauss(0.0, 9.0), group[1] + chance.gauss(0.0, 9.0))
            if _outside(place, bounds, paved) and not _seen_along(space, middle, place):
                found += [tree._replace(size=chance.uniform(0.7, 1.25))
                          for tree in _put(space, kind, place, chance.uniform(0.0, math.tau), TREE, clearance=6.0)]
            else:
                found.append(None)  # counts, so that this ends
    return [tree for tree in found if tree]


def _edge(middle, bounds, turn, out):
    """A place outside a rectangle, by so many metres, in a direction."""
    ux, uy = math.cos(turn), math.sin(turn)
    half = tuple(0.5 * (bounds[1][axis] - bounds[0][axis]) for axis in range(2))
    reach = min(half[axis] / abs(u) for axis, u in enumerate((ux, uy)) if abs(u) > 1e-6)
    return middle[0] + ux * (reach + out), middle[1] + uy * (reach + out)


def _outside(place, bounds, by):
    return any(place[axis] < bounds[0][axis] - by or place[axis] > bounds[1][axis] + by for axis in range(2))


def _seen_along(space, middle, place, half=13.0):
    """Whether a place is before a camera that looks along a road, or from the south-west where there are none."""
    ways = [along_of(a, b)[0] for a, b, _ in space.roads]
    ways += [(-x, -y) for x, y in ways]
    dx, dy = place[0] - middle[0], place[1] - middle[1]
    return any(dx * x + dy * y > 0.0 and abs(dx * y - dy * x) < half for x, y in ways or [(-0.6, -0.8)])
