# SPDX-License-Identifier: Apache-2.0
"""What hangs over hips and legs: skirts, coats, dresses, hems. Pure Python.

Nothing is simulated: in every pose, the rings of the cloth are made just deep and wide enough for the legs that are
within them, so that legs do not show through and cloth rests on a thigh that comes forward.
"""
import math

from .mesh_builder import add, extent_at, mix, outline, ring, scale, turn_z
from .people import BOTTOM, TOP

BULK = {"coat": 1.10, "jacket": 1.06, "hoodie": 1.08}
_FLARE = {"coat": 1.1, "dress": 1.12}
_OPEN = (False, False)
_LAP = 0.06  # m that it is pushed forward there
_LOOSE = ("jacket", "hoodie", "tee")  # over the hips, where no skirt holds them


def add_skirts(figure, hips, knees, ankles):
    p = figure.person
    if p.bottom == "skirt":
        _skirt(figure, hips, knees, ankles, 0.95, BOTTOM, 1.0, _CLOTH)
    if p.top in _FLARE:
        _skirt(figure, hips, knees, ankles, 0.82 if p.top == "coat" else 1.62, TOP, _FLARE[p.top], _off_legs(p))


_SKIRT_POINTS, _SKIRT_SQUARE = 12, 0.4
_CLOTH, _BESIDE = 0.012, 0.86  # m that cloth stands off a leg; how deep rings are where legs are
_FAR_ALONG = 0.8  # of half a ring's depth: nobody's cloth is made wider for what is further from its middle


def _off_legs(person):
    """How far the outermost cloth stands off the legs, m: a coat over a skirt further."""
    return 4.0 * _CLOTH if person.top == "coat" and person.bottom == "skirt" else _CLOTH


def hem(person):
    """Half the width of what hangs over the hips, for somebody of standard height, m: arms swing outside of it."""
    hips = 0.176 * BULK.get(person.top, 1.0) * person.hips
    legs = 0.093 * person.hips + 0.091 * person.girth ** 0.7 + _off_legs(person)
    # What hangs is wider than the legs where these are not beside its middle.
    if person.top in _FLARE or person.bottom == "skirt":
        return max(hips, 0.198 * person.hips * _FLARE.get(person.top, 1.0), 1.1 * legs)
    return max(hips, legs) if person.top in _LOOSE else hips


def _surfaces(figure, off):
    """The foremost and the hindmost points of the legs' skin, `off` metres off it, and the outermost y: [(x, z of the
    front, x, z of the back, y)]."""
    points = []
    for start, end, profile in figure.leg_limbs:
        dx, dz = end[0] - start[0], end[2] - start[2]
        size = math.hypot(dx, dz)
        nx, nz = (-dz / size, dx / size) if size > 1e-6 else (1.0, 0.0)  # forward, across the limb
        for (share, radius), (later, wider) in zip(profile, profile[1:]):
            for part in (0.0, 0.33, 0.67, 1.0) if later == profile[-1][0] else (0.0, 0.33, 0.67):
                x, y, z = mix(start, end, share + (later - share) * part)
                away = radius + (wider - radius) * part + off
                points.append((x + nx * away, z + nz * away, x - nx * away, z - nz * away,
                               y + math.copysign(away, start[1] - figure.pelvis[1])))
    return points


def _give(upper, lower, which, share, missing):
    """Moves two rings so that the cloth at a share of the way up from one to the other gets what it misses; what
    is nearer gives more."""
    weight = share * share + (1.0 - share) * (1.0 - share)
    upper[which] += missing * share / weight
    lower[which] += missing * (1.0 - share) / weight


def _place(spans, x, z, side):
    """(ring above, ring below, share of the way up from that, x, side) of a point, None where no ring is beside it. Of
    what is above all rings there is none below, and the first has to reach as far. Rings [front, back, y, z, half
    width] move fore and aft only, so this is asked once."""
    if spans[-1][3] - 0.05 < z:  # what is just below the hem is at the hem a little higher
        z = max(z, spans[-1][3])
    for upper, lower in zip(spans, spans[1:]):
        if lower[3] <= z <= upper[3]:
            return upper, lower, (z - lower[3]) / max(upper[3] - lower[3], 1e-6), x, side
    return (spans[0], None, 0.0, x, side) if z > spans[0][3] else None


def _cover(place):
    """Widens rings until the cloth between them is outside of a point; `side` is 0 in front and 1 behind. Returns
    whether anything has moved."""
    upper, lower, share, x, side = place
    sign = 1.0 if side == 0 else -1.0
    if lower is None:
        if sign * x <= sign * upper[side]:
            return False
        upper[side] = x
        return True
    near = lower[side] + (upper[side] - lower[side]) * share
    far = lower[1 - side] + (upper[1 - side] - lower[1 - side]) * share
    missing = sign * ((x - 0.5 * (1.0 - _BESIDE) * far) / (0.5 * (1.0 + _BESIDE)) - near)
    if missing <= 0.0:
        return False
    _give(upper, lower, side, share, sign * missing)
    return True


def _cover_legs(figure, spans, off):
    """Makes rings as deep and as wide as what is within them."""
    points = _surfaces(figure, off * figure.s)
    places = [place for front, front_z, back, back_z, _ in points
              for place in (_place(spans, front, front_z, 0), _place(spans, back, back_z, 1)) if place]
    for _ in range(4):  # what covers one point may move the cloth off another
        moved = [_cover(place) for place in places]
        if not any(moved):
            break
    _widen(spans, points)


def _widen(spans, points):
    """Makes rings as wide as both legs, wherever along them these are."""
    for front, front_z, back, back_z, aside in points:
        z = min(0.5 * (front_z + back_z), spans[0][3])
        if z < spans[-1][3] - 0.02:
            continue
        upper, lower = next((pair for pair in zip(spans, spans[1:]) if pair[1][3] <= z), spans[-2:])
        share = min(1.0, max(0.0, (z - lower[3]) / max(upper[3] - lower[3], 1e-6)))
        first, last = (lower[end] + (upper[end] - lower[end]) * share for end in (0, 1))
        along = min(_FAR_ALONG, abs(0.5 * (front + back) - 0.5 * (first + last)) / (0.5 * (first - last)))
        needed = abs(aside - lower[2]) / extent_at(along, _SKIRT_SQUARE)
        missing = needed - (lower[4] + (upper[4] - lower[4]) * share)
        if missing > 0.0:
            _give(upper, lower, 4, share, missing)


def _skirt(figure, hips, knees, ankles, length, material, flare, off):
    """Cloth from the waist down to a share of the legs: 1 is the knees, 2 the ankles. It hangs as
    tight as legs let it."""
    p, g, s = figure.person, figure.g, figure.s
    waist = [figure.trunk_ring(0.08, 0.114 * g * flare, 0.156 * (0.5 + 0.5 * p.hips) * flare, 0.0)]
    if material == TOP:  # of one piece with what is above
        waist.insert(0, _flush(figure, 0.16, 1.01))
    below = figure.at(-0.02, -0.01, 0.0, 0.0)
    spans = [[below[0] + 0.135 * g * flare * s, below[0] - 0.135 * g * flare * s, below[1], below[2],
              0.185 * p.hips * flare * s]]
    for share in (0.2, 0.55, 1.0) if length <= 1.0 else (0.12, 0.33, 0.62, 1.0):
        t = share * length
        points = [mix(hip, knee, t) if t <= 1.0 else mix(knee, ankle, t - 1.0)
                  for hip, knee, ankle in zip(hips, knees, ankles)]
        centre = mix(points[0], points[1], 0.5)
        least = (0.125 if t <= 1.0 else 0.10) * s * g * flare
        spans.append([centre[0] + least, centre[0] - least, centre[1], min(centre[2], spans[-1][3] - 0.02 * s),
                      0.178 * s * p.hips * flare * (1.0 + 0.06 * share) * (1.0 if t <= 1.0 else 0.97)])
    _cover_legs(figure, spans, off)
    for upper, lower in zip(spans, spans[1:]):  # cloth hangs: it does not draw in below a knee
        lower[0], lower[1] = max(lower[0], upper[0] - 0.015 * s), min(lower[1], upper[1] + 0.015 * s)
    _hang(figure, waist, spans, material, (False, True))


def _hang(figure, rings, spans, material, caps):
    """Cloth from rings down through spans. @param caps of its upper and its lower end"""
    turn = 0.5 * figure.pose.pelvis_yaw
    x, y = turn_z((1, 0, 0), turn), turn_z((0, 1, 0), turn)
    rings = rings + [ring((0.5 * (front + back), across, z), x, y, 0.5 * (front - back), width)
                     for front, back, across, z, width in spans]
    # upwards, as all faces look outwards then
    figure.mesh.loft(rings[::-1], material, _SKIRT_POINTS, _SKIRT_SQUARE, caps=caps[::-1], drapes=True)
    figure.skirts.append([[add(r[:3], add(scale(r[3:6], c), scale(r[6:9], n)))
                           for c, n in outline(_SKIRT_POINTS, _SKIRT_SQUARE)] for r in rings])


def add_hem(figure):
    """Of a jacket or a shirt that is not tucked in: over the hips, and over thighs that come forward."""
    p, g, s = figure.person, figure.g, figure.s
    if p.top not in _LOOSE or p.bottom == "skirt":
        return
    bulk = BULK.get(p.top, 1.0)
    above, waist = _flush(figure, 0.15, 1.01), _flush(figure, 0.08, 1.04)
    spans = []
    for height, deep, wide in ((0.0, 0.121, 0.172), (-0.055, 0.124, 0.178)):
        x, y, z = figure.at(height, -0.006, 0.0, 0.0)
        spans.append([x + deep * g * bulk * s, x - deep * g * bulk * s, y, z, wide * p.hips * bulk * s])
    fronts = [each[0] for each in spans]
    _cover_legs(figure, spans, _CLOTH)
    if figure.pose.seated:  # it ends in the lap
        for each, front in zip(spans, fronts):
            each[0] = min(each[0], front + _LAP * s)
    _hang(figure, [above, waist], spans, TOP, _OPEN)


def _flush(figure, height, wider):
    """A ring just over what is worn beneath."""
    deep, wide, forward = figure.trunk_at(height)
    return figure.trunk_ring(height, deep * wider, wide * wider, forward)
