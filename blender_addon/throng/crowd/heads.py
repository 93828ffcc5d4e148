# SPDX-License-Identifier: Apache-2.0
"""Heads of people near the camera turn to where the bake says (`--attention`, or `--gaze`, docs/bake.md): the neck by a
part of it, the head by all. Where trunks turn and lean, heads turn and nod back."""
import functools

from ..blender.vectors import combined, index, parts, rotated, scaled, vector
from ..cast import bones
from .names import BONE
from .trunks import CARRIAGE

# Of points: as the streams have it; what is told of heads counts before what is told of eyes.
ATTENTION, GAZE = "throng_attention", "throng_gaze"
NECK_TURNS = 0.4      # of the yaw
_NECK, _HEAD = "throng_neck", "throng_head"
_CENTRE, _ANGLES, _SHIFT = "throng_centre", "throng_angles", "throng_shift"


def _ends_of_necks(maths, people, all_):
    """A point for each of the people, with where their neck begins and ends."""
    for number, name in ((6, _NECK), (7, _HEAD)):
        where = all_.joint(maths, index(maths), float(all_.limbs[number + 2]), float(number))
        people = maths.store(people, name, where, "FLOAT_VECTOR")
    return people


def is_told(streams):
    """Whether the bake says anything of where heads turn."""
    return "attention" in streams or "gaze" in streams


def _wanted(maths, streams, turns):
    """(yaw, pitch) of heads, from how trunks are. @param turns whether trunks do"""
    twist, lean = parts(maths, maths.attribute(CARRIAGE, "FLOAT_VECTOR"))[1:] if turns else (0.0, 0.0)
    yaw, pitch = 0.0, 0.0  # from where the hips are
    if "attention" in streams:
        yaw, pitch, weight = parts(maths, maths.attribute(ATTENTION, "FLOAT_VECTOR"))
        yaw = maths.math("MULTIPLY", maths.math("ADD", yaw, twist), weight)
        pitch = maths.math("MULTIPLY", pitch, weight)
    elif "gaze" in streams:
        yaw, pitch = parts(maths, maths.attribute(GAZE, "FLOAT_VECTOR"))[:2]
    if turns:
        yaw, pitch = maths.math("SUBTRACT", yaw, twist), maths.math("ADD", pitch, lean)
    return yaw, pitch


def turning(streams, turns):
    """What turns heads (_with_heads_turned), by the streams that there are."""
    return functools.partial(_with_heads_turned, lambda maths: _wanted(maths, streams, turns))


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
