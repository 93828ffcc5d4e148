# SPDX-License-Identifier: Apache-2.0
"""Hair: a close skin over the scalp, and locks that grow from it, fall, and keep off the head."""
from dataclasses import dataclass, replace

import numpy

from . import levels, regions
from .head import head_of, loose
from .parts import Part, clipped, normals_of, scattered, smoothed, subdivided


@dataclass(frozen=True)
class Style:
    count: int              # of locks, in full detail
    length: float           # m, or down to a height where that is less than 0
    wide: float             # m, of a lock
    lift: float             # m, off the head
    thick: float            # m, of the skin
    fall: float             # how fast locks turn down
    curl: float = 0.03
    comb: str = "crown"     # crown, back, side, parted, knot, out
    fringe: float = 0.0     # m, of locks over the forehead
    pieces: int = 5         # of a lock
    raised: float = 0.0     # m, of the hairline


STYLES = {
    "crop": Style(0, 0.013, 0.0042, 0.003, 0.004, 0.02, 0.12),
    "short": Style(1500, 0.042, 0.0085, 0.012, 0.010, 0.06, 0.10, fringe=0.030),
    "quiff": Style(1300, 0.062, 0.010, 0.014, 0.010, 0.03, 0.05, "back"),
    "side": Style(1300, 0.080, 0.011, 0.012, 0.011, 0.08, 0.04, "side"),
    "curtains": Style(1200, 0.110, 0.013, 0.013, 0.011, 0.35, 0.03, "parted"),
    "curls": Style(1900, 0.050, 0.012, 0.030, 0.020, -0.03, 0.55, "out"),
    "afro": Style(2600, 0.065, 0.013, 0.042, 0.034, -0.05, 0.60, "out"),
    "bob": Style(1500, -0.02, 0.017, 0.014, 0.012, 0.50, 0.015, "parted", 0.0, 9),
    "fringed bob": Style(1500, -0.03, 0.017, 0.014, 0.012, 0.50, 0.015, "parted", 0.055, 9),
    "long": Style(1700, -0.20, 0.019, 0.014, 0.012, 0.60, 0.014, "parted", 0.0, 11),
    "waves": Style(1700, -0.15, 0.021, 0.017, 0.013, 0.55, 0.075, "parted", 0.0, 11),
    "knot": Style(800, 0.110, 0.013, 0.006, 0.008, 0.06, 0.015, "knot"),
    "tail": Style(800, 0.115, 0.013, 0.006, 0.008, 0.06, 0.015, "knot"),
    "ring": Style(0, 0.015, 0.0042, 0.002, 0.003, 0.06, 0.10),
}


SOFT = " soft"   # what the material of hair is called whose edge is ragged: what is left of it is in its pattern
_EDGE = 0.016    # m, of that
_ROOT = 0.3      # of a hanging lock's width and of how far it is off the head, where it begins
_COIL = 0.6      # of a lock's width, where it is coiled
_PRESSED = 0.25  # of how far it is off the head, below a hat


def hair(bodies, shape, level, name, material, scale, seed, hat=""):
    """Parts of somebody's hair. @param hat what is worn over it, or nothing"""
    if name not in STYLES:
        return []
    style, draw = STYLES[name], numpy.random.default_rng(seed)
    if hat:
        style = replace(style, lift=_PRESSED * style.lift, thick=_PRESSED * style.thick, curl=min(style.curl, 0.1),
                        comb="parted" if style.comb == "out" else style.comb, length=min(style.length, 0.035))
    skin = _skin(bodies, shape, level, style, scale, name == "ring")
    if not len(skin.faces):
        return []
    parts = [replace(skin, material=material + (SOFT if level < 0 else ""))]
    count = 0 if _is_cap(style, level) else int(style.count * levels.DETAILS[level].locks)
    if style.length < 0.0 and level == 2:
        count = 12
    if count:
        hangs = style.length < 0.0
        count = int(count * (0.95 if hangs else 1.0))
        widest = 0.066 if hangs or level > 0 else 0.050
        wider = min((style.count / count) ** 0.5, widest / style.wide)
        parts.append(_locks(bodies, shape, level, style, material, scale, draw, count, wider, name == "ring"))
    if name in ("knot", "tail") and level < 2:
        parts.append(_knot(bodies, shape, level, name, material, scale))
    return parts


def _is_cap(style, level):
    """Whether the skin alone is the hair: few locks of short hair look like leaves."""
    return level >= 0 and style.length > 0.0 and style.comb != "knot"


def _grows(places, style, ring):
    """How far inside of the hairlines."""
    field = numpy.minimum(regions.scalp(places, style.raised), -regions.ear(places) + 0.002)
    return numpy.minimum(field, 0.772 - places[:, regions.Z]) if ring else field  # bald on top


def _scalp(bodies, shape, level, style, ring, further=0.0):
    piece = head_of(bodies, shape, level)
    return clipped(piece, _grows(piece.places, style, ring) + further)


def _skin(bodies, shape, level, style, scale, ring):
    """Thinnest at the hairline, so that no edge shows; near the camera it goes beyond that, and frays."""
    piece = _scalp(bodies, shape, level, style, ring, 0.4 * _EDGE if level < 0 else 0.0)
    if not len(piece.faces):
        return piece
    if level < 0:
        piece = subdivided(piece, 0.2)
    above = _grows(piece.places, style, ring) if level < 0 else regions.scalp(piece.places, style.raised)
    plain = (0.8 if style.comb == "out" else 0.5) * style.lift if _is_cap(style, level) else 0.0  # instead of locks
    thick = (style.thick * (1.0 if level < 1 else 1.35) + plain) * numpy.clip(above / 0.03, 0.04, 1.0) ** 0.8
    if plain and level < 2:  # tufts and curls
        often, size = (95.0, 0.22) if style.comb == "out" else (70.0, 0.12)
        thick = thick * (1.0 + size * numpy.sin(piece.places[:, :3] * often + (0.0, 1.0, 2.0)).sum(axis=1))
    points = piece.points + piece.normals * (thick * scale)[:, None]
    strands = numpy.stack([regions.angle_of(piece.places) / 12.0, piece.places[:, regions.Z] * 5.0], axis=1)
    if level < 2:  # so few points would be drawn into the head
        points = smoothed(points, piece.faces, 1, 0.3)
    found = replace(piece.moved(points), flat=strands)
    if level < 0:  # the third number of the pattern
        found.places[:, regions.X] = numpy.clip((above + 0.4 * _EDGE) / _EDGE, 0.0, 1.0)
    return found


def _ways(style, points, normals, places, crown, back, draw):
    """Which way locks start, along the head."""
    ahead = points[:, 0] > crown[0]
    if style.comb == "back":
        ways = numpy.where(ahead[:, None], (-0.9, 0.0, 0.55), points - crown)
    elif style.comb == "side":
        ways = numpy.where((ahead & (places[:, regions.Z] > 0.775))[:, None], (-0.35, -0.9, 0.15), points - crown)
    elif style.comb == "parted":
        from_face = numpy.where(regions.angle_of(places) < 55.0, -0.9, -0.35)
        ways = numpy.stack([from_face, numpy.sign(points[:, 1] - 0.014) * 1.2, numpy.full(len(points), -0.2)], axis=1)
    elif style.comb == "knot":
        ways = back - points
    elif style.comb == "out":
        return normals + draw.normal(0.0, 0.6, points.shape)
    else:
        ways = points - crown
        ways = ways / (numpy.linalg.norm(ways, axis=1, keepdims=True) + 1e-9) + draw.normal(0.0, 0.22, points.shape)
    ways = ways - normals * (ways * normals).sum(axis=1, keepdims=True)
    return ways / (numpy.linalg.norm(ways, axis=1, keepdims=True) + 1e-9)


def _collider(bodies, shape):
    """(points, normals) of head, neck and upper back, without ears and shoulders."""
    faces = bodies.triangles("body")
    places = regions.places_of(bodies)
    use = numpy.zeros(len(shape), bool)
    use[bodies.vertices_of("body")] = True
    upper = (places[:, regions.HEAD] > 0.3) & (numpy.abs(places[:, 1]) < 0.071)
    below = (places[:, regions.HEAD] <= 0.3) & (places[:, 2] > 0.33) & (numpy.abs(places[:, 1]) < 0.11)
    use &= (upper | below) & (places[:, regions.ARM] < 0.0)
    chosen = numpy.nonzero(use)[0][::3]
    return shape[chosen], normals_of(shape, faces)[chosen]


def _locks(bodies, shape, level, style, material, scale, draw, count, wider, ring):
    scalp = _scalp(bodies, shape, level if level < 1 else 0, style, ring)
    points, normals, weights, places = scattered(scalp, draw, count)
    head = bodies.joint(shape, "head-2")
    low, high = scalp.points[:, 0].min(), scalp.points[:, 0].max()
    crown = numpy.array([low + 0.45 * (high - low), 0.014, head[2]])
    back = numpy.array([low - 0.01, 0.0, head[2] - 0.055 * scale])
    ways = _ways(style, points, normals, places, crown, back, draw)
    above = regions.scalp(places, style.raised)
    if style.length < 0.0:  # cut level
        lowest = bodies.joint(shape, "neck")[2] + style.length * scale
        length = numpy.clip(points[:, 2] - lowest, 0.05, None) * draw.uniform(0.93, 1.06, count) + 0.03
    else:
        length = style.length * scale * numpy.clip(0.35 + above / 0.05, 0.35, 1.0) * draw.uniform(0.75, 1.15, count)
    fringe = numpy.zeros(count, bool)
    if style.fringe:
        fringe = (above < 0.022) & (regions.angle_of(places) < 40.0)
        length = numpy.where(fringe, style.fringe * scale * draw.uniform(0.7, 1.1, count), length)
        aside = numpy.stack([numpy.full(count, 0.5), 0.30 - points[:, 1] * 4.0, numpy.full(count, -0.8)], axis=1)
        ways = numpy.where(fringe[:, None], aside + draw.normal(0.0, 0.12, (count, 3)), ways)
    pieces = max(2, int(style.pieces * levels.DETAILS[level].pieces)) if level < 0 or style.length > 0.0 else 4
    roots = points + normals * style.lift * (0.1 if style.fall >= 0.3 else 0.5)
    line, sides = _grow(roots, ways, length, style, scale, draw, pieces,
                        _collider(bodies, shape), fringe, bodies.joint(shape, "mouth")[2] - 0.03 * scale,
                        bodies.joint(shape, "l-eye")[[0, 2]] + (-0.050 * scale, 0.048 * scale))
    if style.comb == "out" and level < 0:
        line, sides = _coils(roots, ways, 0.8 * length, scale, draw, 2 * pieces + 1)
        wider *= _COIL
    wide = style.wide * wider * scale * draw.uniform(0.7, 1.3, count)
    wide = numpy.where(fringe, numpy.minimum(wide, 0.020 * scale), wide)  # eyes stay free
    return _ribbons(bodies, line, sides, wide, weights, material, draw, level, style)


def _grow(points, ways, length, style, scale, draw, pieces, collider, fringe, chin, brow):
    """Lines of pieces + 1 points, and the normals of the head beside them."""
    near, normals = collider
    lift = style.lift * scale * draw.uniform(0.45, 1.35, len(points))
    fall = numpy.where(fringe, 0.30, style.fall)[:, None]
    ways = ways / (numpy.linalg.norm(ways, axis=1, keepdims=True) + 1e-9)
    line, sides = [], []
    # where locks bend round the head, their pieces are short
    steps = numpy.diff((numpy.arange(pieces + 2) / pieces) ** (1.5 if style.fall >= 0.5 else 1.0))
    for piece in range(pieces + 1):
        nearest = ((points[:, None] - near[None]) ** 2).sum(axis=2).argmin(axis=1)
        out = normals[nearest]
        off = ((points - near[nearest]) * out).sum(axis=1)
        wanted = lift * (1.0 - 0.4 * piece / pieces)
        if style.fall >= 0.3:  # roots lie flat: locks that begin on top of others would look like leaves
            wanted = wanted * min(1.0, _ROOT + 0.4 * piece)
        pull = 0.0 if style.comb == "out" else numpy.where(points[:, 2] > chin, 0.05, 0.01)
        points = points + out * numpy.clip(wanted - off, -pull, 0.04)[:, None]
        if style.fall >= 0.5:  # below the chin, beside the neck and not out on the shoulders
            points = _beside(points, chin, brow, scale)
        line.append(points)
        sides.append(out)
        if style.fall >= 0.5:  # what hangs does not fly
            ways = ways * (0.70, 0.70, 1.0)
        ways = ways + numpy.array([0.0, 0.0, -1.0]) * fall * (8.0 / pieces if pieces < 8 else 1.0)
        curl = style.curl * (piece / pieces if style.fall >= 0.3 else 1.0)  # long hair curls below
        ways = ways + draw.normal(0.0, 0.04 + curl, ways.shape)
        ways = ways - out * numpy.minimum(0.0, (ways * out).sum(axis=1))[:, None]
        ways /= numpy.linalg.norm(ways, axis=1, keepdims=True) + 1e-9
        points = points + ways * (length * steps[piece])[:, None]
    line = numpy.stack(line, axis=1)
    if style.fall >= 0.3:  # heavy hair has no kinks
        for _ in range(3):
            line[:, 1:-1] = 0.5 * line[:, 1:-1] + 0.25 * (line[:, :-2] + line[:, 2:])
    return line, numpy.stack(sides, axis=1)


def _coils(roots, ways, length, scale, draw, pieces):
    """Lines and sides as _grow() has them, of locks that stand off the head as coils."""
    count = len(roots)
    ways = ways / (numpy.linalg.norm(ways, axis=1, keepdims=True) + 1e-9)
    across = numpy.cross(ways, draw.normal(0.0, 1.0, ways.shape))
    across /= numpy.linalg.norm(across, axis=1, keepdims=True) + 1e-9
    other = numpy.cross(ways, across)
    share = numpy.linspace(0.0, 1.0, pieces + 1)[None, :]
    angle = (draw.uniform(1.1, 1.7, count) * draw.choice((-2.0 * numpy.pi, 2.0 * numpy.pi), count))[:, None] * share
    size = scale * draw.uniform(0.006, 0.010, count)[:, None] * numpy.minimum(1.0, 3.0 * share)
    out = numpy.cos(angle)[..., None] * across[:, None] + numpy.sin(angle)[..., None] * other[:, None]
    line = roots[:, None] + ways[:, None] * (length[:, None] * share)[..., None] + out * size[..., None]
    return line, out


def _beside(points, chin, brow, scale):
    """What hangs, beside the neck and not out on the shoulders, and beside the face: behind the cheeks."""
    points = points.copy()
    low = numpy.clip((chin - points[:, 2]) / (0.06 * scale), 0.0, 1.0)
    wide = numpy.abs(points[:, 1]) / (0.088 * scale)
    points[:, 1] /= 1.0 + low * (numpy.maximum(wide, 1.0) - 1.0)
    points[:, 1] = numpy.clip(points[:, 1], -0.094 * scale, 0.094 * scale)
    below = points[:, 2] < brow[1]
    before = below & (points[:, 0] > brow[0])
    aside = numpy.maximum(numpy.abs(points[:, 1]), 0.068 * scale)
    points[:, 1] = numpy.where(before, numpy.copysign(aside, points[:, 1] - 0.014), points[:, 1])
    back = numpy.clip((brow[1] - points[:, 2]) / (0.05 * scale), 0.0, 1.0) * 0.6
    points[:, 0] -= numpy.where(before, back * (points[:, 0] - brow[0]), 0.0)
    return points


def _ribbons(bodies, line, out, wide, weights, material, draw, level, style):
    """Locks as ribbons that narrow to a tip; near ones are bent across, so that light runs over them."""
    count, pieces, _ = line.shape
    along = numpy.gradient(line, axis=1)
    side = numpy.cross(along, out)
    side /= numpy.linalg.norm(side, axis=2, keepdims=True) + 1e-9
    share, taper = numpy.linspace(0.0, 1.0, pieces), 0.85 if style.length > 0.0 else 0.62
    narrow = 1.0 - taper * share ** 2.2
    if style.fall >= 0.3:
        narrow = narrow * numpy.minimum(1.0, _ROOT + 5.0 * share)
    half = 0.5 * wide[:, None, None] * narrow[None, :, None]
    rows = [line - side * half, line + side * half]
    if level < 0 and style.comb != "out":
        rows = [rows[0] - out * half * 0.35, line + out * half * 0.3, rows[1] - out * half * 0.35]
    across = len(rows)
    points = numpy.stack(rows, axis=2)
    number = numpy.arange(count * pieces * across).reshape(count, pieces, across)
    a, b = number[:, :-1, :-1].ravel(), number[:, :-1, 1:].ravel()
    c, d = number[:, 1:, 1:].ravel(), number[:, 1:, :-1].ravel()
    faces = numpy.concatenate([numpy.stack([a, b, c], axis=1), numpy.stack([a, c, d], axis=1)])
    flat = numpy.broadcast_to((draw.random(count) * 9.0)[:, None, None], (count, pieces, across))
    flat = numpy.stack([flat + numpy.linspace(0.0, 0.6, across), numpy.broadcast_to(share[None, :, None], flat.shape)],
                       axis=-1).reshape(-1, 2)
    weights = numpy.repeat(weights, pieces * across, axis=0)
    points = points.reshape(-1, 3)
    if style.length < 0.0:  # what lies on the back goes with it
        neck = line[:, 0, 2].min()
        lower = numpy.clip((neck - points[:, 2]) / 0.10, 0.0, 0.85)[:, None]
        back = numpy.zeros_like(weights)
        back[:, bodies.bone["spine_03"]] = 1.0
        weights = weights * (1.0 - lower) + back * lower
    places = numpy.zeros((len(points), 5))
    places[:, regions.ARM] = -1.0
    if level < 0:  # edges and ends are of single hairs
        edge = numpy.array([0.10, 0.85, 0.10] if across == 3 else [0.55, 0.55])[None, None, :]
        ends = 1.0 - 0.9 * share ** 1.5
        if style.length > 0.0:
            ends = numpy.minimum(0.2 + 4.0 * share, ends)
        places[:, regions.X] = numpy.broadcast_to(edge * ends[None, :, None], (count, pieces, across)).ravel()
    return Part(faces, points, weights, places, material + (SOFT if level < 0 else ""), flat=flat)


def _knot(bodies, shape, level, name, material, scale):
    """A ball of hair at the back of the head, or a tail that hangs from there."""
    scalp = regions.scalp(regions.places_of(bodies)) > 0.0
    head, back = bodies.joint(shape, "head-2"), shape[scalp & (bodies.weights[:, bodies.bone["head"]] > 0.5), 0].min()
    middle = numpy.array([back - 0.012 * scale, 0.0, head[2] - 0.050 * scale])
    around, rows = (16, 9) if level < 0 else (7, 5)
    spots, flat, faces = [], [], []
    for row in range(rows + 1):
        share = row / rows
        for spoke in range(around):
            angle = 2.0 * numpy.pi * spoke / around
            if name == "knot":
                bump = 1.0 + 0.07 * numpy.sin(5.0 * angle + 9.0 * share)
                size = 0.040 * scale * bump * numpy.sin(numpy.pi * (0.04 + 0.92 * share))
                ahead = -0.032 * scale * numpy.cos(numpy.pi * share)
                spot = middle + (ahead, size * numpy.cos(angle), size * numpy.sin(angle))
            else:
                size = 0.026 * scale * (0.35 + share) * (1.0 - share) ** 0.5 * 1.5 + 0.003
                sag = numpy.array([-0.055 * numpy.sin(2.2 * share), 0.0, 0.02 * (1.0 - share) - 0.23 * share ** 1.4])
                spot = middle + scale * sag + (size * numpy.cos(angle), size * numpy.sin(angle), 0.0)
            spots.append(spot)
            flat.append((angle * 1.9, share))
            if row < rows:
                a, b = row * around, (row + 1) * around
                after = (spoke + 1) % around
                faces += [(a + spoke, a + after, b + after), (a + spoke, b + after, b + spoke)]
    return loose(bodies, numpy.array(spots), numpy.array(faces), "head", material, numpy.array(flat))
