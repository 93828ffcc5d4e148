# SPDX-License-Identifier: Apache-2.0
"""Stands of those who have seats: a step for each row, and the seats."""
import math

from ..cast.sitting import SEAT
from . import materials
from .shapes import Shape, direction

_SHELL = 0.04                      # m, of what seats are made of
_FRONT, _BACK, _TOP = 0.10, 0.33, 0.36  # m: of a seat, before and behind its middle, and of its back over it
_SIDE = 0.44                       # of a seat's width: the rest is between two
_COLOURS = ((0.035, 0.085, 0.20), (0.045, 0.11, 0.26))
_HAIR = 1e-6   # m
_LEDGE = 0.12  # m, before the feet of the first row


def stand_names(geometry):
    """Of the walls that nobody sees: outlines of stands, which keep others out."""
    return {f"{block.get('id', '')} stand" for block in geometry.get("seats", ())}


def build_stands(geometry):
    """An object for each block of seats."""
    return [_build(block) for block in geometry.get("seats", ())]


def _build(block):
    shape = Shape(f"Throng stand {block.get('id', '')}")
    stone = materials.mottled("stand", (0.24, 0.235, 0.225), (0.33, 0.325, 0.31), 1.6)
    shells = [materials.plain(f"seat {number}", colour, 0.45) for number, colour in enumerate(_COLOURS)]
    pitch, rise, width = (float(block[key]) for key in ("pitch", "rise", "width"))
    lowest = min((float(row["height"]) for row in block["rows"]), default=0.0)
    for row in block["rows"]:
        line = [tuple(point[:2]) for point in row["line"]]
        ahead, height = _ahead(line), float(row["height"])
        ledge = _LEDGE if height - lowest < _HAIR else 0.0
        _step(shape, line, ahead, (0.5 * pitch + ledge, 0.5 * pitch), height, stone)
        for number, (place, way) in enumerate(_places(line, width)):
            add_seat(shape, place, way, height, _SIDE * width, shells[number % len(shells)])
    return shape.to_object()


def _ahead(line):
    """Which way each point of a line is offset: to its left, corners mitred."""
    left = [(-along[1], along[0]) for along, _ in (direction(a, b) for a, b in zip(line, line[1:]))]
    found = []
    for before, after in zip([left[0], *left], [*left, left[-1]]):
        x, y = before[0] + after[0], before[1] + after[1]
        size = 0.5 * (x * x + y * y)
        found.append((x / size, y / size))
    return found


def _step(shape, line, ahead, depths, height, stone):
    """From the ground up: what is behind it is higher, and hides the rest. @param depths m, before and behind the
    middle"""
    edge = lambda off: [(x + off * u, y + off * v) for (x, y), (u, v) in zip(line, ahead)]
    front, back = edge(depths[0]), edge(-depths[1])
    for (a, b), (c, d) in zip(zip(front, front[1:]), zip(back, back[1:])):
        shape.face([(*a, height), (*c, height), (*d, height), (*b, height)], stone)
        if height > _HAIR:
            shape.face([(*b, 0.0), (*a, 0.0), (*a, height), (*b, height)], stone)
            shape.face([(*c, 0.0), (*d, 0.0), (*d, height), (*c, height)], stone)
    if height > _HAIR:
        shape.face([(*front[0], 0.0), (*back[0], 0.0), (*back[0], height), (*front[0], height)], stone)
        shape.face([(*back[-1], 0.0), (*front[-1], 0.0), (*front[-1], height), (*back[-1], height)], stone)


def _places(line, width):
    """(place, way along the row) of all seats of a row, in its middle as the bake has them."""
    pieces = [(a, *direction(a, b)) for a, b in zip(line, line[1:])]
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


def add_seat(shape, place, along, height, half, shell):
    """A shell with a back, which leans a little."""
    def at(forward, aside, up):
        return (place[0] + along[0] * aside - along[1] * forward, place[1] + along[1] * aside + along[0] * forward,
                height + up)

    low, top, lean = SEAT - _SHELL, SEAT + _TOP, 0.07
    profile = ((_FRONT, low), (_FRONT, SEAT), (-_BACK, SEAT), (-_BACK - lean, top), (-_BACK - lean - _SHELL, top),
               (-_BACK - _SHELL, low))
    for (x, z), (u, w) in zip(profile, profile[1:] + profile[:1]):
        shape.face([at(x, half, z), at(x, -half, z), at(u, -half, w), at(u, half, w)], shell)
    for side in (1, -1):
        corners = [at(x, side * half, z) for x, z in profile[::side]]
        shape.face([corners[number] for number in range(len(corners))], shell)
