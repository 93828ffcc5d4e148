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


def treads_of(block, aisle):
    """(front edge, back edge, height) of each step of an aisle, two to a row: the higher one is where one walks into
    the row, the other is half as high over the row before."""
    line, half = [tuple(point[:2]) for point in aisle["line"]], 0.5 * float(aisle["width"])
    pitch, rise = float(block["pitch"]), float(block["rise"])
    height, below, found = min(float(row["height"]) for row in block["rows"]), 0.0, []
    for before, (x, y) in zip(line, line[1:]):
        (u, v), _ = _direction(before, (x, y))
        for begin, end, level in ((-0.65, -0.15, 0.5 * (below + height)), (-0.15, 0.35, height)):
            front, back = ([(x + at * pitch * u + side * half * v, y + at * pitch * v - side * half * u)
                            for side in (-1.0, 1.0)] for at in (begin, end))
            found.append((front, back, level))
        below, height = height, height + rise
    return found


def seats_of(block, row):
    """(place, way along the row) of all seats of a row, in its middle as the bake has them."""
    line, width = [tuple(point[:2]) for point in row["line"]], float(block["width"])
    pieces = [(a, *_direction(a, b)) for a, b in zip(line, line[1:])]
    whole = sum(size for _, _, size in pieces)
    count = math.floor(whole / width + 1e-6)
    start, passed, found = 0.5 * (whole - count * width) + 0.5 * width, 0.0, []
    for (x, y), along, size in pieces:
        while len(found) < count and start <= passed + size + 1e-9:
            way = start - passed
            found.append(((x + way * along[0], y + way * along[1]), along))
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
