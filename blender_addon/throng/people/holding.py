# SPDX-License-Identifier: Apache-2.0
"""What somebody holds in the right hand all along, and what head and arm do about it: a phone is looked at or spoken
into, a bag hangs."""
import math

import numpy

from .turns import cross, frame, length, turn, turned

PHONE, CALL, CASE, CARRIER = "phone", "call", "case", "carrier"
THINGS = (PHONE, CALL, CASE, CARRIER)
BAGS = (CASE, CARRIER)  # hang from the hand, on the bone of sticks
# how much of an arm's swing is left, how far the elbow is bent (rad), and how far out the hand is held (m)
_HANGING = {CASE: (0.30, 0.07, 0.030), CARRIER: (0.40, 0.09, 0.035)}
_HEADS = {PHONE: (0.42, 0.0), CALL: (0.05, 0.10)}  # rad, bent forward and to the right
_ROLLS = {PHONE: 1.15, CALL: 0.25}  # rad, of the hand about the forearm: the palm faces up, or the ear;
_TO_THIGHS = -0.22                  # where nothing is held, the thigh
# the wrist beside the bone that it goes with, of somebody 1.74 m tall
_WRISTS = {PHONE: ("spine_03", "neck_01", (0.285, -0.065, -0.225)), CALL: ("head", "head", (0.088, -0.142, -0.062))}
_ELBOWS = {PHONE: (-0.20, -0.27, -0.94), CALL: (0.05, -0.42, -0.90)}  # the way that they point, beside the chest
_BESIDE_SEAT = (0.16, 0.10, -0.30)  # m, from where bags are made
_BAG_SWINGS = 0.5  # of the arm's angle
_Y = numpy.array([0.0, 1.0, 0.0])


def hanging(holds, swing, elbow, seated=False):
    """(swing, elbow) of the right arm. @param seated by pose: who has a seat has put bags down"""
    if holds not in _HANGING:
        return swing, elbow
    share, bent, _ = _HANGING[holds]
    return numpy.where(seated, swing, share * swing), numpy.where(seated, elbow, bent)


def hand(holds, side):
    """(m that a hand is further out than it needs to pass the hips, rad that it is rolled about the forearm)"""
    if side == "l":
        return 0.0, _TO_THIGHS
    return _HANGING.get(holds, (0.0, 0.0, 0.0))[2], _ROLLS.get(holds, _TO_THIGHS)


def head(holds, runs):
    """How far the head is bent forward and to the right, rad; runners, and who has a seat, look ahead. @param runs by
    pose: either of these"""
    nod, aside = _HEADS.get(holds, (0.0, 0.0))
    return numpy.where(runs, 0.0, nod), numpy.where(runs, 0.0, aside)


def hook_at_rest(rig):
    """Where a bag that hangs from the hand is held, where it is made: beside the right hip."""
    return numpy.array([0.0, -rig.widest - 0.20 * rig.scale, 0.80 * rig.scale])


def hold(rig, turns, places, poses):
    """Puts the right arm, which hangs, where what is held needs it, and what hangs from the hand below it."""
    if rig.holds in _WRISTS:
        _raise(rig, turns, places, poses.runs | poses.seated)
    if rig.holds in BAGS:
        hang(rig, turns, places, _BAG_SWINGS * _HANGING[rig.holds][0] * poses.arms[:, 0, 0])
        _put_down(rig, turns, places, poses.seated)


def hang(rig, turns, places, swing):
    """Puts a bag below the right hand, wherever that is. @param swing rad, forwards"""
    turns["Root"] = turn(_Y, -swing)
    places["Root"] = rig.grip(turns, places) + turned(turns["Root"], rig.heads["Root"] - hook_at_rest(rig))


def _put_down(rig, turns, places, seated):
    """A bag stands on the floor beside who has a seat."""
    floor = rig.heads["Root"] + rig.scale * numpy.array(_BESIDE_SEAT)
    turns["Root"] = numpy.where(seated[:, None, None], numpy.eye(3), turns["Root"])
    places["Root"] = numpy.where(seated[:, None], floor, places["Root"])


def _raise(rig, turns, places, free):
    """The hand to its place, but of those whose hands are free for something else."""
    bone, at, beside = _WRISTS[rig.holds]
    wrist = places[bone] + turned(turns[bone], rig.heads[at] - rig.heads[bone] + rig.scale * numpy.array(beside))
    raised, there = dict(turns), dict(places)
    _reach(rig, raised, there, wrist)
    for name in raised:
        turns[name] = numpy.where(free[:, None, None], turns[name], raised[name])
        places[name] = numpy.where(free[:, None], places[name], there[name])


def _reach(rig, turns, places, wrist):
    """Brings the right hand to where its wrist should be, as far as the arm goes: two bones, and where the elbow
    points."""
    upper, lower, hand = "upperarm_r", "lowerarm_r", "hand_r"
    rest_upper, rest_lower = rig.heads[lower] - rig.heads[upper], rig.heads[hand] - rig.heads[lower]
    first, second = math.hypot(*rest_upper), math.hypot(*rest_lower)
    way = wrist - places[upper]
    far = numpy.clip(length(way), 1.05 * abs(first - second), 0.985 * (first + second))[:, None]
    way = way / length(way)[:, None]
    along = (first * first - second * second + far * far) / (2.0 * far)
    pole = turned(turns["spine_03"], numpy.array(_ELBOWS[rig.holds]))
    pole = pole - way * (way * pole).sum(axis=-1)[:, None]
    pole = pole / length(pole)[:, None]
    elbow = way * along + pole * numpy.sqrt(numpy.maximum(first * first - along * along, 0.0))
    fore = way * far - elbow
    hinge, rest_hinge = cross(elbow, fore), cross(rest_upper, rest_lower)
    turns[upper] = frame(elbow, hinge) @ frame(rest_upper, rest_hinge).T
    turns[lower] = frame(fore, hinge) @ frame(rest_lower, rest_hinge).T
    places[lower] = places[upper] + elbow
    turns[hand] = turn(fore, _ROLLS[rig.holds]) @ turns[lower]
    places[hand] = places[upper] + way * far
    rig.bend_fingers(turns, places, "r")
