# SPDX-License-Identifier: Apache-2.0
"""Brows and beards: single hairs from near, which soften what is painted on the face; a thin skin from further away,
where what is painted alone would not be seen."""
from dataclasses import replace

import numpy

from . import levels, regions
from .head import head_of
from .parts import Part, clipped, cut_out, scattered, subdivided

_BROW, _BEARD, _CHIN = 330, 4200, 1500  # hairs


def brows(bodies, shape, level, material, scale, seed):
    if level > 0:
        return []
    piece = cut_out(head_of(bodies, shape, level), regions.box((0.07, -0.07, 0.725), (None, 0.07, 0.775)))
    if level < 0:
        piece = subdivided(piece, 0.2)
    piece = clipped(piece, regions.brow(piece.places))
    if not len(piece.faces):
        return []
    if level < 0:
        draw = numpy.random.default_rng(seed)
        return [_hairs(piece, draw, _BROW, _brow_ways, (0.0085 * scale, 0.0006 * scale, 0.10), material)]
    strands = numpy.stack([piece.places[:, regions.Y] * 40.0 + piece.places[:, regions.Z] * 30.0,
                           piece.places[:, regions.Z] * 4.0], axis=1)
    return [replace(piece.moved(piece.points + piece.normals * 0.0016 * scale), material=material, flat=strands)]


def _brow_ways(places, draw):
    """Upwards at the nose, outwards and down at the temples."""
    along = numpy.clip((numpy.abs(places[:, regions.Y]) - 0.011) / 0.045, 0.0, 1.0)
    out = numpy.sign(places[:, regions.Y]) * (0.35 + 0.65 * along)
    up = 0.85 - 1.15 * along + draw.normal(0.0, 0.16, len(along))
    return numpy.stack([-0.3 * along, out, up], axis=1)


def beard(bodies, shape, level, style, material, scale, seed):
    """A beard: from near, hairs over what is painted on the face; from further away a skin that is thickest at the
    chin. With stubble, nothing: that is painted, too."""
    if style not in ("full", "chin") or level > 1:
        return []
    full = style == "full"
    head = head_of(bodies, shape, level)
    field = regions.beard(head.places, full)
    share = levels.DETAILS[level].hairs
    if share:
        piece = clipped(head, numpy.minimum(field + 0.0015, 1.0))
        if not len(piece.faces):
            return []
        draw, wide = numpy.random.default_rng(seed + 1), 0.0013 * scale / share ** 0.5
        count = int((_BEARD if full else _CHIN) * share)
        return [_hairs(piece, draw, count, _beard_ways, (0.014 * scale, wide, 0.36), material)]
    piece = clipped(head, numpy.minimum(field, 1.0))
    if not len(piece.faces):
        return []
    thick = 0.009 * numpy.clip(regions.beard(piece.places, full) / 0.016, 0.05, 1.0)
    points = piece.points + piece.normals * (thick * scale)[:, None]
    strands = numpy.stack([piece.places[:, regions.Y] * 30.0, piece.places[:, regions.Z] * 5.0], axis=1)
    return [replace(piece.moved(points), material=material, flat=strands)]


def _beard_ways(places, draw):
    """Down, and away from the middle."""
    aside = places[:, regions.Y] * 9.0 + draw.normal(0.0, 0.22, len(places))
    return numpy.stack([draw.normal(0.05, 0.15, len(places)), aside, numpy.full(len(places), -1.0)], axis=1)


def _hairs(piece, draw, count, ways, size, material):
    """Single hairs on a part. @param size (length, width, how far they stand off)"""
    length, width, off = size
    points, normals, weights, places = scattered(piece, draw, count)
    along = ways(places, draw)
    along -= normals * (along * normals).sum(axis=1, keepdims=True)
    along /= numpy.linalg.norm(along, axis=1, keepdims=True) + 1e-9
    aside = numpy.cross(along, normals)
    length = length * draw.uniform(0.6, 1.1, count)[:, None]
    rows = []
    for share, wide, lift in ((0.0, 0.7, 0.0), (0.5, 1.0, 0.8), (1.0, 0.1, 1.0)):
        middle = points + along * length * share + normals * (0.0004 + off * length * lift * (1.3 - share) * 0.8)
        rows += [middle - aside * (0.5 * width * wide), middle + aside * (0.5 * width * wide)]
    spots = numpy.stack(rows, axis=1)
    first = 6 * numpy.arange(count)[:, None]
    faces = [first + corners for corners in ((0, 1, 3), (0, 3, 2), (2, 3, 5), (2, 5, 4))]
    flat = numpy.stack(numpy.broadcast_arrays((draw.random(count) * 9.0)[:, None],
                                              numpy.array([0.3, 0.3, 0.6, 0.6, 1.0, 1.0])), axis=-1)
    return Part(numpy.concatenate(faces), spots.reshape(-1, 3), numpy.repeat(weights, 6, axis=0),
                numpy.repeat(places, 6, axis=0), material, flat=flat.reshape(-1, 2))
