# SPDX-License-Identifier: Apache-2.0
"""Roofs: flat ones with a parapet and what stands on them, and steep ones with dormers and chimneys."""
import math
import random

from . import materials
from .facades import Facade, bays
from .shapes import direction, inside, offset_polygon, signed_area

_SLOPE, _RISE = 1.5, 2.5  # m: how far in and how high a steep roof goes
_LEAST = 60.0             # m^2: smaller houses have flat roofs


def _felt():
    return materials.mottled("roof", (0.075, 0.075, 0.075), (0.13, 0.125, 0.12), 0.8)


def _metal():
    return materials.mottled("roof metal", (0.20, 0.21, 0.215), (0.30, 0.31, 0.31), 1.5, 0.5)


def flat_roof(shape, outline, height, faces, number, _blind=()):
    """A parapet with a coping, felt, and what stands on it. @param faces of the wall and of the coping"""
    wall, coping = faces
    inner, top = offset_polygon(outline, -0.32), height + 0.55
    for a, b, c, d in zip(outline, outline[1:] + outline[:1], inner, inner[1:] + inner[:1]):
        shape.face([(*a, height), (*b, height), (*b, top), (*a, top)], wall)
        shape.face([(*d, height), (*c, height), (*c, top), (*d, top)], wall)
    _ring(shape, offset_polygon(outline, 0.06), offset_polygon(outline, -0.36), top, top + 0.08, coping)
    shape.flat(outline, height, _felt())
    _clutter(shape, offset_polygon(outline, -1.2), height, random.Random(number))


def _ring(shape, outer, inner, low, high, material):
    for a, b, c, d in zip(outer, outer[1:] + outer[:1], inner, inner[1:] + inner[:1]):
        shape.face([(*a, low), (*b, low), (*b, high), (*a, high)], material)
        shape.face([(*a, high), (*b, high), (*d, high), (*c, high)], material)
        shape.face([(*d, low), (*c, low), (*c, high), (*d, high)], material)


def _clutter(shape, room, height, chance):
    """A stair's head, machines, skylights, vents: as many as there is room for."""
    size = signed_area(room)
    if size < 12.0:
        return
    u, _ = direction(room[0], room[1])
    xs, ys = [p[0] for p in room], [p[1] for p in room]
    taken, count = [], min(16, int(size / 22.0) + 2)
    plaster = materials.mottled("roof wall", (0.30, 0.29, 0.27), (0.41, 0.39, 0.36), 1.0)
    glass, dark = materials.glass(), materials.plain("vent", (0.035, 0.035, 0.037), 0.6)
    for turn in range(6 * count):
        kind = ("stair", "machine", "skylight", "vent")[min(len(taken), 1 + len(taken) % 3)]
        half = {"stair": (2.2, 1.5), "machine": (1.1, 0.7), "skylight": (0.8, 0.55), "vent": (0.22, 0.22)}[kind]
        x, y = chance.uniform(min(xs), max(xs)), chance.uniform(min(ys), max(ys))
        ring = _turned((x, y), u, half)
        if len(taken) == count or not all(inside(room, corner) for corner in ring) or any(
                math.dist((x, y), place) < math.hypot(*half) + away + 0.6 for place, away in taken):
            continue
        taken.append(((x, y), math.hypot(*half)))
        if kind == "stair":
            shape.prism(ring, height, height + 2.6, plaster, _felt())
        elif kind == "machine":
            shape.prism(ring, height + 0.25, height + 1.35, _metal())
            for shift in (-0.5, 0.5):
                fan = _turned((x + u[0] * shift, y + u[1] * shift), u, (0.36, 0.36))
                shape.prism(fan, height + 1.35, height + 1.42, dark)
        elif kind == "skylight":
            shape.prism(ring, height, height + 0.35, _metal(), glass)
        else:
            shape.prism(ring, height, height + 0.9, _metal(), dark)


def _turned(middle, u, half):
    return [(middle[0] + u[0] * s * half[0] - u[1] * t * half[1], middle[1] + u[1] * s * half[0] + u[0] * t * half[1])
            for s, t in ((-1, -1), (1, -1), (1, 1), (-1, 1))]


def steep_roof(shape, outline, height, faces, number, blind=()):
    """Slate that goes up steeply to a flat top, with dormers and chimneys; a flat one where there is no room."""
    top, sides = height + _RISE, [direction(a, b)[1] for a, b in zip(outline, outline[1:] + outline[:1])]
    inner = offset_polygon(outline, -_SLOPE)
    if signed_area(outline) < _LEAST or min(sides) < 4.0 * _SLOPE:
        flat_roof(shape, outline, height, faces, number)
        return
    slate = materials.slabs("slate", (0.070, 0.075, 0.085), (0.030, 0.032, 0.036), 0.35)
    eaves = offset_polygon(outline, 0.12)
    for a, b, c, d in zip(eaves, eaves[1:] + eaves[:1], inner, inner[1:] + inner[:1]):
        shape.face([(*a, height), (*b, height), (*d, top), (*c, top)], slate)
    shape.flat(inner, top, _felt())
    _ring(shape, offset_polygon(inner, 0.12), offset_polygon(inner, -0.15), top - 0.08, top + 0.10, _metal())
    for index, (a, b) in enumerate(zip(outline, outline[1:] + outline[:1])):
        side = Facade(shape, a, b, number + 11 * index)
        count, margin = bays(side.size, 2.7, 2.0)
        for bay in () if index in blind else range(index % 2, count, 2):
            _dormer(side, margin + bay * 2.7 + 0.6, height, (bay, 9))
    chance, brick = random.Random(number), materials.mottled("chimney", (0.15, 0.065, 0.045), (0.24, 0.11, 0.08), 3.0)
    u, _ = direction(outline[0], outline[1])
    for a, b in list(zip(inner, inner[1:] + inner[:1]))[:3]:
        share = chance.uniform(0.25, 0.75)
        place = tuple(0.9 * (p + (q - p) * share) + 0.1 * sum(c[axis] for c in inner) / len(inner)
                      for axis, (p, q) in enumerate(zip(a, b)))
        shape.prism(_turned(place, u, (0.75, 0.40)), top - 0.2, top + 1.5, brick)
        for shift in (-0.45, 0.0, 0.45):
            pot = _turned((place[0] + u[0] * shift, place[1] + u[1] * shift), u, (0.13, 0.13))
            shape.prism(pot, top + 1.5, top + 1.95, materials.plain("chimney pot", (0.30, 0.13, 0.075), 0.8))


def _dormer(side, left, height, room):
    """A window in a steep roof, 1.5 m wide."""
    right, low, high = left + 1.5, height + 0.15, height + 2.05
    trim = materials.plain("dormer", (0.50, 0.49, 0.46), 0.7)
    side.box((left, right), (low, high), (-_SLOPE, -0.12), trim)
    side.box((left - 0.1, right + 0.1), (high, high + 0.12), (-_SLOPE, 0.02), _metal())
    side.sashes((left + 0.2, right - 0.2), (low + 0.35, high - 0.12), -0.11,
                materials.plain("white frame", (0.55, 0.54, 0.51), 0.5), ((2, high - 0.18),),
                ("flat", room, (left - 0.6, height - 0.1)))
