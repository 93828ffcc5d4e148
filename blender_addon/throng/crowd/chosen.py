# SPDX-License-Identifier: Apache-2.0
"""Which of a crowd's people go into a file, as their streams tell: who is there in some frames, and how near they come
to a camera."""
import os
from dataclasses import dataclass

import bpy
import numpy

from ..formats import check_pc2
from . import own
from .queries import absolute, figure

_HEADER = 32  # bytes of a point cache before its numbers
SHARE = 2 ** 22  # numbers that are looked at together
OUT = 1e6        # m, that who is not in the picture counts as further away
_MIDDLE, _MARGIN = 1.0, 1.0  # m: of a person over the ground, and round the picture


class Streams:
    """The streams of a crowd in frames of the scene, from the first to the last."""

    def __init__(self, crowd, first, last):
        self.crowd, self.people = crowd, len(crowd.data.vertices)
        start = int(crowd.modifiers["throng pos"].frame_start)
        frames = self._open("state").shape[0]
        # what is before the first frame and after the last one is shown as these are
        self.frames = numpy.clip(numpy.arange(first, last + 1) - start, 0, frames - 1)

    def _open(self, stream):
        path = absolute(self.crowd, self.crowd.modifiers[f"throng {stream}"].filepath)
        samples = max(1, (os.path.getsize(path) - _HEADER) // (12 * max(1, self.people)))
        check_pc2(path, self.people, samples)
        return numpy.memmap(path, "<f4", "r", _HEADER, (samples, self.people, 3))

    def _pieces(self):
        step = max(1, SHARE // (3 * max(1, self.people)))
        return (self.frames[first:first + step] for first in range(0, len(self.frames), step))

    def presence(self):
        """In how many of the frames everybody is there."""
        state = self._open("state")
        return sum((state[frames, :, 0] > 0.5).sum(axis=0) for frames in self._pieces())

    def anew(self, rows, counts):
        """The sum of what people count for, over the frames in which others are there than in the frame before: then
        all of a mesh is written."""
        state, total, before = self._open("state"), 0, None
        for frames in self._pieces():
            there = state[frames][:, rows, 0] > 0.5
            after = numpy.concatenate([~there[:1] if before is None else before[None], there[:-1]])
            total += int((there[(there != after).any(axis=1)] @ counts).sum())
            before = there[-1]
        return total

    def nearest(self, view):
        """How near everybody comes to a camera, m: those who are in its view for a while before all others; infinity
        for who is never there."""
        state, pos = self._open("state"), self._open("pos")
        found = numpy.full(self.people, numpy.inf)
        for frames in self._pieces():
            away = view.away(pos[frames])
            found = numpy.minimum(found, numpy.where(state[frames, :, 0] > 0.5, away, numpy.inf).min(axis=0))
        return found

    def variations(self):
        return self._open("state")[self.frames[-1], :, 1].astype(int)


@dataclass(frozen=True)
class View:
    """Where a camera looks."""
    place: tuple    # m
    axes: tuple     # its own x, y and z in the world, as rows
    reach: tuple    # half of what it sees at one metre, across and up

    def away(self, places):
        """m, of people (..., 3); more than OUT of those who are not in the picture, with a margin."""
        steps = (places + (0.0, 0.0, _MIDDLE) - self.place) @ numpy.array(self.axes).T
        ahead = -steps[..., 2]
        inside = ahead > 0.0
        for axis in (0, 1):
            inside &= numpy.abs(steps[..., axis]) < ahead * self.reach[axis] + _MARGIN
        return numpy.linalg.norm(steps, axis=-1) + numpy.where(inside, 0.0, OUT)


def rows_of(streams, most, view=None):
    """At most so many of those who are there: the nearest to a camera, or the first ones."""
    there = numpy.nonzero(streams.presence() > 0)[0]
    if view:
        there = there[numpy.argsort(streams.nearest(view)[there], kind="stable")]
    return numpy.sort(there[:most])


def vertices_of(crowd, rows, variations, level):
    """How many vertices the meshes of some people have, at a level of detail."""
    swaps = crowd.data.attributes.get("throng_swap")
    counts, found = {}, numpy.zeros(len(rows), int)
    for place, row in enumerate(rows.tolist()):
        swapped = int(swaps.data[row].value) if swaps else -1
        member = own.member_of(crowd, row, swapped if swapped >= 0 else int(variations[row]), swapped >= 0)
        if member not in counts:
            shown = figure(crowd, member, level) or figure(crowd, member)
            counts[member] = len(shown.data.vertices) if shown else 0
        found[place] = counts[member]
    return found


def mark(name, people, rows, level, bends):
    """A mesh of a point for each of the people, which says who is shown, and how (names.py)."""
    chosen = numpy.zeros(people, bool)
    chosen[rows] = True
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(people)
    for attribute, values in (("hidden", ~chosen), ("near", chosen & bends), ("level", numpy.full(people, level))):
        mesh.attributes.new(attribute, "FLOAT", "POINT").data.foreach_set("value", values.astype(numpy.float32))
    return mesh
