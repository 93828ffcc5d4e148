# SPDX-License-Identifier: Apache-2.0
"""What people carry: a rucksack, a bag on a strap, a shopper over the shoulder, a stick, and what hands hold. Straps
are laid on clothes."""
import math

import numpy

from . import holding, levels, regions
from .head import loose
from .parts import clipped, strap_on

_UP = numpy.array([0.0, 0.0, 1.0])


def _box(bodies, centre, half, bone, material, level, round_=0.55, axes=None):
    """A box with soft edges. @param axes its own, as columns, where they are not everybody's"""
    steps = {levels.NEAR: 9, levels.CLOSE: 7, 0: 4, 1: 3, 2: 2}[level]
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
                    spot = (spot * (1.0 - round_) + ball * round_) * half
                    points.append(numpy.asarray(centre) + (spot if axes is None else axes @ spot))
            for row in range(steps - 1):
                for column in range(steps - 1):
                    corner = first + row * steps + column
                    faces += [(corner, corner + 1, corner + steps + 1), (corner, corner + steps + 1, corner + steps)]
    points, faces = numpy.array(points), numpy.array(faces)
    a, b, c = (points[faces[:, corner]] for corner in range(3))
    inwards = (numpy.cross(b - a, c - a) * (a - centre)).sum(axis=1) < 0.0
    faces[inwards] = faces[inwards][:, ::-1]
    return loose(bodies, points, faces, bone, material)


def _strap(top, field, wide, material, scale, level):
    trunk = clipped(top, regions.but_arms(top.places, 1.0))
    if not len(trunk.faces):
        return []
    return strap_on(trunk, field(trunk.places), wide, 0.0055 * scale, material, level == levels.NEAR)


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
            for side in (-1.0, 1.0):  # over the shoulder, and under the arm
                found += _strap(top, regions.strap(side), 0.036 * scale, "extra pack", scale, level)
    else:
        high = 0.10 if kind == "satchel" else 0.16
        side = -1.0
        near = body[(numpy.abs(body[:, 2] - hips[2]) < 0.12 * scale)]
        edge = numpy.abs(near[:, 1]).max() if len(near) else rig.widest
        centre = (hips[0] - 0.03, side * (min(edge, rig.widest + 0.05) + 0.035 * scale), hips[2] + 0.02 * scale)
        found.append(_box(bodies, centre, numpy.array([0.13, 0.040, high]) * scale, "pelvis", "extra leather", level))
        for top in tops if level < 2 else ():  # from the left shoulder to the right hip
            across = regions.line((-0.13, 0.10), (0.115, 0.56))
            found += _strap(top, across, 0.030 * scale, "extra leather", scale, level)
    return found


def stick(bodies, rig, level):
    """A walking stick with a crook (rig.Rig moves it)."""
    tip, top = rig.stick_at_rest()
    sides, crook = {levels.NEAR: (12, 12), levels.CLOSE: (8, 8), 0: (6, 6), 1: (4, 3), 2: (3, 0)}[level]
    reach = 0.045 * rig.scale
    line, radii = [tip, tip + 0.02 * rig.scale * _UP, top], [0.011, 0.0085, 0.0095]
    for step in range(1, crook + 1):  # forwards, and down again
        angle = math.pi * step / crook
        line.append(top + reach * numpy.array([1.0 - math.cos(angle), 0.0, math.sin(angle)]))
        radii.append(0.0095)
    return [_tube(bodies, numpy.array(line), numpy.array(radii) * rig.scale, sides, "Root", "extra leather")]


def held(bodies, kind, rig, level):
    """What somebody's right hand holds (holding.py moves it)."""
    if kind in holding.BAGS:
        return _hanging(bodies, kind, holding.hook_at_rest(rig), level)
    return [_phone(bodies, rig, level)] if kind else []


def _hanging(bodies, kind, hook, level):
    """A bag below a hand: of leather with a handle, or of paper with two cords."""
    box = lambda below, half, material, round_, aside=(0.0, 0.0): _box(
        bodies, hook - (-aside[0], -aside[1], below), numpy.array(half), "Root", material, _of_thin(level), round_)
    if kind == holding.CASE:
        found = [box(0.185, (0.195, 0.045, 0.140), "extra leather", 0.25)]
        handle = [box(0.0, (0.055, 0.011, 0.009), "extra leather", 0.3)]
        handle += [box(0.022, (0.010, 0.010, 0.030), "extra leather", 0.3, (ahead, 0.0)) for ahead in (-0.052, 0.052)]
    else:
        found = [box(0.285, (0.155, 0.055, 0.185), "extra paper", 0.12)]
        handle = [box(0.050, (0.0045, 0.0045, 0.058), "extra paper", 0.3, (ahead, aside))
                  for ahead in (-0.045, 0.045) for aside in (-0.025, 0.025)]
    return found + (handle if level < 2 else [])


def _of_thin(level):
    """Boxes of a crowd's meshes have no soft edges where these are too thin to be seen."""
    return level if level < 0 else 2


_PHONE = 0.0745, 0.0365, 0.0046  # m, half of its length, width and thickness


def _phone(bodies, rig, level):
    """On the fingers, along them: its screen is where the palm is."""
    hand, middle, index, little = (rig.heads[f"{name}_r"] for name in ("hand", "middle_01", "index_01", "pinky_01"))
    along = middle - hand
    along = along / numpy.linalg.norm(along)
    palm = numpy.cross(index - hand, little - hand)  # of a right hand
    palm = palm - along * (palm @ along)
    palm = palm / numpy.linalg.norm(palm)
    across = numpy.cross(palm, along)
    centre = rig.grip_at_rest() + 0.020 * rig.scale * along + (0.016 * rig.scale + _PHONE[2]) * palm
    return _box(bodies, centre, numpy.array(_PHONE), "hand_r", "extra phone", _of_thin(level), 0.08,
                numpy.stack([along, across, palm], axis=1))


def _tube(bodies, line, radii, sides, bone, material):
    """Round about a line in the plane of x and z."""
    along = numpy.gradient(line, axis=0)
    along /= numpy.linalg.norm(along, axis=1, keepdims=True)
    aside = numpy.array([0.0, 1.0, 0.0])
    out = numpy.cross(along, aside)
    angles = 2.0 * math.pi * numpy.arange(sides) / sides
    round_ = numpy.cos(angles)[None, :, None] * out[:, None] + numpy.sin(angles)[None, :, None] * aside
    points = (line[:, None] + radii[:, None, None] * round_).reshape(-1, 3)
    corner = (numpy.arange(len(line) - 1)[:, None] * sides + numpy.arange(sides)).ravel()
    beside = (numpy.arange(len(line) - 1)[:, None] * sides + (numpy.arange(sides) + 1) % sides).ravel()
    faces = [numpy.stack([corner, beside, beside + sides], axis=1),
             numpy.stack([corner, beside + sides, corner + sides], axis=1)]
    fan = numpy.arange(1, sides - 1)
    last = (len(line) - 1) * sides
    faces += [numpy.stack([0 * fan, fan + 1, fan], axis=1), last + numpy.stack([0 * fan, fan, fan + 1], axis=1)]
    return loose(bodies, points, numpy.concatenate(faces), bone, material)
