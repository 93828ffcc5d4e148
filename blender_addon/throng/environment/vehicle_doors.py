# SPDX-License-Identifier: Apache-2.0
"""Vehicles whose doors open: a body that one looks into through them, and the leaves, front towards +x."""
import bpy
import numpy

from . import materials
from .shapes import Shape
from .tracks import fill

FLOOR, _SKIRT, _LINTEL = 0.05, 0.10, 2.20  # m over the ground
ABOARD = 2                                  # column of doors.npy
_SILL, _TOP = 1.0, 2.45                     # m: of windows
_LEAF = 0.035                               # m, thick
_OUT = 0.06                                 # m: leaves come out so far before they slide
_PANE, _BETWEEN = 1.5, 0.14                 # m
_LOOKS = {"bus": ((0.30, 0.035, 0.030), (0.35, 0.35, 0.34)), "tram": ((0.52, 0.47, 0.36), (0.24, 0.24, 0.24)),
          "car": ((0.20, 0.22, 0.25), (0.20, 0.22, 0.25))}


def opens(manifest, number):
    """The doors of the vehicle with a number, or None where it has none that people use."""
    listed = (manifest.get("doors") or {}).get("list") or []
    doors = listed[number] if number < len(listed) else None
    return doors if doors and doors["at"] and manifest["vehicles"]["list"][number]["kind"] != "car" else None


def body_with(what, doors):
    """The mesh of a bus or tram round the openings of its doors."""
    kind, x1, y1, high = what["kind"], 0.5 * what["length"], 0.5 * what["width"], float(what["height"])
    paint = materials.plain(f"{kind} paint", _LOOKS[kind][0], 0.25)
    roof = materials.plain(f"{kind} roof", _LOOKS[kind][1], 0.6)
    shape = Shape(f"Throng {kind} with doors")
    nose, narrow = 0.3, 0.12
    outline = [(-x1, -y1 + narrow), (-x1 + nose, -y1), (x1 - nose, -y1), (x1, -y1 + narrow),
               (x1, y1 - narrow), (x1 - nose, y1), (-x1 + nose, y1), (-x1, y1 - narrow)]
    shape.prism(outline, high - 0.12, high, paint, roof)
    shape.flat(outline, high - 0.2, materials.glowing("vehicle ceiling", (0.9, 0.86, 0.78), 2.0))
    shape.prism(outline, FLOOR - 0.02, FLOOR, materials.plain("vehicle floor", (0.10, 0.10, 0.11), 0.8))
    eaves = high - 0.12
    for a, b in ((1, 0), (2, 3), (5, 4), (6, 7)):
        _wall(shape, outline[a], outline[b], _SKIRT, eaves, paint)
    for x in (x1, -x1):
        _wall(shape, (x, -y1 + narrow), (x, y1 - narrow), _SKIRT, eaves, paint)
    for side in (-1.0, 1.0):
        has = doors["left"] if side > 0.0 else doors["right"]
        _side(shape, x1 - nose, side * y1, eaves, _middles(what, doors) if has else [], float(doors["width"]), paint)
    if kind == "tram":
        _bellows(shape, y1, high, _middles(what, doors), float(doors["width"]))
    _poles(shape, _middles(what, doors), float(doors["width"]), high)
    for x, radius, half_track, _ in axles_of(kind):
        _housings(shape, x, radius, half_track, y1)
    return shape


def _middles(what, doors):
    return sorted(0.5 * what["length"] - at for at in doors["at"])


def _housings(shape, x, radius, half_track, y):
    """Boxes over the wheels of an axle, on which seats would stand."""
    grey, long = materials.plain("vehicle seat", (0.05, 0.07, 0.12), 0.7), radius + 0.06
    for side in (-1.0, 1.0):
        near, far = side * (half_track - 0.3), side * (y - 0.02)
        box = [(x - long, near), (x + long, near), (x + long, far), (x - long, far)]
        shape.prism(box, FLOOR, 2.0 * radius + 0.06, grey)


def axles_of(kind):
    """As vehicle_shapes.body_of() has them, clear of doors."""
    if kind == "bus":
        return (3.0, 0.48, 1.20, 0.28), (-2.85, 0.48, 1.20, 0.28)
    return tuple((x, 0.33, 0.92, 0.14) for x in (12.6, 11.4, 0.9, -0.9, -11.4, -12.6))


def _wall(shape, a, b, low, high, material):
    shape.face([(*a, low), (*b, low), (*b, high), (*a, high)], material)


def _side(shape, x1, y, high, doors, width, paint):
    """A long side between its doors, with windows."""
    glass = materials.clear("vehicle window", (0.030, 0.038, 0.040), 0.45)
    edges = [-x1] + [x for middle in doors for x in (middle - 0.5 * width, middle + 0.5 * width)] + [x1]
    for begin, end in zip(edges[::2], edges[1::2]):
        count = int((end - begin - _BETWEEN) / (_PANE + _BETWEEN))
        step = (end - begin - _BETWEEN) / max(count, 1)
        panes = [(x, x + step - _BETWEEN) for x in (begin + _BETWEEN + i * step for i in range(count))]
        for low, top in ((_SKIRT, _SILL), (_TOP, high)):
            _wall(shape, (begin, y), (end, y), low, top, paint)
        for left, right in zip([begin, *(pane[1] for pane in panes)], [*(pane[0] for pane in panes), end]):
            _wall(shape, (left, y), (right, y), _SILL, _TOP, paint)
        for left, right in panes:
            _wall(shape, (left, y), (right, y), _SILL, _TOP, glass)
    for middle in doors:
        _wall(shape, (middle - 0.5 * width, y), (middle + 0.5 * width, y), _LINTEL, high, paint)


def _bellows(shape, y, high, doors, width):
    dark = materials.plain("bellows", (0.02, 0.02, 0.02), 0.9)
    for x in (-4.6, 4.6):
        if all(abs(x - door) > 0.5 * width + 0.35 for door in doors):
            for side in (-1.0, 1.0):
                _wall(shape, (x - 0.3, side * (y + 0.012)), (x + 0.3, side * (y + 0.012)), _SKIRT, high, dark)
            shape.flat([(x - 0.3, -y), (x + 0.3, -y), (x + 0.3, y), (x - 0.3, y)], high + 0.01, dark)


def _poles(shape, doors, width, high):
    yellow = materials.plain("vehicle pole", (0.60, 0.42, 0.03), 0.35)
    for middle in doors:
        for x in (middle - 0.5 * width - 0.12, middle + 0.5 * width + 0.12):
            for y in (-0.55, 0.55):
                shape.limb((x, y, FLOOR), (x, y, high - 0.2), 0.018, 0.018, yellow, 8)


def _leaf_mesh(kind, width):
    """One leaf, from its inner edge towards -x, its outside towards -y."""
    leaf = Shape(f"Throng {kind} door")
    frame = materials.plain("car trim", (0.012, 0.012, 0.012), 0.55)
    glass = materials.clear("vehicle window", (0.030, 0.038, 0.040), 0.45)
    half = 0.5 * width
    box = [(-half, -_LEAF), (0.0, -_LEAF), (0.0, 0.0), (-half, 0.0)]
    leaf.prism(box, FLOOR + 0.01, _LINTEL, frame)
    for y in (-_LEAF - 0.004, 0.004):
        _wall(leaf, (-half + 0.06, y), (-0.04, y), 0.35, _LINTEL - 0.1, glass)
    return leaf.to_mesh()


def leaves_of(thing, what, doors, rows, frames):
    """Two objects for each door, with a key a frame: they come out a little and slide apart.

    @param rows of doors.npy, of this vehicle in these frames
    """
    mesh, width = _leaf_mesh(what["kind"], float(doors["width"])), float(doors["width"])
    objects = []
    for side, column, has in ((1.0, 0, doors["left"]), (-1.0, 1, doors["right"])):
        if not has:
            continue
        share = numpy.clip(rows[:, column], 0.0, 1.0)
        out = _OUT * numpy.minimum(share / 0.2, 1.0)
        slid = 0.48 * width * numpy.clip((share - 0.1) / 0.9, 0.0, 1.0)
        for middle in _middles(what, doors):
            for way in (-1.0, 1.0):
                leaf = bpy.data.objects.new(f"{thing.name} door", mesh)
                leaf.parent = thing
                # towards -x and out to -y as it is, or turned half round
                leaf.scale = (-way, -side, 1.0)
                places = numpy.zeros((len(frames), 3))
                places[:, 0] = middle + way * slid
                places[:, 1] = side * (0.5 * what["width"] + out)
                fill(leaf, "location", frames, places)
                objects.append(leaf)
    return objects
