# SPDX-License-Identifier: Apache-2.0
"""How cloth falls from what it lies on: going down, it comes back to the body no faster than so steep."""
import numpy

_ROUND, _ROWS = 36, 40  # of a grid: directions round the trunk, and heights


class Fall:
    """Of points round an upright axis."""

    def __init__(self, points, middle, steepest):
        """@param middle (x, y) of the axis; @param steepest how far cloth comes back to the body, of how far down"""
        self.middle = middle
        self.low, self.high = points[:, 2].min(), points[:, 2].max() + 1e-6
        row, direction = self._place(points)
        size = numpy.linalg.norm(points[:, :2] - middle, axis=1)
        body = numpy.zeros((_ROWS, _ROUND))
        numpy.maximum.at(body, (numpy.rint(row).astype(int), numpy.rint(direction).astype(int) % _ROUND), size)
        self.body = _filled(body)
        self.cloth = self.body.copy()
        step = (self.high - self.low) / (_ROWS - 1)
        for number in range(_ROWS - 2, -1, -1):
            self.cloth[number] = numpy.maximum(self.cloth[number], self.cloth[number + 1] - steepest * step)
        self.cloth = _soft(self.cloth)

    def _place(self, points):
        """Where on the grid points are."""
        row = (points[:, 2] - self.low) / (self.high - self.low) * (_ROWS - 1)
        angle = numpy.arctan2(points[:, 1] - self.middle[1], points[:, 0] - self.middle[0])
        return row, angle / (2.0 * numpy.pi) * _ROUND

    def moved(self, points, hangs):
        """Points of the body where the cloth is. @param hangs how much of each lies on nothing: 1 between the legs"""
        away = points[:, :2] - self.middle
        size = numpy.linalg.norm(away, axis=1) + 1e-9
        wide = self._at(points, numpy.maximum(self.cloth / self.body, 1.0)) * size
        found = points.copy()
        found[:, :2] = self.middle + away * ((wide + hangs * (self._at(points, self.cloth) - wide)) / size)[:, None]
        return found

    def _at(self, points, grid):
        row, direction = self._place(points)
        first, left = numpy.clip(row.astype(int), 0, _ROWS - 2), numpy.floor(direction).astype(int)
        up, along = (row - first)[:, None], (direction - left)[:, None]
        corner = lambda rows, columns: grid[rows, columns % _ROUND][:, None]
        low = corner(first, left) * (1.0 - along) + corner(first, left + 1) * along
        high = corner(first + 1, left) * (1.0 - along) + corner(first + 1, left + 1) * along
        return (low * (1.0 - up) + high * up)[:, 0]


def _filled(grid):
    """Cells where nothing is take the mean of those round about."""
    while (grid <= 0.0).any():
        around = numpy.stack([numpy.roll(grid, 1, 1), numpy.roll(grid, -1, 1),
                              numpy.concatenate([grid[:1], grid[:-1]]), numpy.concatenate([grid[1:], grid[-1:]])])
        many = (around > 0.0).sum(axis=0)
        grid = numpy.where(grid > 0.0, grid, around.sum(axis=0) / numpy.maximum(many, 1))
    return grid


def _soft(grid, rounds=3):
    for _ in range(rounds):
        grid = 0.5 * grid + 0.25 * (numpy.roll(grid, 1, 1) + numpy.roll(grid, -1, 1))
    return grid
