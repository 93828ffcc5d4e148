# SPDX-License-Identifier: Apache-2.0
"""What people wear and carry: hair, collars, skirts, bags. Pure Python."""
import math

from .mesh_builder import add, mix, outline, ring, scale, turn_z
from .people import BOTTOM, EXTRA, TOP

BULK = {"coat": 1.10, "jacket": 1.06, "hoodie": 1.08}
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
    mesh.loft([_tilted(at, x, y, s, z, back, rx, ry, 0.42 if z < 0.06 else 0.147)
               for z, back, rx, ry in ((-0.045, -0.030, 0.080, 0.079), (0.0, -0.016, 0.096, 0.083), (0.045, -0.007, 0.104, 0.085), (0.085, -0.004, 0.100, 0.080),
                                       (0.115, -0.006, 0.077, 0.062), (0.132, -0.008, 0.040, 0.034))], EXTRA if p.hair == "cap" else hair, 12, caps=(False, True))
    if cap:
        mesh.loft([level(-0.05, 0.076, 0.078, -0.03), level(0.02, 0.076, 0.078, -0.03)], hair, 12, caps=_OPEN, until=0)
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


def add_skirts(figure, hips, knees, ankles):
    p = figure.person
    if p.bottom == "skirt":
        _skirt(figure, hips, knees, ankles, 0.95, BOTTOM, 1.0)
    if p.top == "coat":
        _skirt(figure, hips, knees, ankles, 0.82, TOP, 1.1, _CLOTH if p.bottom != "skirt" else 4.0 * _CLOTH)
    if p.top == "dress":
        _skirt(figure, hips, knees, ankles, 1.62, TOP, 1.12)


_SKIRT_POINTS, _SKIRT_SQUARE = 12, 0.4
_CLOTH, _BESIDE = 0.012, 0.86  # m that cloth stands off a leg; how deep rings are where legs are
_THIGH = ((0.0, 0.080), (0.15, 0.090), (0.3, 0.086), (0.45, 0.079), (0.6, 0.072), (0.7, 0.068), (0.8, 0.063), (0.9, 0.060), (1.0, 0.057))  # share of its length, radius in m
_SHANK = ((0.0, 0.057), (0.12, 0.058), (0.3, 0.059), (0.4, 0.057), (0.5, 0.054), (0.6, 0.051), (0.7, 0.049), (0.8, 0.048), (0.9, 0.047), (1.0, 0.048))


def hem(person):
    """Half the width of what hangs over the hips, for somebody of standard height, m: arms swing outside of it."""
    flare = {"coat": 1.1, "dress": 1.12}.get(person.top, 1.0 if person.bottom == "skirt" else 0.0)
    hips = 0.176 * BULK.get(person.top, 1.0) * person.hips
    return max(hips, 0.178 * person.hips * flare * 1.06)


def _surface(upper, lower, radii):
    """The foremost and the hindmost points of a limb's skin, along it: [(x, z of the front, x, z of the back)]."""
    dx, dz = lower[0] - upper[0], lower[2] - upper[2]
    size = math.hypot(dx, dz)
    nx, nz = (-dz / size, dx / size) if size > 1e-6 else (1.0, 0.0)  # forward, across the limb
    points = []
    for share, radius in radii:
        x, z = upper[0] + dx * share, upper[2] + dz * share
        points.append((x + nx * radius, z + nz * radius, x - nx * radius, z - nz * radius))
    return points


def _cover(spans, x, z, side):
    """Widens rings [front, back, y, z, half width] until the cloth between them is outside of a point; `side` is 0 in front and 1 behind."""
    sign = 1.0 if side == 0 else -1.0
    if spans[-1][3] - 0.05 < z:  # what is just below the hem is at the hem a little higher
        z = max(z, spans[-1][3])
    for upper, lower in zip(spans, spans[1:]):
        if lower[3] <= z <= upper[3]:
            share = (z - lower[3]) / max(upper[3] - lower[3], 1e-6)
            near, far = (lower[end] + (upper[end] - lower[end]) * share for end in (side, 1 - side))
            missing = sign * ((x - 0.5 * (1.0 - _BESIDE) * far) / (0.5 * (1.0 + _BESIDE)) - near)
            if missing > 0.0:  # shared so that what is nearer gives more
                weight = share * share + (1.0 - share) * (1.0 - share)
                upper[side] += sign * missing * share / weight
                lower[side] += sign * missing * (1.0 - share) / weight
            return
    if z > spans[0][3]:
        spans[0][side] = sign * max(sign * spans[0][side], sign * x)


def _skirt(figure, hips, knees, ankles, length, material, flare, off=_CLOTH):
    """Cloth from the waist down to a share of the legs: 1 is the knees, 2 the ankles. It hangs as tight as both legs let it."""
    p, g, s = figure.person, figure.g, figure.s
    waist = figure.trunk_ring(0.09, 0.116 * g * flare, 0.160 * flare, 0.0)
    below = figure.at(-0.02, -0.01, 0.0, 0.0)
    spans = [[below[0] + 0.135 * g * flare * s, below[0] - 0.135 * g * flare * s, below[1], below[2], 0.185 * p.hips * flare * s]]
    for share in (0.2, 0.55, 1.0) if length <= 1.0 else (0.12, 0.33, 0.62, 1.0):
        t = share * length
        points = [mix(hip, knee, t) if t <= 1.0 else mix(knee, ankle, t - 1.0) for hip, knee, ankle in zip(hips, knees, ankles)]
        centre = mix(points[0], points[1], 0.5)
        least = (0.125 if t <= 1.0 else 0.10) * s * g * flare
        spans.append([centre[0] + least, centre[0] - least, centre[1], min(centre[2], spans[-1][3] - 0.02 * s),
                      0.178 * s * p.hips * flare * (1.0 + 0.06 * share) * (1.0 if t <= 1.0 else 0.97)])
    wide = s * g ** 0.7
    for _ in range(4):  # what covers one point may move the cloth off another
        for hip, knee, ankle in zip(hips, knees, ankles):
            for upper, lower, radii in ((hip, knee, _THIGH), (knee, ankle, _SHANK)):
                for front, front_z, back, back_z in _surface(upper, lower, [(share, radius * wide + off * s) for share, radius in radii]):
                    _cover(spans, front, front_z, 0)
                    _cover(spans, back, back_z, 1)
    for upper, lower in zip(spans, spans[1:]):  # cloth hangs: it does not draw in below a knee
        lower[0], lower[1] = max(lower[0], upper[0] - 0.015 * s), min(lower[1], upper[1] + 0.015 * s)
    turn = 0.5 * figure.pose.pelvis_yaw
    x, y = turn_z((1, 0, 0), turn), turn_z((0, 1, 0), turn)
    rings = [waist] + [ring((0.5 * (front + back), across, z), x, y, 0.5 * (front - back), width) for front, back, across, z, width in spans]
    figure.mesh.loft(rings, material, _SKIRT_POINTS, _SKIRT_SQUARE, caps=(False, True), stands=True)
    figure.skirts.append([[add(r[:3], add(scale(r[3:6], c), scale(r[6:9], n))) for c, n in outline(_SKIRT_POINTS, _SKIRT_SQUARE)] for r in rings])


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
    hip = figure.at(-0.04, -0.02, 0.20 + 0.035 * figure.g, 0.0)
    figure.mesh.box(hip, (0.135 * s, 0.048 * s, 0.105 * s), figure.yaw(0.0), EXTRA, 0.92, 8)
    over = figure.at(0.485, 0.0, -0.11)
    for forward in (0.135, -0.125):  # the strap, over chest and back
        chest = figure.at(0.25, forward * figure.g, 0.03, 0.6)
        figure.mesh.limb(over, chest, [(0, 0.012 * s), (1, 0.012 * s)], EXTRA, 4, until=1)
        figure.mesh.limb(chest, add(hip, (forward * 0.6 * s, 0, 0.08 * s)), [(0, 0.012 * s), (1, 0.012 * s)], EXTRA, 4, until=1)


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
