# SPDX-License-Identifier: Apache-2.0
"""What moves besides people: vehicles with their wheels and doors, cabins of lifts and the doors of their stops,
signals. Metres; a thing's own x is where it looks, and z is up."""
from __future__ import annotations

import math
from typing import Any

import numpy
import shapely

from ..base.errors import BakeError
from .bake import Bake
from .shapes import Faces, Moving, Part, Shape
from .signals import signals_of
from .surroundings import prism

SIDES = 16                                     # of a wheel
TYRE = 0.04                                    # m, of a bicycle
LEAF, DOOR_LOW, DOOR_TOP = 0.05, 0.3, 2.3      # m: of a vehicle's door thickness, and heights over the ground
CABIN_DOOR, FOLDED = 2.1, 0.92                 # m; of a lift's leaf that is open: leaves behind each other
INSIDE, FLOOR, CEILING = 0.07, 0.012, 2.25     # m: a cabin is less wide than its shaft
COLOURS = {"bus": (0.35, 0.04, 0.03), "tram": (0.58, 0.51, 0.31), "bicycle": (0.05, 0.16, 0.15),
           "car": (0.1, 0.13, 0.17), "glass": (0.01, 0.012, 0.016), "tyre": (0.01, 0.01, 0.01),
           "door": (0.017, 0.02, 0.026), "steel": (0.32, 0.33, 0.34), "lift door": (0.42, 0.43, 0.44)}
_X, _Y, _Z, _HEADING, _SPEED, _ALONG, _STATE, _BRAKING = range(8)
_HEIGHT, _OPEN, _ABOARD, _STOP = range(4)


def moving_things(bake: Bake, frames: numpy.ndarray) -> list[Moving]:
    """All that are ever there in some frames."""
    return [each for each in _vehicles(bake, frames) + _lifts(bake, frames) + signals_of(bake, frames)
            if each.there.any()]


def _track(bake: Bake, name: str, columns: int) -> tuple[numpy.ndarray, list[dict[str, Any]]] | None:
    """(frames x things x columns, what each thing is); None where a bake has none."""
    told = bake.about.get(name)
    if not told or not told.get("list"):
        return None
    path = bake.folder / f"{name}.npy"
    try:
        track = numpy.load(path, mmap_mode="r", allow_pickle=False)
    except (OSError, ValueError) as error:
        raise BakeError(f"{path} cannot be read: {error}", "`throng verify` says what is wrong with a bake") from error
    if track.shape != (bake.frames, len(told["list"]), columns):
        raise BakeError(f"{path}: expected {bake.frames} frames of {len(told['list'])} rows of {columns}, "
                        f"found {track.shape}")
    return track, told["list"]


# ---- vehicles

def _vehicles(bake: Bake, frames: numpy.ndarray) -> list[Moving]:
    found = _track(bake, "vehicles", 8)
    if found is None:
        return []
    track, told = found[0][frames], found[1]
    doors = _track(bake, "doors", 5)
    shapes: dict[tuple, Shape] = {}
    moving = []
    for number, what in enumerate(told):
        rows = track[:, number]
        parts = _body(what, shapes) + _axles(what, rows, shapes)
        if doors is not None:
            parts += _doors(what, doors[1][number], doors[0][frames, number], shapes)
        moving.append(Moving("Vehicles", f"{what['kind']}{number:04d}", rows[:, :3].astype(float),
                             numpy.unwrap(rows[:, _HEADING].astype(float)), rows[:, _STATE] != 0.0, parts))
    return moving


def _shared(shapes: dict[tuple, Shape], key: tuple, make) -> Shape:
    if key not in shapes:
        shapes[key] = make()
    return shapes[key]


def _box(*bounds: float) -> tuple[numpy.ndarray, Faces]:
    """@param bounds x from and to, y, z"""
    x0, x1, y0, y1, z0, z1 = bounds
    return prism(shapely.box(x0, y0, x1, y1), z0, z1)


def _together(pieces: list[tuple[numpy.ndarray, Faces]]) -> tuple[numpy.ndarray, Faces]:
    firsts = numpy.cumsum([0] + [len(points) for points, _ in pieces]).tolist()
    return (numpy.concatenate([points for points, _ in pieces]),
            [[first + corner for corner in face] for first, (_, faces) in zip(firsts, pieces) for face in faces])


def _hull(length: float, width: float, low: float, high: float) -> tuple[numpy.ndarray, Faces]:
    """A box whose ends narrow."""
    x, y, cut = 0.5 * length, 0.5 * width, min(0.25 * width, 0.3)
    return prism(shapely.Polygon([(-x, -y + cut), (-x + cut, -y), (x - cut, -y), (x, -y + cut), (x, y - cut),
                                  (x - cut, y), (-x + cut, y), (-x, y - cut)]), low, high)


def _body(what: dict[str, Any], shapes: dict[tuple, Shape]) -> list[Part]:
    """The body and, as glass, the cabin of a car or a band round larger ones; of a bicycle its frame and a rider."""
    kind, length, width, height = what["kind"], what["length"], what["width"], what["height"]
    size, middle = (kind, length, width, height), numpy.zeros(3)
    if kind == "bicycle":
        solid = [_hull(1.1, 0.06, 0.5, 0.6), _hull(0.36, 0.34, 0.4, 0.95), _hull(0.34, 0.42, 0.95, 1.5),
                 _hull(0.22, 0.2, 1.52, height)]
        return [Part("body", _shared(shapes, size, lambda: Shape(kind, *_together(solid), COLOURS[kind])), middle)]
    is_car = kind == "car"
    body = _shared(shapes, size, lambda: Shape(kind, *_hull(length, width, 0.25, 0.92 if is_car else height),
                                               COLOURS.get(kind, COLOURS["car"])))
    glass = _shared(shapes, (*size, "glass"), lambda: Shape(f"{kind} glass", *(
        _hull(0.56 * length, 0.84 * width, 0.92, height) if is_car
        else _hull(length + 0.02, width + 0.02, 1.15, 0.8 * height)), COLOURS["glass"]))
    return [Part("body", body, middle), Part("glass", glass, middle)]


def _axles(what: dict[str, Any], rows: numpy.ndarray, shapes: dict[tuple, Shape]) -> list[Part]:
    kind, half, radius = what["kind"], 0.5 * what["length"], what["wheel"]
    along = {"tram": (half - 2.9, half - 4.7, 0.9, -0.9, -half + 4.7, -half + 2.9), "bus": (half - 2.65, 3.15 - half),
             "bicycle": (half - radius, radius - half)}.get(kind, (half - 0.85, 0.85 - half))
    outer = 0.5 * what["width"] - 0.02
    spans = [(-0.5 * TYRE, 0.5 * TYRE)] if kind == "bicycle" else [(outer - 0.22, outer), (-outer, 0.22 - outer)]
    axle = _shared(shapes, (kind, radius, outer, "axle"), lambda: Shape(f"{kind} axle", *_together(
        [_wheel(radius, *span) for span in spans]), COLOURS["tyre"]))
    rolls = rows[:, _ALONG].astype(float) / radius
    return [Part(f"axle{number}", axle, numpy.array([x, 0.0, radius]), rolls=rolls) for number, x in enumerate(along)]


def _wheel(radius: float, start: float, end: float) -> tuple[numpy.ndarray, Faces]:
    """Two discs and what is between them, about its own y."""
    angles = 2.0 * math.pi * numpy.arange(SIDES) / SIDES
    rings = [numpy.column_stack([radius * numpy.cos(angles), numpy.full(SIDES, y), radius * numpy.sin(angles)])
             for y in (start, end)]
    sides = [[here, SIDES + here, SIDES + after, after] for here, after in
             ((number, (number + 1) % SIDES) for number in range(SIDES))]
    return numpy.concatenate(rings), [list(range(SIDES)), list(range(2 * SIDES - 1, SIDES - 1, -1)), *sides]


def _doors(what: dict[str, Any], doors: dict[str, Any], rows: numpy.ndarray, shapes: dict[tuple, Shape]) -> list[Part]:
    """Two leaves at each door, which slide apart, and the dark behind them."""
    found = []
    width = doors.get("width", 0.0)
    leaf = _shared(shapes, ("leaf", width), lambda: Shape("door", *_box(
        -0.245 * width, 0.245 * width, -0.5 * LEAF, 0.5 * LEAF, DOOR_LOW, DOOR_TOP), COLOURS["door"]))
    behind_it = _shared(shapes, ("doorway", width), lambda: Shape("doorway", *_box(
        -0.49 * width, 0.49 * width, -0.01, 0.01, DOOR_LOW, DOOR_TOP), COLOURS["tyre"]))
    for column, side, sign in ((0, "left", 1.0), (1, "right", -1.0)):
        for door, behind in enumerate(doors.get("at", ()) if doors.get(side) else ()):
            found.append(Part(f"{side}_doorway{door}", behind_it, numpy.array(
                [0.5 * what["length"] - behind, sign * (0.5 * what["width"] + 0.012), 0.0])))
            for way in (-1.0, 1.0):
                slides = 0.48 * way * width * rows[:, column].astype(float)
                middle = [0.5 * what["length"] - behind + 0.25 * way * width, sign * (0.5 * what["width"] + LEAF), 0.0]
                places = numpy.tile(middle, (len(rows), 1))
                places[:, 0] += slides
                found.append(Part(f"{side}_door{door}_{'front' if way > 0 else 'back'}", leaf, places))
    return found


# ---- lifts

def _lifts(bake: Bake, frames: numpy.ndarray) -> list[Moving]:
    found = _track(bake, "lifts", 4)
    if found is None:
        return []
    track, told = found[0][frames], found[1]
    moving = []
    for number, lift in enumerate(told):
        rows, name = track[:, number].astype(float), str(lift.get("id") or f"lift{number}")
        heading, always = math.radians(lift["doors"]), numpy.ones(len(rows), bool)
        places = numpy.column_stack([numpy.tile(lift["at"][:2], (len(rows), 1)), rows[:, _HEIGHT]])
        moving.append(Moving("Lifts", name, places, numpy.full(len(rows), heading), always,
                             [Part("cabin", _cabin(lift), numpy.zeros(3))]))
        moving += [_landing(f"{name} stop {at}", lift, at, stop, rows) for at, stop in enumerate(lift["stops"])]
    return moving


def _cabin(lift: dict[str, Any]) -> Shape:
    """Floor, ceiling, and walls where there are no doors."""
    x, y = 0.5 * lift["size"][1] - INSIDE, 0.5 * lift["size"][0] - INSIDE
    thick = 0.03
    pieces = [_box(-x, x, -y, y, FLOOR - 0.1, FLOOR), _box(-x, x, -y, y, CEILING, CEILING + 0.1),
              _box(-x, x, -y, thick - y, FLOOR, CEILING), _box(-x, x, y - thick, y, FLOOR, CEILING)]
    if all(stop["doors"] == lift["doors"] for stop in lift["stops"]):
        pieces.append(_box(-x, thick - x, -y, y, FLOOR, CEILING))
    return Shape("cabin", *_together(pieces), COLOURS["steel"])


def _landing(name: str, lift: dict[str, Any], at: int, stop: dict[str, Any], rows: numpy.ndarray) -> Moving:
    """The two leaves at a stop, which open while the cabin is there."""
    half, heading = 0.5 * lift["door_width"], math.radians(stop["doors"])
    is_here = (rows[:, _STOP] == at) & (numpy.abs(rows[:, _HEIGHT] - stop["height"]) < 0.01)
    broad = 1.0 - FOLDED * numpy.where(is_here, rows[:, _OPEN], 0.0)
    out = 0.5 * lift["size"][1]
    place = [lift["at"][0] + out * math.cos(heading), lift["at"][1] + out * math.sin(heading), stop["height"]]
    leaves = []
    for side, word in ((1.0, "left"), (-1.0, "right")):  # from its jamb inwards
        bounds = (-half, 0.0) if side > 0 else (0.0, half)
        shape = Shape(f"lift door {word}", *_box(-0.02, 0.02, *bounds, 0.01, CABIN_DOOR), COLOURS["lift door"])
        leaves.append(Part(f"{word}_leaf", shape, numpy.array([0.0, side * half, 0.0]), broad=broad))
    count = len(rows)
    return Moving("Lifts", name, numpy.tile(place, (count, 1)), numpy.full(count, heading), numpy.ones(count, bool),
                  leaves)
