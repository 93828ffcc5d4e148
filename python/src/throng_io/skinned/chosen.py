# SPDX-License-Identifier: Apache-2.0
"""Who of a bake is written, and what is told of each of them alone: size and colour."""
from __future__ import annotations

import math
import random
import re
from functools import lru_cache

import numpy

from ..bakes.bake import Bake
from ..base.errors import ThrongError
from ..people import palettes
from .legs import FEET, GROUND

MORE = ("carriage", "attention", *FEET, GROUND)  # streams, where a bake has them
LARGEST = 4.0                 # times, that scales of a table may make people larger
_COLOUR = re.compile("#[0-9a-fA-F]{6}")

Place = tuple[float, float]


def check(most: int | None, near: Place | None) -> None:
    if most is not None and most < 1:
        raise ThrongError(f"most: expected 1 or more, found {most}")
    if near and not all(map(math.isfinite, near)):
        raise ThrongError(f"near: expected two numbers, found {near}")


def rows_by_nearness(bake: Bake, frames: numpy.ndarray, there: numpy.ndarray, near: Place | None) -> numpy.ndarray:
    """All who are ever there in these frames; the nearest first, where a place is told, or else by row.

    @param there frames x people
    """
    rows = numpy.nonzero(there.any(axis=0))[0]
    if near:
        away = numpy.linalg.norm(bake.pos[frames][..., :2] - (numpy.array(near) - bake.origin[:2]), axis=2)
        nearest = numpy.where(there, away, math.inf).min(axis=0)
        rows = rows[numpy.argsort(nearest[rows], kind="stable")]
    return rows


def streams_of(bake: Bake, frames: numpy.ndarray, rows: list[int]) -> dict[str, numpy.ndarray]:
    """Those frames of those people, copied once."""
    names = ["pos", "dir", "state", *(name for name in MORE if name in bake.streams)]
    return {name: numpy.array(bake.stream(name)[frames][:, rows], dtype=float) for name in names}


def sizes(people: numpy.ndarray) -> numpy.ndarray:
    told = people["scale"] if "scale" in people.dtype.names else numpy.ones(len(people))
    return numpy.where(numpy.isfinite(told) & (told > 0.0), numpy.minimum(told, LARGEST), 1.0)


def tint(people: numpy.ndarray, row: int, look: str) -> tuple[float, float, float]:
    """The colour of somebody's top, linear: what a table tells, or one of the look's colours, by the row."""
    told = people["tint"][row] if "tint" in people.dtype.names else ""
    if _COLOUR.fullmatch(told):
        return palettes.linear(told)
    choice = palettes.tops(look)
    return choice[int(_draws(len(people))[3 * row] * len(choice))]


@lru_cache(maxsize=2)
def _draws(count: int) -> list[float]:
    """Three numbers of each person's own, as the add-on draws them (crowd/playback.py), so that pictures agree."""
    draw = random.Random(7)
    return [draw.random() for _ in range(3 * count)]
