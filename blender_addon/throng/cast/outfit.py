# SPDX-License-Identifier: Apache-2.0
"""What people wear on their shoulders, and carry: collars, bags. Pure Python."""
import math

from .cloth import hem
from .mesh_builder import add, turn_z
from .people import EXTRA, TOP

SLEEVES = {"coat": 1.18, "jacket": 1.12, "hoodie": 1.15, "tee": 1.0, "dress": 1.06}
_OPEN = (False, False)


def add_collar(figure):
    p, mesh = figure.person, figure.mesh
    if p.top in ("jacket", "coat", "shirt"):
        mesh.loft([figure.trunk_ring(0.478, 0.083, 0.100, -0.012), figure.trunk_ring(0.525, 0.070, 0.076, -0.010)], TOP,
                  12, 0.25, _OPEN, until=1)
    if p.top == "hoodie":  # the hood lies on the back
        s = figure.s
        mesh.ball(figure.at(0.475, -0.085), (0.06 * s, 0.115 * s, 0.06 * s), TOP, 8, 4, 0.5)
    if p.extra == "scarf":
        mesh.loft([figure.trunk_ring(h, a, b)
                   for h, a, b in ((0.465, 0.085, 0.095), (0.49, 0.098, 0.102), (0.525, 0.09, 0.092),
                                   (0.54, 0.072, 0.072))], EXTRA, 12, caps=_OPEN)
        mesh.limb(figure.at(0.48, 0.095, 0.045), figure.at(0.20, 0.155, 0.055),
                  [(0, 0.036 * figure.s), (0.5, 0.046 * figure.s), (1, 0.048 * figure.s)], EXTRA, 6, 0.4,
                  caps=(False, True))


def add_things(figure, hands, ankles):
    """Bags and what else is carried; `hands` and `ankles` are (right, left)."""
    thing = figure.person.extra
    if thing in _THINGS:
        _THINGS[thing](figure, hands, ankles)


def _backpack(figure, _hands, _ankles):
    s = figure.s
    big = 1.0 + 1.3 * max(0.0, 1.0 - s)  # a school bag is as large whoever carries it
    turn = figure.yaw(1.0)
    figure.mesh.box(figure.at(0.27, -0.105 * figure.g - 0.088 * big),
                    (0.080 * s * big, 0.140 * s * big, 0.20 * s * big), turn, EXTRA, 0.84, 8, 1.0, figure.lean)
    for side in (-1, 1):  # straps, over the shoulders
        over, collar = figure.at(0.497, -0.005, side * 0.095), figure.at(0.462, 0.090 * figure.g, side * 0.097)
        chest = figure.at(0.40, 0.122 * figure.g, side * 0.100)
        low = figure.at(0.27, 0.125 * figure.g + 0.008, side * 0.105)
        for start, end in ((over, collar), (collar, chest), (chest, low),
                           (over, figure.at(0.42, -0.11 * figure.g, side * 0.08))):
            figure.mesh.limb(start, end, [(0, 0.019 * s), (1, 0.017 * s)], EXTRA, 4, until=0)


def _shoulder_bag(figure, _hands, _ankles):
    s = figure.s
    out = max(0.20 + 0.035 * figure.g, hem(figure.person) + 0.025)
    hip = figure.at(-0.04, -0.02, out, 0.0)
    figure.mesh.box(hip, (0.135 * s, 0.048 * s, 0.105 * s), figure.yaw(0.0), EXTRA, 0.92, 8)
    flared = 1.17 if figure.person.top == "dress" else 1.05
    for front in (True, False):  # the strap, over chest and back
        along = [figure.at(0.497, 0.0, -0.098)]
        along += [figure.on_trunk(height, -0.105 + 0.265 * (0.46 - height) / 0.38, 0.006, front, wider)
                  for height, wider in ((0.46, 1.0), (0.38, 1.0), (0.27, 1.0), (0.17, 1.03), (0.08, flared))]
        along.append(add(hip, ((0.05 if front else -0.05) * s, 0.0, 0.09 * s)))
        for start, end in zip(along, along[1:]):
            figure.mesh.limb(start, end, [(0, 0.011 * s), (1, 0.011 * s)], EXTRA, 4, until=1)


def _case(figure, hands, _ankles):
    """Hangs from the left hand, swinging a little with it."""
    s, hand = figure.s, hands[1]
    handle = add(hand, (0.0, 0.0, -0.035 * s))
    turn = 0.4 * figure.yaw(1.0)
    figure.mesh.box(add(handle, (0.0, 0.015 * s, -0.215 * s)), (0.225 * s, 0.060 * s, 0.165 * s), turn, EXTRA, 0.98, 8)
    for end in (-0.07, 0.07):
        figure.mesh.limb(add(handle, turn_z((0.3 * end * s, 0, 0.01 * s), turn)),
                         add(handle, turn_z((end * s, 0.010 * s, -0.07 * s), turn)), [(0, 0.010 * s), (1, 0.010 * s)],
                         EXTRA, 4, until=0)


def _stick(figure, hands, ankles):
    """In the right hand; it stands and swings with the left foot, so it does not slide either."""
    s, hand, foot = figure.s, hands[0], ankles[1]
    lifted = max(0.0, foot[2] - figure.build.ankle)
    tip = (foot[0] + 0.13 * s, hand[1] - 0.03 * s, 0.005 + min(0.6 * lifted, 0.10))
    top = add(hand, (0.0, 0.0, 0.035 * s))
    figure.mesh.limb(tip, top, [(0, 0.012), (1, 0.012)], EXTRA, 6, caps=(True, True))
    grip = math.atan2(top[0] - tip[0], top[2] - tip[2])
    figure.mesh.limb(add(top, (-0.035 * s, 0.0, 0.035 * s * grip)), add(top, (0.075 * s, 0.0, -0.02 * s)),
                     [(0, 0.014), (1, 0.014)], EXTRA, 6, caps=(True, True), until=1)


_THINGS = {"backpack": _backpack, "bag": _shoulder_bag, "case": _case, "stick": _stick}
