# SPDX-License-Identifier: Apache-2.0
"""Walls: closed tall ones become buildings, the others walls and barriers with a coping."""
import math
import zlib

import bpy

from ..setting import street_ends
from . import materials
from .shapes import Shape, counter_clockwise, direction, offset_polygon, signed_area

STOREY = 3.5        # m
GROUND_FLOOR = 4.3  # m
BAY = 2.7           # m from window to window
BUILDING = 6.0      # m: closed walls at least this high are buildings
BED, LAWN = 1.5, 60.0  # m and m^2: closed walls lower than this round more than this are the rim of a lawn

_FACADES = [((0.36, 0.24, 0.17), (0.44, 0.31, 0.22)), ((0.42, 0.39, 0.33), (0.52, 0.48, 0.41)),
            ((0.25, 0.105, 0.075), (0.32, 0.145, 0.105)), ((0.30, 0.31, 0.31), (0.38, 0.38, 0.37)),
            ((0.47, 0.40, 0.28), (0.56, 0.48, 0.35))]
_AWNINGS = [(0.20, 0.030, 0.030), (0.030, 0.085, 0.065), (0.040, 0.060, 0.130), (0.32, 0.25, 0.13)]


def _number(text):
    return zlib.crc32(text.encode())


def build_wall(wall):
    """One wall of the manifest's geometry as an object."""
    points = [tuple(point[:2]) for point in wall["points"]]
    low, high = wall.get("ground", (0.0, 0.0))  # the lowest and the highest ground along it
    height, name = float(wall.get("height", 3.0)) + high - low, wall.get("id", "wall")
    shape = Shape(f"Throng wall {name}")
    if wall.get("closed"):
        if height >= BUILDING:
            _building(shape, counter_clockwise(points), height, _number(name))
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
        for path in ("hide_viewport", "hide_render"):
            setattr(thing, path, is_open)
            thing.keyframe_insert(path, frame=frame)
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
    _building(shape, [(-s, -t), (s, -t), (s, t), (-s, t)], GROUND_FLOOR + STOREY * (2 + number % 3) + 0.6, number)
    return shape.to_mesh()


def _building(shape, outline, height, number):
    dark, light = _FACADES[number % len(_FACADES)]
    facade = materials.mottled(f"facade {number % len(_FACADES)}", dark, light, 0.35, 0.9, 9.0)
    trim = materials.mottled("trim", (0.44, 0.42, 0.38), (0.55, 0.53, 0.48), 1.5)
    roof = materials.mottled("roof", (0.075, 0.075, 0.075), (0.13, 0.125, 0.12), 0.8)
    shape.prism(outline, 0.0, height, facade, roof)
    shape.band(outline, 0.0, 0.55, 0.05, trim)
    shape.band(outline, GROUND_FLOOR - 0.25, GROUND_FLOOR + 0.10, 0.14, trim)
    shape.band(outline, height - 0.45, height + 0.25, 0.22, trim)
    for index, (a, b) in enumerate(zip(outline, outline[1:] + outline[:1])):
        _facade(shape, a, b, height, trim, number + 7 * index)


def _facade(shape, a, b, height, trim, number):
    along, size = direction(a, b)
    outward = (along[1], -along[0])
    bays = int((size - 1.2) / BAY)
    if bays < 1:
        return
    margin = 0.5 * (size - bays * BAY)
    pane = materials.glass()
    frame = materials.plain("window frame", (0.06, 0.058, 0.055), 0.5)
    awning = materials.plain(f"awning {number % len(_AWNINGS)}", _AWNINGS[number % len(_AWNINGS)], 0.8)
    for bay in range(bays):
        start = margin + bay * BAY
        if (bay + number) % 5 == 4 or bays == 1:
            _door(shape, a, along, outward, start, number + bay, pane, frame, trim)
        else:
            _shopfront(shape, a, along, outward, start, pane, frame, awning if (bay + number) % 5 < 3 else None)
        floor = GROUND_FLOOR
        while floor + STOREY <= height - 0.3:
            # A raised surround, a recessed-looking pane with a bar, and a sill.
            shape.panel(a, along, outward, start + 0.62, BAY - 1.24, floor + 0.75, floor + 2.75, 0.020, trim)
            shape.panel(a, along, outward, start + 0.72, BAY - 1.44, floor + 0.85, floor + 2.65, 0.030, frame)
            for half in (0, 1):
                width = 0.5 * (BAY - 1.44) - 0.09
                shape.panel(a, along, outward, start + 0.78 + half * (width + 0.06), width, floor + 0.91, floor + 2.59,
                            0.036, pane)
            _ledge(shape, a, along, outward, start + 0.52, BAY - 1.04, floor + 0.62, floor + 0.76, 0.14, trim)
            floor += STOREY


def _shopfront(shape, a, along, outward, start, pane, frame, awning):
    shape.panel(a, along, outward, start + 0.16, BAY - 0.32, 0.56, GROUND_FLOOR - 0.75, 0.055, frame)
    shape.panel(a, along, outward, start + 0.24, BAY - 0.48, 0.66, GROUND_FLOOR - 1.35, 0.062, pane)
    shape.panel(a, along, outward, start + 0.24, BAY - 0.48, GROUND_FLOOR - 1.27, GROUND_FLOOR - 0.83, 0.062, pane)
    if awning:
        def at(distance, out, z):
            return (a[0] + along[0] * distance + outward[0] * out, a[1] + along[1] * distance + outward[1] * out, z)

        near, far, high, low = start + 0.1, start + BAY - 0.1, GROUND_FLOOR - 0.55, GROUND_FLOOR - 1.05
        shape.face([at(near, 0.06, high), at(near, 0.75, low), at(far, 0.75, low), at(far, 0.06, high)], awning)
        shape.face([at(near, 0.75, low), at(near, 0.75, low - 0.18), at(far, 0.75, low - 0.18), at(far, 0.75, low)],
                   awning)


_DOORS = [(0.055, 0.012, 0.010), (0.010, 0.035, 0.026), (0.012, 0.020, 0.050), (0.085, 0.048, 0.024)]


def _door(shape, a, along, outward, start, number, pane, frame, trim):
    """A house's door: a surround, two leaves with panels and handles, a light above, a step."""
    def panel(shift, width, low, high, out, material):
        shape.panel(a, along, outward, start + 0.5 * BAY + shift - 0.5 * width, width, low, high, out, material)

    leaf = materials.plain(f"door {number % len(_DOORS)}", _DOORS[number % len(_DOORS)], 0.35)
    inset = materials.plain(f"door panel {number % len(_DOORS)}", tuple(0.55 * c for c in _DOORS[number % len(_DOORS)]),
                            0.45)
    brass = materials.plain("brass", (0.45, 0.30, 0.10), 0.3)
    panel(0.0, 1.90, 0.10, 3.30, 0.060, trim)
    panel(0.0, 1.50, 0.15, 3.10, 0.066, frame)
    panel(0.0, 1.38, 2.45, 3.02, 0.072, pane)
    for side in (-1.0, 1.0):
        panel(side * 0.35, 0.67, 0.16, 2.36, 0.076, leaf)
        for low, high in ((0.34, 0.98), (1.14, 2.20)):
            panel(side * 0.35, 0.44, low, high, 0.082, inset)
        panel(side * 0.06, 0.03, 1.00, 1.16, 0.120, brass)
    _ledge(shape, a, along, outward, start + 0.5 * BAY - 1.0, 2.0, 0.0, 0.14, 0.18, trim)


def _ledge(shape, a, along, outward, start, width, low, high, out, material):
    def at(distance, depth):
        return (a[0] + along[0] * distance + outward[0] * depth, a[1] + along[1] * distance + outward[1] * depth)

    shape.prism([at(start, 0.0), at(start, out), at(start + width, out), at(start + width, 0.0)], low, high, material)
