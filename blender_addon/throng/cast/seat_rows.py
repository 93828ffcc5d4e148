# SPDX-License-Identifier: Apache-2.0
"""Rows of seats as a bake tells them: the step that each stands on, where its seats are, and their shape. Pure
Python."""
import math

from .sitting import SEAT

SHELL = 0.04                       # m, of what seats are made of
_FRONT, _BACK, _TOP = 0.10, 0.33, 0.36  # m: of a seat, before and behind its middle, and of its back over it
_LEAN = 0.07                       # m, of the back
SIDE = 0.44                        # of a seat's width: the rest is between two
HAIR = 1e-6    # m
_LEDGE = 0.12  # m, before the feet of the first row
_INTO_GROUND = 0.3  # m: so far below the lowest ground what stands on a terrain begins


def _direction(a, b):
    """(unit vector, length)."""
    size = math.dist(a, b)
    return ((b[0] - a[0]) / size, (b[1] - a[1]) / size) if size else (1.0, 0.0), size


def _ahead(line):
    """Which way each point of a line is offset: to its left, corners mitred."""
    left = [(-along[1], along[0]) for along, _ in (_direction(a, b) for a, b in zip(line, line[1:]))]
    found = []
    for before, after in zip([left[0], *left], [*left, left[-1]]):
        x, y = before[0] + after[0], before[1] + after[1]
        size = 0.5 * (x * x + y * y)
        found.append((x / size, y / size))
    return found


def step_of(block, row):
    """(front edge, back edge) of what a row of a block stands on: what is behind it is higher, and hides the rest."""
    line, pitch = [tuple(point[:2]) for point in row["line"]], float(block["pitch"])
    lowest = min(float(each["height"]) for each in block["rows"])
    ledge = _LEDGE if float(row["height"]) - lowest < HAIR else 0.0
    return tuple([(x + off * u, y + off * v) for (x, y), (u, v) in zip(line, _ahead(line))]
                 for off in (0.5 * pitch + ledge, -0.5 * pitch))


def heights_of(row):
    """m, of each point of a row's line: those of a level row are the same."""
    return [float(height) for height in row.get("heights") or [row["height"]] * len(row["line"])]


def bottom_of(block, row, slab=None):
    """m, where what a row stands on begins: the ground, or, where people walk under it, so far below."""
    if slab is not None:
        return float(row["height"]) - float(block["rise"]) - slab
    return float(block["ground"]) - _INTO_GROUND if "ground" in block else 0.0


def step_faces(front, back, heights, bottom=0.0):
    """Faces of a step between two edges, from the ground up, or of a slab. @param heights of the edges' points, or one
    for all of them"""
    tops = heights if isinstance(heights, list) else [heights] * len(front)
    for (a, b), (c, d), (h, k) in zip(zip(front, front[1:]), zip(back, back[1:]), zip(tops, tops[1:])):
        yield [(*a, h), (*c, h), (*d, k), (*b, k)]
        if max(h, k) - bottom > HAIR:
            yield [(*b, bottom), (*a, bottom), (*a, h), (*b, k)]
            yield [(*c, bottom), (*d, bottom), (*d, k), (*c, h)]
        if bottom != 0.0:
            yield [(*a, bottom), (*b, bottom), (*d, bottom), (*c, bottom)]
    for a, c, h in ((front[0], back[0], tops[0]), (back[-1], front[-1], tops[-1])):
        if h - bottom > HAIR:
            yield [(*a, bottom), (*c, bottom), (*c, h), (*a, h)]


def treads_of(block, aisle):
    """(front edge, back edge, height) of each step of an aisle, two to a row: the higher one is where one walks into
    the row, the other is half as high over the row before."""
    line, half = [tuple(point[:2]) for point in aisle["line"]], 0.5 * float(aisle["width"])
    pitch, rise, found = float(block["pitch"]), float(block["rise"]), []
    lowest = min(float(row["height"]) for row in block["rows"])
    heights = aisle.get("heights") or [0.0, *(lowest + row * rise for row in range(len(line) - 1))]
    for before, (x, y), below, height in zip(line, line[1:], heights, heights[1:]):
        (u, v), _ = _direction(before, (x, y))
        for begin, end, level in ((-0.65, -0.15, 0.5 * (below + height)), (-0.15, 0.35, height)):
            front, back = ([(x + at * pitch * u + side * half * v, y + at * pitch * v - side * half * u)
                            for side in (-1.0, 1.0)] for at in (begin, end))
            found.append((front, back, level))
    return found


def seats_of(block, row):
    """(place, way along the row, height) of all seats of a row, in its middle as the bake has them."""
    line, width = [tuple(point[:2]) for point in row["line"]], float(block["width"])
    heights = heights_of(row)
    pieces = [(a, *_direction(a, b), low, high) for a, b, low, high in zip(line, line[1:], heights, heights[1:])]
    whole = sum(piece[2] for piece in pieces)
    count = math.floor(whole / width + 1e-6)
    start, passed, found = 0.5 * (whole - count * width) + 0.5 * width, 0.0, []
    for (x, y), along, size, low, high in pieces:
        while len(found) < count and start <= passed + size + 1e-9:
            way = start - passed
            share = way / size if size else 0.0
            found.append(((x + way * along[0], y + way * along[1]), along, low + share * (high - low)))
            start += width
        passed += size
    return found


def seat_faces(place, along, height, half):
    """A shell with a back, which leans a little: its faces, as corners. @param half of its width, m"""
    def at(forward, aside, up):
        return (place[0] + along[0] * aside - along[1] * forward, place[1] + along[1] * aside + along[0] * forward,
                height + up)

    low, top = SEAT - SHELL, SEAT + _TOP
    profile = ((_FRONT, low), (_FRONT, SEAT), (-_BACK, SEAT), (-_BACK - _LEAN, top), (-_BACK - _LEAN - SHELL, top),
               (-_BACK - SHELL, low))
    faces = [[at(x, half, z), at(x, -half, z), at(u, -half, w), at(u, half, w)]
             for (x, z), (u, w) in zip(profile, profile[1:] + profile[:1])]
    return faces + [[at(x, side * half, z) for x, z in profile[::side]] for side in (1, -1)]
