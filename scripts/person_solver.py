# SPDX-License-Identifier: Apache-2.0
"""Whose a pixel is, and how much of it: solves what person_codes.py writes. numpy only, no Blender.

One person or two follow from the pixel alone (Prony's method on the power sums 1, x, x^2, x^3, checked by y and z).
In a pixel of more, they are looked for among those of the pixels around it.
"""
import itertools
import pathlib
import sys

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "blender_addon" / "throng" / "formats"))
from person_codes import person_codes, person_numbers  # noqa: E402

EXACT = 2e-5     # how far a solution's six sums may be off, as a share of the crowd's in that pixel
SMALLEST = 1e-5  # of a pixel: less is nobody
_NEAR = 7        # people tried at each root
_AROUND = (2, 4)  # pixels in which neighbours are looked for
_MOST_CANDIDATES = 9


class _People:
    def __init__(self, names):
        self.codes = numpy.array([sum(person_codes(name), ()) for name in names], numpy.float32).astype(numpy.float64)
        x = numpy.array([person_numbers(name)[0] for name in names])
        self.order = numpy.argsort(x)
        self.sorted = x[self.order]

    def nearest(self, x):
        """The rows of the _NEAR people whose x is nearest, (..., _NEAR)."""
        at = numpy.searchsorted(self.sorted, x)
        picks = at[..., None] + numpy.arange(-_NEAR // 2 + 1, _NEAR // 2 + 1)
        return self.order[numpy.clip(picks, 0, len(self.order) - 1)]


def _fit(codes, sums):
    """Least squares of sums (P, 6) by codes (P, C, 6): (shares (P, C), largest error (P))."""
    normal = codes @ codes.transpose(0, 2, 1) + 1e-15 * numpy.eye(codes.shape[1])
    shares = numpy.linalg.solve(normal, codes @ sums[..., None])[..., 0]
    return shares, abs((shares[..., None] * codes).sum(axis=1) - sums).max(axis=1)


def _keep_better(best, rows, shares, error, smallest=SMALLEST):
    """Of solutions those that fit and are better than what there is. `best` is (rows, shares, error) per pixel."""
    better = (shares.min(axis=1) > smallest) & (error < best[2]) & (error < EXACT)
    count = rows.shape[1]
    best[0][better] = -1
    best[1][better] = 0.0
    best[0][better, :count], best[1][better, :count], best[2][better] = rows[better], shares[better], error[better]


def _alone(people, sums, best):
    for one in numpy.moveaxis(people.nearest(sums[:, 1]), -1, 0):
        shares, error = _fit(people.codes[one][:, None], sums)
        _keep_better(best, one[:, None], shares, error)


def _pairs(people, sums, best):
    """The roots of t^2 - s t + p, whose coefficients the power sums give."""
    one, two, three = sums[:, 1], sums[:, 2], sums[:, 3]
    spread = numpy.maximum(two - one * one, 1e-12)
    s, p = (three - one * two) / spread, (one * three - two * two) / spread
    half = numpy.sqrt(numpy.maximum(0.25 * s * s - p, 0.0))
    lows, highs = (people.nearest(numpy.clip(0.5 * s + sign * half, 0.0, 1.0)) for sign in (-1.0, 1.0))
    for i, j in itertools.product(range(_NEAR), repeat=2):
        rows = numpy.stack([lows[:, i], highs[:, j]], axis=1)
        shares, error = _fit(people.codes[rows], sums)
        error = numpy.where(rows[:, 0] == rows[:, 1], numpy.inf, error)
        _keep_better(best, rows, shares, error)


def _neighbours(found, shares, y, x, reach):
    """Those who have most of the pixels around one."""
    window = numpy.s_[max(0, y - reach):y + reach + 1, max(0, x - reach):x + reach + 1]
    rows, amounts = found[window].ravel(), shares[window].ravel()
    total = numpy.bincount(rows[rows >= 0], amounts[rows >= 0]) if (rows >= 0).any() else numpy.zeros(0)
    order = numpy.argsort(-total, kind="stable")[:_MOST_CANDIDATES]
    return order[total[order] > 0.0]


def _groups(people, sums, candidates):
    """(rows, shares) of three to five of the candidates whose sums these are; None where there are none."""
    for size in range(3, min(5, len(candidates)) + 1):
        rows = candidates[numpy.array(list(itertools.combinations(range(len(candidates)), size)))]
        shares, error = _fit(people.codes[rows], numpy.broadcast_to(sums, (len(rows), 6)))
        error[shares.min(axis=1) <= 1e-4] = numpy.inf
        if error.min() < EXACT:
            return rows[error.argmin()], shares[error.argmin()]
    return None


def _nearest_fit(people, sums, candidates):
    """What comes nearest, by those around: nothing is exact here, but mattes keep no holes."""
    if not len(candidates):
        return None
    one, error = _fit(people.codes[candidates][:, None], numpy.broadcast_to(sums, (len(candidates), 6)))
    return candidates[[error.argmin()]], numpy.ones(1)


def solve(values, names, ranks):
    """Who is in each pixel.

    @param values (H, W, 6), the two passes
    @returns (rows (H, W, ranks), -1 where nobody is; their shares of the pixel; the area, in pixels, of the crowd that
             had to be given to whoever is nearest)
    """
    people, shape = _People(names), values.shape[:2]
    found, shares = numpy.full((*shape, ranks), -1), numpy.zeros((*shape, ranks))
    lost = 0.0
    at = numpy.nonzero(values[..., 0] > SMALLEST)
    cover = values[at][:, 0]
    sums = values[at] / cover[:, None]
    best = (numpy.full((len(cover), ranks), -1), numpy.zeros((len(cover), ranks)), numpy.full(len(cover), numpy.inf))
    _alone(people, sums, best)
    rest = numpy.nonzero(best[2] == numpy.inf)[0]
    part = tuple(each[rest] for each in best)
    _pairs(people, sums[rest], part)
    for each, values_of_rest in zip(best, part):
        each[rest] = values_of_rest
    found[at], shares[at] = best[0], best[1] * cover[:, None]
    for index in numpy.nonzero(best[2] == numpy.inf)[0]:
        y, x = at[0][index], at[1][index]
        around = [_neighbours(found, shares, y, x, reach) for reach in _AROUND]
        group = next(filter(None, (_groups(people, sums[index], each) for each in around)), None)
        if group is None:
            lost += cover[index]
            group = _nearest_fit(people, sums[index], around[-1])
        if group is not None:
            found[y, x, :len(group[0])], shares[y, x, :len(group[0])] = group[0], group[1] * cover[index]
    order = numpy.argsort(-shares, axis=-1, kind="stable")
    return numpy.take_along_axis(found, order, -1), numpy.take_along_axis(shares, order, -1), lost
