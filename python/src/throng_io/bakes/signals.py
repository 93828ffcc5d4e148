# SPDX-License-Identifier: Apache-2.0
"""Signals of a street as things that change: a post at each of their stops, with a red and a green lamp of which one
is there at a time, as the add-on puts them up (blender_addon/throng/environment/traffic.py)."""
from __future__ import annotations

import math
from typing import Any

import numpy
import shapely

from ..base.geometry import way_beside
from .bake import Bake
from .shapes import Moving, Part, Shape
from .surroundings import prism

BESIDE, POLE, TOP = 0.45, 2.3, 3.1             # m: from the lane, and heights
LAMPS = (("red", 2.88, (0.9, 0.03, 0.02)), ("green", 2.52, (0.03, 0.8, 0.25)))
LAMP, SIDES, DARK = 0.09, 14, (0.03, 0.035, 0.03)


def signals_of(bake: Bake, frames: numpy.ndarray) -> list[Moving]:
    traffic = bake.about["geometry"].get("traffic") or {}
    signals = {signal["id"]: signal for signal in traffic.get("signals", ())}
    post, lamps = _post(), [_lamp(*lamp) for lamp in LAMPS]
    found = []
    for lane in traffic.get("lanes", ()):
        for stop in lane.get("stops", ()):
            if stop.get("signal") in signals:
                green = _green(signals[stop["signal"]], lane["id"], frames / bake.fps)
                found.append(_at(bake, f"{stop['signal']} {lane['id']}", lane, stop, green, post, lamps))
    return found


def _green(signal: dict[str, Any], lane: str, times: numpy.ndarray) -> numpy.ndarray:
    """F: whether vehicles of the lane may go."""
    ends = numpy.cumsum([phase["seconds"] for phase in signal["phases"]])
    place = (times + float(signal.get("offset", 0.0))) % ends[-1]
    phase = numpy.minimum(numpy.searchsorted(ends, place, side="right"), len(ends) - 1)
    return numpy.array([lane in each["lanes"] for each in signal["phases"]])[phase]


def _at(bake: Bake, name: str, lane: dict, stop: dict, green: numpy.ndarray, post: Shape, lamps: list[Shape]) -> Moving:
    """To the right of the lane; lamps look at who comes. A lamp that is off has no breadth."""
    place, (x, y) = way_beside(lane["points"], stop["at"])
    beside = 0.5 * float(lane["width"]) + BESIDE
    at = numpy.array([place[0] + y * beside, place[1] - x * beside, 0.0]) - bake.origin
    shown = [Part(lamp.name, lamp, numpy.zeros(3), broad=on.astype(float)) for lamp, on in zip(lamps, (~green, green))]
    count = len(green)
    return Moving("Signals", name, numpy.tile(at, (count, 1)), numpy.full(count, math.atan2(y, x)),
                  numpy.ones(count, bool), [Part("post", post, numpy.zeros(3)), *shown])


def _post() -> Shape:
    pole, box = prism(shapely.Point(0.0, 0.0).buffer(0.05, quad_segs=3), 0.0, POLE), prism(
        shapely.box(-0.06, -0.14, 0.14, 0.14), POLE, TOP)
    first = len(pole[0])
    return Shape("signal post", numpy.concatenate([pole[0], box[0]]),
                 pole[1] + [[first + corner for corner in face] for face in box[1]], DARK)


def _lamp(name: str, height: float, colour: tuple[float, float, float]) -> Shape:
    """A disc that looks back along the lane."""
    angles = -2.0 * math.pi * numpy.arange(SIDES) / SIDES
    points = numpy.column_stack([numpy.full(SIDES, -0.066), LAMP * numpy.cos(angles),
                                 height + LAMP * numpy.sin(angles)])
    return Shape(f"{name}_lamp", points, [list(range(SIDES))], colour)
