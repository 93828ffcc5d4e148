# SPDX-License-Identifier: Apache-2.0
"""Trunks of people near the camera turn and lean as the bake says (`--feet`, docs/bake.md): about the middle between
the hips, shoulders and arms by all of it, the back by less the lower it is. Heads stay as they are (heads.py)."""
from ..blender.vectors import combined, index, parts, rotated, scaled, vector
from ..cast import bones
from .names import BONE

CARRIAGE = "throng_carriage"  # of points: as the stream has it
_WAIST = "throng_waist"
_CENTRE, _ANGLES = "throng_centre", "throng_angles"


def walking(maths):
    """The share of the walk in somebody's pose."""
    return maths.components(CARRIAGE)[0]


def _waists(maths, people, all_):
    """A point for each of the people, with where the middle between the hips is."""
    ends = [all_.joint(maths, index(maths), float(all_.limbs[limb]), float(joint)) for limb, joint in ((0, 0), (4, 3))]
    return maths.store(people, _WAIST, scaled(maths, vector(maths, "ADD", *ends), 0.5), "FLOAT_VECTOR")


def _share(maths, shares):
    """Of the point's bone, by number."""
    bone, total = maths.attribute(BONE, "INT"), 0.0
    for number, share in enumerate(shares):
        if share:
            is_it = maths.math("COMPARE", bone, float(number), 0.5)
            total = maths.math("MULTIPLY_ADD", is_it, share, total)
    return total


def with_trunks_turned(maths, people, all_, placed):
    """The points of bones, with trunks that turn and lean. @param placed as in legs.with_feet_held"""
    waists, person = _waists(maths, people, all_), all_.person(maths)
    centre = bones.sample(maths, waists, maths.attribute(_WAIST, "FLOAT_VECTOR"), person)
    _, twist, lean = parts(maths, maths.attribute(CARRIAGE, "FLOAT_VECTOR"))
    share = _share(maths, all_.trunk)
    points = all_.points
    for name, value in ((_CENTRE, centre), (_ANGLES, scaled(maths, combined(maths, twist, lean, 0.0), share))):
        points = maths.store(points, name, value, "FLOAT_VECTOR")
    twist, lean, _ = maths.components(_ANGLES)
    aside, upright = placed(maths, combined(maths, 0.0, 1.0, 0.0)), combined(maths, 0.0, 0.0, 1.0)

    def carried(value, about):
        return rotated(maths, rotated(maths, value, upright, twist, about), aside, lean, about)

    return all_.turned(maths, points, carried, maths.attribute(_CENTRE, "FLOAT_VECTOR"), (0.0, 0.0, 0.0))
