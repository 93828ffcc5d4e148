# SPDX-License-Identifier: Apache-2.0
"""Things that move besides people, whatever they are. Metres; a thing's own x is where it looks, and z is up."""
from __future__ import annotations

import dataclasses

import numpy

Faces = list[list[int]]


@dataclasses.dataclass(frozen=True, eq=False)
class Shape:
    """What several may share."""
    name: str
    points: numpy.ndarray      # V x 3
    faces: Faces
    colour: tuple[float, float, float]  # linear


@dataclasses.dataclass(frozen=True, eq=False)
class Part:
    """A shape on a thing. What is None does not change."""
    name: str
    shape: Shape
    places: numpy.ndarray      # 3, or F x 3 of what slides
    rolls: numpy.ndarray | None = None   # F, rad about its own y
    broad: numpy.ndarray | None = None   # F, along its own y: of what folds


@dataclasses.dataclass(frozen=True, eq=False)
class Moving:
    """Of F frames."""
    kind: str                  # "Vehicles", "Lifts" or "Signals"
    name: str
    places: numpy.ndarray      # F x 3
    headings: numpy.ndarray    # F, rad
    there: numpy.ndarray       # F
    parts: list[Part]
