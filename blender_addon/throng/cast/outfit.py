# SPDX-License-Identifier: Apache-2.0
"""What people wear on their heads and shoulders, and carry: hair, collars, bags. Pure Python."""
import math

from .cloth import hem
from .mesh_builder import add, ring, turn_z
from .people import EXTRA, TOP

SLEEVES = {"coat": 1.18, "jacket": 1.12, "hoodie": 1.15, "tee": 1.0, "dress": 1.06}
_OPEN = (False, False)


def add_collar(figure):
    p, mesh = figure.person, figure.mesh
    if p.top in ("jacket", "coat", "shirt"):
        mesh.loft([figure.trunk_ring(0.478, 0.083, 0.100, -0.012), figure.trunk_ring(0.525, 0.070, 0.076, -0.010)], TOP, 12, 0.25, _OPEN, until=1)
    if p.top == "hoodie":  # the hood lies on the back
        s = figure.s
        mesh.ball(figure.at(0.475, -0.085), (0.06 * s, 0.115 * s, 0.06 * s), TOP, 8, 4, 0.5)
    if p.extra == "scarf":
        mesh.loft([figure.trunk_ring(h, a, b) for h, a, b in ((0.465, 0.085, 0.095), (0.49, 0.098, 0.102), (0.525, 0.09, 0.092), (0.54, 0.072, 0.072))], EXTRA, 12,
                  caps=_OPEN)
        mesh.limb(figure.at(0.48, 0.095, 0.045), figure.at(0.20, 0.155, 0.055), [(0, 0.036 * figure.s), (0.5, 0.046 * figure.s), (1, 0.048 * figure.s)], EXTRA, 6, 0.4,
                  caps=(False, True))


def _tilted(at, x, y, s, z, back, rx, ry, tilt):
    """A ring round the head, higher in front by `tilt`."""
    long, wide = rx * s, ry * s
    return (*at(back, 0.0, z), x[0] * long, x[1] * long, tilt * long, y[0] * wide, y[1] * wide, 0.0)


def add_hair(figure, at, x, y, s):
    p, mesh, hair = figure.person, figure.mesh, figure.hair_material

    def level(z, rx, ry, back=0.0):
        return ring(at(back, 0.0, z), x, y, rx * s, ry * s)

    if p.beard:
        mesh.loft([level(-0.128, 0.020, 0.020, 0.040), level(-0.112, 0.056, 0.048, 0.030), level(-0.080, 0.074, 0.062, 0.026), level(-0.040, 0.070, 0.069, 0.016)], hair, 12,
                  caps=(True, False), until=1)
    if p.hair == "bald":
        mesh.loft([level(-0.05, 0.068, 0.072), level(0.0, 0.080, 0.0795), level(0.03, 0.079, 0.078)], hair, 12, caps=_OPEN, until=1)
        return
    if p.hair == "headscarf":
        _headscarf(figure, at, x, y, s)
        return
    # A cap of hair: low at the nape, high at the brow, so rings are tilted backwards.
    cap = p.hair in ("cap", "flat cap")
    crown = ((0.115, -0.006, 0.077, 0.062), (0.132, -0.008, 0.040, 0.034)) if p.hair != "flat cap" else ()  # which is under the cap
    mesh.loft([_tilted(at, x, y, s, z, back, rx, ry, 0.42 if z < 0.06 else 0.147)
               for z, back, rx, ry in ((-0.045, -0.030, 0.080, 0.079), (0.0, -0.016, 0.096, 0.083), (0.045, -0.007, 0.104, 0.085), (0.085, -0.004, 0.100, 0.080),
                                       *crown)], EXTRA if p.hair == "cap" else hair, 12)
    if cap:
        mesh.loft([level(-0.05, 0.076, 0.078, -0.03), level(0.02, 0.076, 0.078, -0.03)], hair, 12, caps=(True, False), until=0)
    if p.hair == "cap":  # a peak
        mesh.loft([ring(at(0.10, 0, 0.062), x, y, 0.05 * s, 0.062 * s), ring(at(0.125, 0, 0.054), x, y, 0.055 * s, 0.058 * s)], EXTRA, 10)
    if p.hair == "flat cap":  # falls forward over its peak
        mesh.loft([_tilted(at, x, y, s, z, back, rx, ry, tilt) for z, back, rx, ry, tilt in (
            (0.052, 0.024, 0.122, 0.092, -0.05), (0.066, 0.026, 0.138, 0.104, -0.08), (0.104, 0.004, 0.122, 0.098, -0.20), (0.134, -0.012, 0.070, 0.058, -0.20))], EXTRA, 12)
    if p.hair == "long":
        mesh.loft([level(0.02 - 0.062 * k, 0.062 - 0.004 * k, w, -0.045 - 0.012 * k) for k, w in enumerate((0.078, 0.086, 0.088, 0.084, 0.074, 0.05))], hair, 12)
    if p.hair == "bun":
        mesh.ball(at(-0.115, 0, 0.055), (0.046 * s, 0.05 * s, 0.046 * s), hair, 8, 4)
    if p.hair == "tail":
        mesh.limb(at(-0.085, 0, 0.06), at(-0.165, 0, -0.14), [(0, 0.020 * s), (0.15, 0.036 * s), (0.55, 0.034 * s), (1, 0.012 * s)], hair, 8, caps=(False, True))


def _headscarf(figure, at, x, y, s):
    """Round the face, over hair and neck, down to the shoulders; the face looks out."""
    mesh = figure.mesh
    mesh.loft([_tilted(at, x, y, s, z, back, rx, ry, tilt) for z, back, rx, ry, tilt in (
        (-0.150, -0.014, 0.086, 0.090, 0.0), (-0.112, -0.024, 0.078, 0.080, 0.30), (-0.060, -0.032, 0.080, 0.082, 0.50), (0.000, -0.024, 0.096, 0.086, 0.60),
        (0.050, -0.010, 0.106, 0.088, 0.50), (0.090, -0.006, 0.103, 0.083, 0.20), (0.120, -0.008, 0.080, 0.064, 0.10), (0.138, -0.010, 0.040, 0.034, 0.0))], EXTRA, 12,
        caps=(False, True))
    mesh.loft([ring(at(0.012, 0, -0.118), x, y, 0.068 * s, 0.072 * s), figure.trunk_ring(0.520, 0.084, 0.098, -0.008), figure.trunk_ring(0.470, 0.120, 0.158, -0.004),
               figure.trunk_ring(0.400, 0.142 * figure.g, 0.166, 0.004)], EXTRA, 12, 0.0, _OPEN)


def add_things(figure, hands, ankles):
    """Bags and what else is carried; `hands` and `ankles` are (right, left)."""
    thing = figure.person.extra
    if thing in _THINGS:
        _THINGS[thing](figure, hands, ankles)


def _backpack(figure, _hands, _ankles):
    s = figure.s
    big = 1.0 + 1.3 * max(0.0, 1.0 - s)  # a school bag is as large whoever carries it
    turn = figure.yaw(1.0)
    figure.mesh.box(figure.at(0.27, -0.105 * figure.g - 0.088 * big), (0.080 * s * big, 0.140 * s * big, 0.20 * s * big), turn, EXTRA, 0.84, 8, 1.0, figure.lean)
    for side in (-1, 1):  # straps, over the shoulders
        over, collar = figure.at(0.497, -0.005, side * 0.095), figure.at(0.462, 0.090 * figure.g, side * 0.097)
        chest, low = figure.at(0.40, 0.122 * figure.g, side * 0.100), figure.at(0.27, 0.125 * figure.g + 0.008, side * 0.105)
        for start, end in ((over, collar), (collar, chest), (chest, low), (over, figure.at(0.42, -0.11 * figure.g, side * 0.08))):
            figure.mesh.limb(start, end, [(0, 0.019 * s), (1, 0.017 * s)], EXTRA, 4, until=0)


def _shoulder_bag(figure, _hands, _ankles):
    s = figure.s
    out = max(0.20 + 0.035 * figure.g, hem(figure.person) + 0.025)
    hip = figure.at(-0.04, -0.02, out, 0.0)
    figure.mesh.box(hip, (0.135 * s, 0.048 * s, 0.105 * s), figure.yaw(0.0), EXTRA, 0.92, 8)
    flared = 1.17 if figure.person.top == "dress" else 1.05
    for front in (True, False):  # the strap, over chest and back
        along = [figure.at(0.497, 0.0, -0.098)] + [figure.on_trunk(height, -0.105 + 0.265 * (0.46 - height) / 0.38, 0.006, front, wider)
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
        figure.mesh.limb(add(handle, turn_z((0.3 * end * s, 0, 0.01 * s), turn)), add(handle, turn_z((end * s, 0.010 * s, -0.07 * s), turn)),
                         [(0, 0.010 * s), (1, 0.010 * s)], EXTRA, 4, until=0)


def _stick(figure, hands, ankles):
    """In the right hand; it stands and swings with the left foot, so it does not slide either."""
    s, hand, foot = figure.s, hands[0], ankles[1]
    lifted = max(0.0, foot[2] - figure.build.ankle)
    tip = (foot[0] + 0.13 * s, hand[1] - 0.03 * s, 0.005 + min(0.6 * lifted, 0.10))
    top = add(hand, (0.0, 0.0, 0.035 * s))
    figure.mesh.limb(tip, top, [(0, 0.012), (1, 0.012)], EXTRA, 6, caps=(True, True))
    grip = math.atan2(top[0] - tip[0], top[2] - tip[2])
    figure.mesh.limb(add(top, (-0.035 * s, 0.0, 0.035 * s * grip)), add(top, (0.075 * s, 0.0, -0.02 * s)), [(0, 0.014), (1, 0.014)], EXTRA, 6, caps=(True, True), until=1)


_THINGS = {"backpack": _backpack, "bag": _shoulder_bag, "case": _case, "stick": _stick}
