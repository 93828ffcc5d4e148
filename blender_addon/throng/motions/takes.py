# SPDX-License-Identifier: Apache-2.0
"""A clip of a skeleton as numbers, wherever it comes from. No Blender here."""
from dataclasses import dataclass, replace

import numpy

from ..characters import legs, motion
from . import MotionError

LONGEST = 60.0     # s: of longer clips the first ones are looked at
UNITS = {"m": 1.0, "cm": 0.01, "mm": 0.001, "inches": 0.0254, "feet": 0.3048, "units of the CMU library": 0.0254 / 0.45}
STANDS_ABOUT = (1.3, 2.1)  # m: as tall as people are
HEIGHT = 1.75              # m, of whom no unit makes so tall


@dataclass(frozen=True)
class Take:
    """B bones, parents first, over N frames. Their matrices are in the world, z up from `upright` on."""
    name: str
    names: tuple
    parents: tuple
    rest: numpy.ndarray    # (B, 4, 4)
    ends: numpy.ndarray    # (B, 3) where a bone ends at rest; NaN where nobody knows
    frames: numpy.ndarray  # (N, B, 4, 4)
    rate: float            # frames a second

    def at(self, places):
        """Bones at frames that may lie between whole ones."""
        places = numpy.clip(places, 0.0, len(self.frames) - 1.0)
        low = numpy.minimum(places.astype(int), max(0, len(self.frames) - 2))
        high, share = numpy.minimum(low + 1, len(self.frames) - 1), (places - low)[:, None, None, None]
        return legs.straightened(self.frames[low] * (1.0 - share) + self.frames[high] * share)


def tips_of(take):
    """(V, 3), (V,): joints and ends at rest, and the bone that each goes with."""
    known = numpy.nonzero(numpy.isfinite(take.ends).all(axis=1))[0]
    bones = numpy.concatenate([numpy.arange(len(take.names)), known])
    return numpy.concatenate([take.rest[:, :3, 3], take.ends[known]]), bones


def turned(take, turn):
    """The take with the world turned."""
    whole = numpy.eye(4)
    whole[:3, :3] = turn
    return replace(take, rest=whole @ take.rest, ends=take.ends @ turn.T, frames=whole @ take.frames)


def scaled(take, factor):
    """The take with all lengths so many times as long."""
    size = numpy.ones((4, 4))
    size[:3, 3] = factor  # turns stay
    return replace(take, rest=take.rest * size, ends=take.ends * factor, frames=take.frames * size)


Y_UP = numpy.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])


def upright(take, low, high):
    """The take with z up, where it may have been y. @param low, high bones of which the one is below the other at rest,
    or None: then it was y"""
    if low and high:
        way = take.rest[list(high), :3, 3].mean(axis=0) - take.rest[list(low), :3, 3].mean(axis=0)
        if way[2] > abs(way[1]):
            return take
    return turned(take, Y_UP)


def checked(take):
    """The take, where it can be used at all. Raises MotionError."""
    if len(take.frames) < 2:
        raise MotionError(f"{take.name} has {len(take.frames)} frames: a clip needs at least two")
    bad = numpy.nonzero(~numpy.isfinite(take.frames).all(axis=(1, 2, 3)))[0]
    if len(bad):
        raise MotionError(f"{take.name} has numbers that are none in frame {bad[0]}: export it again")
    if not (numpy.isfinite(take.rest).all() and numpy.isfinite(take.rate) and take.rate > 0.0):
        raise MotionError(f"{take.name} has a rest pose or a frame rate that is no number: export it again")
    most = int(LONGEST * take.rate) + 1
    return replace(take, frames=take.frames[:most]) if len(take.frames) > most else take


def height_of(take):
    """(m of the whole skeleton at rest, the unit that it is in or "")"""
    points, _ = tips_of(take)
    tall = float(numpy.ptp(points[:, 2]))
    if tall < 1e-9:
        raise MotionError(f"{take.name} has a skeleton of no height at rest: it cannot be told where its feet are")
    for unit, metres in UNITS.items():
        if STANDS_ABOUT[0] <= tall * metres <= STANDS_ABOUT[1]:
            return tall * metres, unit
    return HEIGHT, ""


def joints(take, which):
    """(N, 3): the middle of where those bones begin."""
    return motion.joints(take.frames, list(which)).mean(axis=1)
