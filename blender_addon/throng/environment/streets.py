# SPDX-License-Identifier: Apache-2.0
"""Ground, roads and areas. Flat things lie millimetres apart: ground, areas, roads, markings, from below."""
from ..setting import horizon
from . import materials
from .shapes import Shape, counter_clockwise, direction
from .weather import weathered

GROUND_Z, AREA_Z, ROAD_Z, MARK_Z = -0.012, -0.004, 0.0, 0.004
KERB_HEIGHT = 0.10


_PAVED = 26.0  # m round everything; fields begin beyond


def build_ground(manifest):
    bounds = manifest.get("bounds") or {}
    low, high = (tuple(bounds.get(key, fallback))[:2]
                 for key, fallback in (("min", (-50.0, -50.0)), ("max", (50.0, 50.0))))
    far = 3.0 * max(high[0] - low[0], high[1] - low[1], 100.0)
    paving = materials.slabs("pavement", (0.185, 0.180, 0.168), (0.105, 0.102, 0.097), 0.9)
    material = weathered(materials.outskirts(paving, low, high, _PAVED))
    border = horizon.rectangle((low[0] - far, low[1] - far), (high[0] + far, high[1] + far))
    ground = Shape("Throng ground")
    ground.flat(border, GROUND_Z, material)
    return [ground.to_object(), build_country([(x, y, GROUND_Z) for x, y in border], material)]


def build_country(border, material, lid=False):
    """What is round a place, out to the horizon, as an object."""
    corners, quads = horizon.country(border)
    shape = Shape("Throng surroundings")
    shape.vertices, shape.faces = corners, quads
    shape.slots = [shape.slot(material)] * len(quads)
    if lid:
        shape.flat([p[:2] for p in border], border[0][2], material)
    thing = shape.to_object()
    thing.data.polygons.foreach_set("use_smooth", [True] * len(thing.data.polygons))
    return thing


def _pieces(road):
    """The road's straight pieces as (a, b, unit vector, length)."""
    line = [tuple(point[:2]) for point in road["centreline"]]
    return [(a, b, *direction(a, b)) for a, b in zip(line, line[1:])]


def _rectangle(a, along, start, end, low, high):
    """Corners of a box in a road piece's own frame: from start to end along it, low to high across it, to the left."""
    side = (-along[1], along[0])
    return [(a[0] + along[0] * s + side[0] * t, a[1] + along[1] * s + side[1] * t)
            for s, t in ((start, low), (end, low), (end, high), (start, high))]


def _junctions(roads):
    """Where pieces of different roads cross: (road index, piece index) -> [(distance along the piece,
    half width of the gap)]."""
    found = {}
    pieces = [(i, j, piece, 0.5 * float(road["width"])) for i, road in enumerate(roads)
              for j, piece in enumerate(_pieces(road))]
    for i, j, (a, _, u, size), _ in pieces:
        for k, _, (c, _, v, other_size), half in pieces:
            turn = u[0] * v[1] - u[1] * v[0]
            if k == i or abs(turn) < 0.2:
                continue
            ox, oy = c[0] - a[0], c[1] - a[1]
            s, t = (ox * v[1] - oy * v[0]) / turn, (ox * u[1] - oy * u[0]) / turn
            if -half <= s <= size + half and -1.0 <= t <= other_size + 1.0:
                found.setdefault((i, j), []).append((s, half / abs(turn)))
    return found


def build_streets(geometry):
    roads = [road for road in geometry.get("roads", []) if len(road["centreline"]) > 1]
    asphalt, paint, kerb = (weathered(material) for material in (
        materials.mottled("asphalt", (0.040, 0.041, 0.043), (0.075, 0.075, 0.076), 0.25, 0.9, 60.0, 0.12),
        materials.mottled("paint", (0.42, 0.42, 0.40), (0.70, 0.70, 0.68), 3.0, 0.7, 30.0),
        materials.mottled("kerb", (0.30, 0.295, 0.285), (0.40, 0.395, 0.38), 2.0)))
    objects = []
    for i, area in enumerate(geometry.get("areas", [])):
        shape = Shape(f"Throng area {area.get('id', '')}")
        shape.flat(counter_clockwise(area["polygon"]), AREA_Z - 0.0002 * (i % 16),  # areas may lie in each other
                   weathered(materials.slabs("plaza", (0.190, 0.175, 0.153), (0.115, 0.107, 0.096), 0.6)))
        objects.append(shape.to_object())
    junctions = _junctions(roads)
    for i, road in enumerate(roads):
        shape = Shape(f"Throng road {road.get('id', i)}")
        half = 0.5 * float(road["width"])
        for j, (a, _, along, size) in enumerate(_pieces(road)):
            shape.flat(_rectangle(a, along, 0.0, size, -half, half), ROAD_Z - 0.0005 * i, asphalt)
            gaps = sorted((s - h, s + h) for s, h in junctions.get((i, j), []))
            _markings(shape, a, along, size, half, gaps, paint, bool(road.get("one_way")))
            _kerbs(shape, a, along, size, half, gaps, kerb)
        objects.append(shape.to_object())
    return objects


def _free(size, gaps, margin):
    """The stretches of [0, size] outside the gaps and their margins."""
    start, result = 0.0, []
    for low, high in gaps:
        if low - margin > start:
            result.append((start, low - margin))
        start = max(start, high + margin)
    if start < size:
        result.append((start, size))
    return result


def _kerbs(shape, a, along, size, half, gaps, kerb):
    for start, end in _free(size, gaps, 0.0):
        for side in (-1.0, 1.0):
            low, high = sorted((side * half, side * (half + 0.28)))
            shape.prism(_rectangle(a, along, start, end, low, high), GROUND_Z, 0.035, kerb)


def _markings(shape, a, along, size, half, gaps, paint, one_way):
    stripe, pitch = 0.5, 1.0
    for low, high in gaps:  # a zebra crossing on every arm of a junction
        for start in (low - 4.4, high + 0.9):
            if start < 0.0 or start + 3.5 > size:
                continue
            at = -half + 0.5
            while at + stripe <= half - 0.3:
                shape.flat(_rectangle(a, along, start, start + 3.5, at, at + stripe), MARK_Z, paint)
                at += pitch
            stop = start - 1.1 if start < low else start + 3.5 + 0.75
            if 0.0 <= stop <= size:
                shape.flat(_rectangle(a, along, stop, stop + 0.35, -half + 0.3, half - 0.3), MARK_Z, paint)
    for start, end in _free(size, gaps, 6.5):
        for side in (-1.0, 1.0):  # edge lines
            shape.flat(_rectangle(a, along, start, end, side * (half - 0.35) - 0.06, side * (half - 0.35) + 0.06),
                       MARK_Z, paint)
        if one_way or half < 2.5:
            continue
        at = start + 1.0
        while at + 2.0 < end:  # a broken centre line
            shape.flat(_rectangle(a, along, at, at + 2.0, -0.07, 0.07), MARK_Z, paint)
            at += 5.0
