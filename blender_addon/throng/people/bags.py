# SPDX-License-Identifier: Apache-2.0
"""What people carry: a rucksack, a bag on a strap, a shopper over the shoulder. Straps are laid on the clothes."""
from dataclasses import replace

import numpy

from . import levels, regions
from .head import bound_to, loose
from .parts import clipped, folded


def _box(bodies, centre, half, bone, material, level, round_=0.55):
    """A box with soft edges."""
    steps = {levels.NEAR: 9, 0: 4, 1: 3, 2: 2}[level]
    line = numpy.linspace(-1.0, 1.0, steps)
    points, faces = [], []
    for axis in range(3):
        for sign in (-1.0, 1.0):
            first, (a, b) = len(points), [other for other in range(3) if other != axis]
            for u in line:
                for v in line:
                    spot = numpy.zeros(3)
                    spot[axis], spot[a], spot[b] = sign, u, v
                    ball = spot / numpy.linalg.norm(spot) * 1.25
                    points.append(numpy.asarray(centre) + (spot * (1.0 - round_) + ball * round_) * half)
            for row in range(steps - 1):
                for column in range(steps - 1):
                    corner = first + row * steps + column
                    faces += [(corner, corner + 1, corner + steps + 1), (corner, corner + steps + 1, corner + steps)]
    points, faces = numpy.array(points), numpy.array(faces)
    a, b, c = (points[faces[:, corner]] for corner in range(3))
    inwards = (numpy.cross(b - a, c - a) * (a - centre)).sum(axis=1) < 0.0
    faces[inwards] = faces[inwards][:, ::-1]
    return loose(bodies, points, faces, bone, material)


def _strap(part, field, material, scale, lift=0.006):
    piece = clipped(replace(part, tags=numpy.zeros(len(part.points), int)), field)
    if not len(piece.faces):
        return []
    piece = replace(piece.moved(piece.points + piece.normals * lift * scale), material=material)
    return [folded(piece, 1.3 * lift * scale)]


def bag(bodies, kind, tops, rig, level):
    """@param tops the parts of what is worn uppermost"""
    if not kind:
        return []
    scale, body = rig.scale, numpy.concatenate([top.points for top in tops])
    spine, hips = rig.heads["spine_03"], rig.heads["pelvis"]
    found = []
    if kind == "rucksack":
        middle = numpy.abs(body[:, 1]) < 0.09
        back = body[middle & (numpy.abs(body[:, 2] - spine[2]) < 0.10 * scale), 0].min()
        centre = (back - 0.052 * scale, 0.0, spine[2] - 0.02 * scale)
        found.append(_box(bodies, centre, numpy.array([0.062, 0.125, 0.19]) * scale, "spine_03", "extra pack", level))
        pocket = (centre[0] - 0.060 * scale, 0.0, centre[2] - 0.07 * scale)
        if level < 1:
            found.append(_box(bodies, pocket, numpy.array([0.028, 0.095, 0.085]) * scale, "spine_03", "extra pack",
                              level))
        for top in tops if level < 2 else ():
            places = top.places
            out, up = numpy.abs(places[:, regions.Y]), places[:, regions.Z]
            aside = numpy.minimum(0.017 - numpy.abs(out - 0.098), up - 0.325)
            under = numpy.minimum(numpy.minimum(0.014 - numpy.abs(up - 0.335), out - 0.085), 0.25 - out)  # the arm
            found += _strap(top, regions.but_arms(places, numpy.maximum(aside, under)), "extra pack", scale)
    else:
        high = 0.10 if kind == "satchel" else 0.16
        side = -1.0
        near = body[(numpy.abs(body[:, 2] - hips[2]) < 0.12 * scale)]
        edge = numpy.abs(near[:, 1]).max() if len(near) else rig.widest
        centre = (hips[0] - 0.03, side * (min(edge, rig.widest + 0.05) + 0.035 * scale), hips[2] + 0.02 * scale)
        found.append(_box(bodies, centre, numpy.array([0.13, 0.040, high]) * scale, "pelvis", "extra leather", level))
        for top in tops if level < 2 else ():
            places = top.places
            # from the left shoulder to the right hip
            across = 0.013 - numpy.abs((places[:, regions.Y] + 0.13) * 0.80 - (places[:, regions.Z] - 0.10) * 0.50)
            across = numpy.minimum(across, places[:, regions.Z] - 0.10)
            found += _strap(top, regions.but_arms(places, across), "extra leather", scale)
    return found


__all__ = ["bag", "bound_to"]
