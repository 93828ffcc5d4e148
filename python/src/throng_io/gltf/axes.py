# SPDX-License-Identifier: Apache-2.0
"""From Throng's axes to glTF's: y is up there. The world's (x, y, z) is (x, z, -y). People look along +x in the cast
and along +z in files, as glTF has it: their own (x, y, z) is (y, z, x)."""
from __future__ import annotations

import numpy

OWN = [1, 2, 0]
QUARTER = 0.5 * numpy.pi  # of a turn: from a heading to the turn about y of who looks along +z


def own(values: numpy.ndarray) -> numpy.ndarray:
    """Of points, normals and moves (..., 3) of somebody's own."""
    return values[..., OWN]


def own_turns(quaternions: numpy.ndarray) -> numpy.ndarray:
    """Of (..., 4): x, y, z, w."""
    return quaternions[..., [*OWN, 3]]


def world(values: numpy.ndarray) -> numpy.ndarray:
    return numpy.stack([values[..., 0], values[..., 2], -values[..., 1]], axis=-1)


def facing(headings: numpy.ndarray) -> numpy.ndarray:
    """(F, 4): turns of people who look along these headings (rad, counter-clockwise from the world's +x)."""
    half = 0.5 * (headings + QUARTER)
    none = numpy.zeros_like(half)
    return numpy.stack([none, numpy.sin(half), none, numpy.cos(half)], axis=-1)
