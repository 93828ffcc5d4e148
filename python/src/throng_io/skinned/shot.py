# SPDX-License-Identifier: Apache-2.0
"""The frames and the people of a bake that are written."""
from __future__ import annotations

import dataclasses
import functools
import math

import numpy

from ..bakes.bake import Bake
from ..base.errors import ThrongError
from . import chosen
from .clips import Clip, clips_of
from .ground import Ground
from .members import MOST_MEMBERS, Member, bodies_of_library, cast_of, make_member, repertoire_of


@dataclasses.dataclass(frozen=True)
class Wanted:
    most: int | None = None                     # so many people at most
    near: tuple[float, float] | None = None     # of these those who come nearest to a place of the world
    every: int = 1                              # only every N-th frame
    seconds: tuple[float, float] | None = None  # only from one moment to another one
    members: int = MOST_MEMBERS                 # of so many different people at most

    def check(self) -> None:
        chosen.check(self.most, self.near)
        if self.every < 1:
            raise ThrongError(f"every: expected 1 or more, found {self.every}")
        if self.seconds and not (all(map(math.isfinite, self.seconds)) and 0.0 <= self.seconds[0] < self.seconds[1]):
            raise ThrongError("seconds: expected two moments of the shot, the first before the second, found "
                              f"{self.seconds[0]:g} and {self.seconds[1]:g}")
        if not 1 <= self.members <= MOST_MEMBERS:
            raise ThrongError(f"members: expected 1 to {MOST_MEMBERS}, found {self.members}")


class Shot:
    def __init__(self, bake: Bake, wanted: Wanted):
        wanted.check()
        self.bodies = bodies_of_library()  # first: all else takes its time
        self.bake, self.every = bake, wanted.every
        self.frames = self._frames(wanted.seconds)
        self.there = numpy.array(bake.there(self.frames))
        #: All who are ever there: the nearest first, where a place is told.
        self.nearest = chosen.rows_by_nearness(bake, self.frames, self.there, wanted.near).tolist()
        if wanted.seconds and not self.nearest:
            raise ThrongError(f"nobody is there from {wanted.seconds[0]:g} to {wanted.seconds[1]:g} s")
        #: Those of them who are written.
        self.rows = sorted(self.nearest[:wanted.most])
        self.repertoire = repertoire_of(bake)
        self.roles, self.member_of = cast_of(bake, wanted.members)
        self.sizes = chosen.sizes(bake.people)
        self._made: dict[int, Member] = {}

    def _frames(self, seconds: tuple[float, float] | None) -> numpy.ndarray:
        frames = numpy.arange(self.bake.frames)
        if seconds:
            first, last = (math.ceil(each * self.bake.fps - 1e-6) for each in (seconds[0], min(seconds[1], 1e7)))
            frames = frames[first:last + 1]
            if not len(frames):
                raise ThrongError(f"no frame is from {seconds[0]:g} to {seconds[1]:g} s: "
                                  f"the bake ends at {(self.bake.frames - 1) / self.bake.fps:g} s")
        return frames[::self.every]

    @property
    def seconds(self) -> numpy.ndarray:
        """Of each frame, from the first one."""
        return (self.frames - self.frames[0]) / self.bake.fps

    @property
    def clips(self) -> list[Clip]:
        return clips_of(self.repertoire, self.bake.fps)

    @property
    def members(self) -> list[int]:
        """Numbers of those whom the people who are written appear as."""
        return sorted({self.member_of[row] for row in self.rows})

    @functools.cached_property
    def ground(self) -> Ground | None:
        return Ground.of(self.bake)

    def member(self, number: int) -> Member:
        if number not in self._made:
            self._made[number] = make_member(self.bodies, self.roles[number], self.repertoire)
        return self._made[number]

    def streams(self, rows: list[int]) -> dict[str, numpy.ndarray]:
        return chosen.streams_of(self.bake, self.frames, rows)

    def tint(self, row: int) -> tuple[float, float, float]:
        return chosen.tint(self.bake.people, row, self.roles[self.member_of[row]].look)
