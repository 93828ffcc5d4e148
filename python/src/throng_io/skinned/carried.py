# SPDX-License-Identifier: Apache-2.0
"""How legs follow held feet, trunks turn and lean and heads look, as a bake's streams say, on top of the poses:
as the add-on bends people near the camera (blender_addon/throng/crowd/trunks.py and heads.py), as numbers."""
from __future__ import annotations

import numpy

from ..cast import Repertoire
from ..people.turns import turn, turned
from . import legs
from .members import Member
from .motions import Track, matrices_of, stances_of

NECK_TURNS = 0.4               # of a head's yaw
# Bones that do less than what is above them, and those that do nothing.
SHARES = {"pelvis": 0.0, "spine_01": 0.4, "spine_02": 0.75, "stick": 0.0}
LEGS = tuple(f"{bone}_{side}" for bone in ("thigh", "calf", "foot", "ball") for side in "lr")
LEANS = 0.25                   # m, that people reach further than their poses where they lean and turn
_Y, _Z = numpy.array([0.0, 1.0, 0.0]), numpy.array([0.0, 0.0, 1.0])

Array = numpy.ndarray


def bent(member: Member, repertoire: Repertoire, track: Track) -> Array:
    """F x J x 3 x 4: where joints take what hangs on them."""
    names = [path.rpartition("/")[2] for path in member.joints]
    matrices = matrices_of(member.poses, repertoire, track)
    if track.footing is not None:
        matrices = legs.held(matrices, member.places, names, track.footing, stances_of(repertoire, track))
    if track.carriage is not None:
        matrices = _trunks(matrices, member.places, names, track.carriage)
    if track.attention is not None:
        matrices = _heads(matrices, member.places, names, *_looks(track))
    return matrices


def box_of(member: Member, streams: list[str]) -> Array:
    """2 x 3, round somebody in all poses, however turned and leant, and wherever feet are."""
    box = member.box.copy()
    if "carriage" in streams or legs.FEET[0] in streams:
        reach = float(numpy.hypot(*numpy.abs(box[:, :2]).max(axis=0)))
        reach += max(LEANS, legs.REACH if legs.FEET[0] in streams else 0.0)
        box = numpy.array([[-reach, -reach, box[0, 2] - 0.05], [reach, reach, box[1, 2] + 0.05]])
    if legs.GROUND in streams:
        box += [[0.0, 0.0, -legs.SINKS_ON_SLOPES - legs.REACH], [0.0, 0.0, legs.REACH]]
    return box


def _end(matrices: Array, places: Array, joint: int) -> Array:
    """F x 3: where a joint is."""
    return turned(matrices[:, joint, :, :3], places[joint]) + matrices[:, joint, :, 3]


def _about(matrices: Array, turns: Array, centre: Array, shift: Array | float = 0.0) -> Array:
    """Turned about a place, and shifted. @param matrices F x 3 x 4"""
    places = turned(turns, matrices[..., 3] - centre) + centre + shift
    return numpy.concatenate([turns @ matrices[..., :3], places[..., None]], axis=-1)


def _trunks(matrices: Array, places: Array, names: list[str], carriage: Array) -> Array:
    """About the middle between the hips."""
    middle = 0.5 * sum(_end(matrices, places, names.index(f"thigh_{side}")) for side in "lr")
    found = matrices.copy()
    for joint, name in enumerate(names):
        share = 0.0 if name in LEGS else SHARES.get(name, 1.0)
        if share:
            turns = turn(_Y, share * carriage[:, 2]) @ turn(_Z, share * carriage[:, 1])
            found[:, joint] = _about(matrices[:, joint], turns, middle)
    return found


def _looks(track: Track) -> tuple[Array, Array]:
    """(yaw, pitch) of heads, from how the trunk has them."""
    yaw, pitch, weight = track.attention.T
    twist, lean = (0.0, 0.0) if track.carriage is None else track.carriage[:, 1:].T
    return (yaw + twist) * weight - twist, pitch * weight + lean


def _heads(matrices: Array, places: Array, names: list[str], yaw: Array, pitch: Array) -> Array:
    """The neck by a part of it, about its lower end; the head by all, about its own, which goes with the neck."""
    neck, head = names.index("neck_01"), names.index("head")
    low, high = _end(matrices, places, neck), _end(matrices, places, head)
    neck_turns = turn(_Z, NECK_TURNS * yaw)
    found = matrices.copy()
    found[:, neck] = _about(matrices[:, neck], neck_turns, low)
    goes = turned(neck_turns, high - low) + low - high
    found[:, head] = _about(matrices[:, head], turn(_Z, yaw) @ turn(_Y, -pitch), high, goes)
    return found
