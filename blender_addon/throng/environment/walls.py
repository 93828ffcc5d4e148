# SPDX-License-Identifier: Apache-2.0
"""Walls: closed tall ones become buildings, the others walls and barriers with a coping."""
import math
import zlib

from . import materials
from .shapes import Shape, counter_clockwise, direction

STOREY = 3.5        # m
GROUND_FLOOR = 4.3  # m
BAY = 2.7           # m from window to window
BUILDING = 6.0      # m: closed walls at least this high are buildings

_FACADES = [((0.36, 0.24, 0.17), (0.44, 0.31, 0.22)), ((0.42, 0.39, 0.33), (0.52, 0.48, 0.41)), ((0.25, 0.105, 0.075), (0.32, 0.145, 0.105)),
            ((0.30, 0.31, 0.31), (0.38, 0.38, 0.37)), ((0.47, 0.40, 0.28), (0.56, 0.48, 0.35))]
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
        else:
            stone = materials.mottled("stone", (0.26, 0.25, 0.23), (0.36, 0.35, 0.32), 1.2)
            shape.prism(points, 0.0, height, stone)
            shape.band(points, height - 0.12, height + 0.03, 0.06, stone)
    else:
        _open_wall(shape, points, float(wall.get("thickness", 0.2)), height)
    thing = shape.to_object()
    thing.location.z = low
    return thing


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
        _shopfront(shape, a, along, outward, start, pane, frame, awning if (bay + number) % 5 < 3 else None)
        floor = GROUND_FLOOR
        while floor + STOREY <= height - 0.3:
            # A raised surround, a recessed-looking pane with a bar, and a sill.
            shape.panel(a, along, outward, start + 0.62, BAY - 1.24, floor + 0.75, floor + 2.75, 0.020, trim)
            shape.panel(a, along, outward, start + 0.72, BAY - 1.44, floor + 0.85, floor + 2.65, 0.030, frame)
            for half in (0, 1):
                width = 0.5 * (BAY - 1.44) - 0.09
                shape.panel(a, along, outward, start + 0.78 + half * (width + 0.06), width, floor + 0.91, floor + 2.59, 0.036, pane)
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
        shape.face([at(near, 0.75, low), at(near, 0.75, low - 0.18), at(far, 0.75, low - 0.18), at(far, 0.75, low)], awning)


def _ledge(shape, a, along, outward, start, width, low, high, out, material):
    def at(distance, depth):
        return (a[0] + along[0] * distance + outward[0] * depth, a[1] + along[1] * distance + outward[1] * depth)

    shape.prism([at(start, 0.0), at(start, out), at(start + width, out), at(start + width, 0.0)], low, high, material)
