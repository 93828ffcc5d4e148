# SPDX-License-Identifier: Apache-2.0
"""Heads of people near the camera turn to where the bake says that they look (`--gaze`, docs/bake.md): the neck by a
part of it, the head by all. Where trunks turn and lean, heads turn and nod back."""
import functools

from ..blender.vectors import combined, index, parts, rotated, scaled, vector
from ..cast import bones
from .names import BONE
from .trunks import CARRIAGE

GAZE = "throng_gaze"  # of points: as the stream has it
NECK_TURNS = 0.4      # of the yaw
_NECK, _HEAD = "throng_neck", "throng_head"
_CENTRE, _ANGLES, _SHIFT = "throng_centre", "throng_angles", "throng_shift"


def _ends_of_necks(maths, people, all_):
    """A point for each of the people, with where their neck begins and ends."""
    for number, name in ((6, _NECK), (7, _HEAD)):
        where = all_.joint(maths, index(maths), float(all_.limbs[number + 2]), float(number))
        people = maths.store(people, name, where, "FLOAT_VECTOR")
    return people


def _wanted(maths, gazes, turns):
    """(yaw, pitch) of heads, from how trunks are. @param gazes, turns whether there are streams of gazes and trunks"""
    yaw, pitch = parts(maths, maths.attribute(GAZE, "FLOAT_VECTOR"))[:2] if gazes else (0.0, 0.0)
    if turns:
        _, twist, lean = parts(maths, maths.attribute(CARRIAGE, "FLOAT_VECTOR"))
        yaw, pitch = maths.math("SUBTRACT", yaw, twist), maths.math("ADD", pitch, lean)
    return yaw, pitch


def turning(gazes, turns):
    """What turns heads (_with_heads_turned), by the streams that there are."""
    return functools.partial(_with_heads_turned, lambda maths: _wanted(maths, gazes, turns))


def _with_heads_turned(wanted, maths, people, all_, placed):
    """The points of bones, with heads that look. @param placed as in legs.with_feet_held"""
    ends, person = _ends_of_necks(maths, people, all_), all_.person(maths)
    neck, head = (bones.sample(maths, ends, maths.attribute(name, "FLOAT_VECTOR"), person) for name in (_NECK, _HEAD))
    bone = maths.attribute(BONE, "INT")
    is_neck, is_head = (maths.math("COMPARE", bone, float(number), 0.5) for number in all_.limbs[8:])
    yaw, pitch = wanted(maths)
    upright = combined(maths, 0.0, 0.0, 1.0)
    bent = rotated(maths, head, upright, maths.math("MULTIPLY", yaw, NECK_TURNS), neck)
    centre = vector(maths, "ADD", scaled(maths, neck, is_neck), scaled(maths, head, is_head))
    turns = maths.math("MULTIPLY", yaw, maths.math("MULTIPLY_ADD", is_neck, NECK_TURNS, is_head))
    nods = maths.math("MULTIPLY", maths.math("SUBTRACT", 0.0, pitch), is_head)
    points = all_.points
    for name, value in ((_CENTRE, centre), (_ANGLES, combined(maths, turns, nods, 0.0)),
                        (_SHIFT, scaled(maths, vector(maths, "SUBTRACT", bent, head), is_head))):
        points = maths.store(points, name, value, "FLOAT_VECTOR")
    turns, nods, _ = maths.components(_ANGLES)
    aside = placed(maths, combined(maths, 0.0, 1.0, 0.0))

    def looking(value, about):
        return rotated(maths, rotated(maths, value, aside, nods, about), upright, turns, about)

    return all_.turned(maths, points, looking, *(maths.attribute(name, "FLOAT_VECTOR") for name in (_CENTRE, _SHIFT)))
