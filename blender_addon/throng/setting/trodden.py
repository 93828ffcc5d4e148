# SPDX-License-Identifier: Apache-2.0
"""Where people of a bake are, ever: a grid that is true wherever somebody's middle was."""
import math

import numpy

_HEADER = 32             # bytes before a stream's samples
_CELL, _MOST_CELLS = 0.25, 4_000_000
_AT_ONCE = 4_000_000     # positions
_EVERY = 0.25            # s: somebody who runs comes 1 m in that time, less than the margins of what is placed


def _distinct(cells):
    """Each cell once. As single numbers: whole rows are sorted ten times as slowly."""
    low = cells.min(axis=0, initial=0)
    width = cells[:, 1].max(initial=0) - low[1] + 1
    keys = numpy.unique((cells[:, 0] - low[0]) * width + cells[:, 1] - low[1])
    return numpy.stack([keys // width, keys % width], axis=1) + low


class Trodden:
    """A grid of cells that somebody was in."""

    def __init__(self, places):
        """@param places (n, 2) metres"""
        places = numpy.asarray(places, float).reshape(-1, 2)
        self._begin(places.min(axis=0), places.max(axis=0)) if len(places) else self._begin((0.0, 0.0), (0.0, 0.0))
        self._tread(places)

    def _begin(self, low, high):
        size = numpy.subtract(high, low) + 1.5
        self.cell = max(_CELL, math.sqrt(float(size[0] * size[1]) / _MOST_CELLS))
        self.low = numpy.asarray(low, float) - 2.5 * self.cell
        self.grid = numpy.zeros([int(extent // self.cell) + 2 for extent in size], bool)
        self._wider = {}

    def _tread(self, places):
        cells = ((places - self.low) / self.cell).astype(int)
        self.grid[cells[:, 0], cells[:, 1]] = True

    @classmethod
    def of_bake(cls, bake):
        """From a bake's streams: all frames where there are few, otherwise four a second."""
        places, states = (numpy.memmap(bake.stream_path(stream), "<f4", "r", _HEADER, (bake.frames, bake.agents, 3))
                          for stream in ("pos", "state"))
        step = 1 if bake.frames * bake.agents <= _AT_ONCE else max(1, int(bake.fps * _EVERY))
        frames = max(1, _AT_ONCE // bake.agents) * step
        found, low, high = cls([]), numpy.full(2, numpy.inf), numpy.full(2, -numpy.inf)
        parts = []
        for first in range(0, bake.frames, frames):
            here = places[first:first + frames:step, :, :2][states[first:first + frames:step, :, 0] > 0.5]
            # cells are few where positions are many
            parts.append((_distinct(numpy.floor(here / _CELL).astype(numpy.int64)) + 0.5) * _CELL)
        everywhere = numpy.concatenate(parts)
        if len(everywhere):
            low, high = everywhere.min(axis=0), everywhere.max(axis=0)
            found._begin(low, high)
            found._tread(everywhere)
        return found

    def _near(self, margin):
        """The grid of where somebody was within a margin, and how many cells it is larger on every side."""
        if margin not in self._wider:
            reach = int(math.ceil(margin / self.cell)) + 1
            wide = numpy.zeros([extent + 2 * reach for extent in self.grid.shape], bool)
            for i in range(-reach, reach + 1):
                for j in range(-reach, reach + 1):
                    # nearest edges of two cells, so that no rounding lets anything too near
                    gap = math.hypot(max(abs(i) - 1, 0), max(abs(j) - 1, 0)) * self.cell
                    if gap <= margin:
                        wide[reach + i:reach + i + self.grid.shape[0],
                             reach + j:reach + j + self.grid.shape[1]] |= self.grid
            self._wider[margin] = wide, reach
        return self._wider[margin]

    def free(self, points, margin):
        """Whether nobody ever comes within a margin of any of some points."""
        wide, reach = self._near(margin)
        cells = numpy.floor((numpy.asarray(points, float) - self.low) / self.cell).astype(int) + reach
        inside = ((cells >= 0) & (cells < wide.shape)).all(axis=1)
        return not wide[cells[inside, 0], cells[inside, 1]].any()
