# SPDX-License-Identifier: Apache-2.0
"""Walls: closed tall ones become buildings, the others walls and barriers with a coping."""
import math

import bpy

from ..setting import street_ends
from ..setting.houses import KINDS, kind_of, number_of
from . import materials
from .houses import GROUND_FLOOR, STOREY, build_house
from .keys import key_hidden
from .shapes import Shape, counter_clockwise, direction, offset_polygon, signed_area

BUILDING = 6.0      # m: closed walls at least this high are buildings
BED, LAWN = 1.5, 60.0  # m and m^2: closed walls lower than this round more than this are the rim of a lawn


def build_wall(wall):
    """One wall of the manifest's geometry as an object."""
    points = [tuple(point[:2]) for point in wall["points"]]
    low, high = wall.get("ground", (0.0, 0.0))  # the lowest and the highest ground along it
    height, name = float(wall.get("height", 3.0)) + high - low, wall.get("id", "wall")
    shape = Shape(f"Throng wall {name}")
    if wall.get("closed"):
        if height >= BUILDING:
            build_house(shape, counter_clockwise(points), height, kind_of(points), number_of(points))
        elif height < BED and abs(signed_area(points)) > LAWN:
            _lawn(shape, counter_clockwise(points), height, "pitch" in name)
        else:
            stone = materials.mottled("stone", (0.26, 0.25, 0.23), (0.36, 0.35, 0.32), 1.2)
            shape.prism(points, 0.0, height, stone)
            shape.band(points, height - 0.12, height + 0.03, 0.06, stone)
    else:
        _open_wall(shape, points, float(wall.get("thickness", 0.2)), height)
    thing = shape.to_object()
    thing.location.z = low
    return thing


_RIM = 0.35    # m
# m: half a football pitch's length and width, its circle, the depth and half the width of its boxes
_PITCH = (52.5, 34.0, 9.15, 16.5, 20.16)
_LINE = 0.06   # m, half of a line's width


def _lawn(shape, outline, height, is_pitch):
    """A low wall with grass inside; on a pitch, lines that fit."""
    stone = materials.mottled("stone", (0.26, 0.25, 0.23), (0.36, 0.35, 0.32), 1.2)
    inner, floor = offset_polygon(outline, -_RIM), 0.08
    for i, (a, b) in enumerate(zip(outline, outline[1:] + outline[:1])):
        c, d = inner[i], inner[(i + 1) % len(inner)]
        shape.face([(*a, 0.0), (*b, 0.0), (*b, height), (*a, height)], stone)
        shape.face([(*a, height), (*b, height), (*d, height), (*c, height)], stone)
        shape.face([(*d, floor), (*c, floor), (*c, height), (*d, height)], stone)
    shape.flat(inner, floor, materials.mown("grass", (0.030, 0.075, 0.016), (0.045, 0.105, 0.022), 5.5))
    if is_pitch:
        _pitch_lines(shape, inner, floor + 0.012)


def _pitch_lines(shape, outline, z):
    paint = materials.plain("line", (0.62, 0.63, 0.60), 0.8)
    middle = tuple(sum(p[axis] for p in outline) / len(outline) for axis in (0, 1))
    room = min(math.dist(middle, p) for p in outline) * 0.97
    fit = min(1.0, room / math.hypot(_PITCH[0], _PITCH[1]))
    length, width, circle, depth, box = (fit * value for value in _PITCH)

    def way(points):
        for a, b in zip(points, points[1:]):
            (ux, uy), _ = direction(a, b)
            sx, sy, ex, ey = -uy * _LINE, ux * _LINE, ux * _LINE, uy * _LINE
            shape.flat([(middle[0] + x, middle[1] + y)
                        for x, y in ((a[0] - ex - sx, a[1] - ey - sy), (b[0] + ex - sx, b[1] + ey - sy),
                                     (b[0] + ex + sx, b[1] + ey + sy), (a[0] - ex + sx, a[1] - ey + sy))], z, paint)

    way([(-length, -width), (length, -width), (length, width), (-length, width), (-length, -width)])
    way([(0.0, -width), (0.0, width)])
    way([(circle * math.cos(math.tau * i / 64), circle * math.sin(math.tau * i / 64)) for i in range(65)])
    for side in (-1.0, 1.0):
        way([(side * length, -box), (side * (length - depth), -box), (side * (length - depth), box),
             (side * length, box)])


def key_gate(thing, wall, fps, frame_start):
    """A gate is there while it is closed: its visibility is keyed where events open or close it."""
    gate = wall.get("gate")
    if not gate:
        return
    is_open = bool(gate["open_at_start"])
    for frame in [frame_start] + [frame_start + math.ceil(time * fps) for time in gate["toggles"]]:
        key_hidden(thing, is_open, frame)
        is_open = not is_open


def _open_wall(shape, points, thickness, height):
    half = max(0.5 * thickness, 0.02)
    body = materials.mottled("wall", (0.30, 0.29, 0.27), (0.41, 0.39, 0.36), 1.0)
    coping = materials.mottled("coping", (0.40, 0.39, 0.37), (0.50, 0.49, 0.46), 2.0)
    for a, b in zip(points, points[1:]):
        shape.strip(a, b, half, 0.0, height - 0.08, body)
        shape.strip(a, b, half + 0.04, height - 0.08, height, coping)


HOUSES = 6  # different ones, along streets that go on beyond a layout


def house_mesh(number):
    """One of some houses of street_ends.HOUSE, the street at -y."""
    name = f"Throng house {number}"
    found = bpy.data.meshes.get(name)
    if found:
        return found
    (length, depth), shape = street_ends.HOUSE, Shape(name)
    s, t = 0.5 * length, 0.5 * depth
    build_house(shape, [(-s, -t), (s, -t), (s, t), (-s, t)], GROUND_FLOOR + STOREY * (2 + number // 3 % 2) + 0.6,
                KINDS[number % len(KINDS)], number // 3, blind=(1, 3))
    return shape.to_mesh()
