# SPDX-License-Identifier: Apache-2.0
"""Meshes of buses, trams and bicycles with riders, and of wheels, front towards +x, round the middle of the ground that
they cover. Cars are those of cars.py."""
import math

from . import cars, materials, vehicle_doors
from .shapes import Shape

_AXLE_SIDES = 18


def body_of(kind, number, what=None, doors=None):
    """(mesh without wheels, axles) of the vehicle with a number; an axle is (x, radius of its wheels, half of how far
    apart they are, how broad they are).

    @param what, doors as the manifest has them, of one whose doors open
    """
    if doors:
        shape = vehicle_doors.body_with(what, doors)
        _ends(shape, 0.5 * what["length"], 0.5 * what["width"], 1.05, 2.7)
        return shape.to_mesh(), vehicle_doors.axles_of(kind)
    if kind == "bus":
        return _bus(), ((3.35, 0.48, 1.20, 0.28), (-2.85, 0.48, 1.20, 0.28))
    if kind == "tram":
        return _tram(), tuple((x, 0.33, 0.92, 0.14) for x in (11.1, 9.3, 0.9, -0.9, -9.3, -11.1))
    if kind == "bicycle":
        return _bicycle(), ((0.52, 0.34, 0.0, 0.035), (-0.52, 0.34, 0.0, 0.035))
    car = ("saloon", "hatchback", "saloon")[number % 3]
    return cars.build_body(car), cars.axles_of(car)


def build_axle(radius, half_track, broad):
    """Both wheels of an axle, or the one of a bicycle, round the axle."""
    name = f"Throng axle {radius:.2f} {half_track:.2f}"
    shape, tyre = Shape(name), materials.plain("tyre", (0.018, 0.018, 0.018), 0.9)
    rim = materials.plain("rim", (0.32, 0.32, 0.33), 0.35)
    if half_track == 0.0:
        _ring(shape, radius, radius - 0.03, 0.0, 0.5 * broad, tyre)
        for i in range(6):
            _rod(shape, (0.0, 0.0, 0.0), (0.95 * radius * math.cos(math.tau * i / 6), 0.0,
                                          0.95 * radius * math.sin(math.tau * i / 6)), 0.005, rim, 4)
        return shape.to_mesh()
    for side in (-1.0, 1.0):
        inner, outer = side * (half_track - broad), side * half_track
        _tread(shape, radius, inner, outer, tyre, side)
        _disc(shape, radius, outer, tyre, side)
        _spokes(shape, 0.62 * radius, outer + side * 0.006, rim, side)
    return shape.to_mesh()


def _at(radius, angle, y):
    return (radius * math.cos(angle), y, radius * math.sin(angle))


def _steps(count=_AXLE_SIDES):
    angles = [math.tau * i / count for i in range(count)]
    return list(zip(angles, angles[1:] + [math.tau]))


def _tread(shape, radius, inner, outer, material, side):
    for a, b in _steps():
        quad = [_at(radius, a, outer), _at(radius, b, outer), _at(radius, b, inner), _at(radius, a, inner)]
        shape.face(quad if side < 0.0 else quad[::-1], material)


def _disc(shape, radius, y, material, side):
    ring = [_at(radius, a, y) for a, _ in _steps()]
    shape.face(ring if side < 0.0 else ring[::-1], material)


def _spokes(shape, radius, y, material, side):
    """Five of them: one sees that a wheel turns."""
    for i in range(5):
        middle = math.tau * i / 5
        quad = [(0.0, y, 0.0)] + [_at(radius, middle + turn, y) for turn in (-0.38, 0.0, 0.38)]
        shape.face(quad if side < 0.0 else quad[::-1], material)


def _ring(shape, outer, inner, y, half, material):
    for a, b in _steps(24):
        for near, far, low, high in ((outer, outer, -half, half), (inner, inner, half, -half),
                                     (inner, outer, half, half), (outer, inner, -half, -half)):
            shape.face([_at(near, a, y + low), _at(near, b, y + low), _at(far, b, y + high), _at(far, a, y + high)],
                       material)


def _rod(shape, a, b, radius, material, sides=8):
    """A rod between two places, ends flat."""
    start, end = shape.limb(a, b, radius, radius, material, sides)
    shape.face(start[::-1], material)
    shape.face(end, material)


def _ball(shape, middle, radius, material, sides=10, rings=6):
    def place(ring, side):
        up, round_ = math.pi * ring / rings - 0.5 * math.pi, math.tau * side / sides
        return tuple(m + radius * d for m, d in zip(middle, (math.cos(up) * math.cos(round_),
                                                             math.cos(up) * math.sin(round_), math.sin(up))))

    for ring in range(rings):
        for side in range(sides):
            corners = [place(ring, side), place(ring, side + 1), place(ring + 1, side + 1), place(ring + 1, side)]
            shape.face([c for i, c in enumerate(corners) if i == 0 or c != corners[i - 1]], material)


def _bus():
    shape = Shape("Throng bus")
    paint, roof = materials.plain("bus paint", (0.30, 0.035, 0.030), 0.25), materials.plain("bus roof",
                                                                                          (0.35, 0.35, 0.34), 0.5)
    _hull(shape, 6.0, 1.25, 0.30, 3.05, paint, roof)
    _glazing(shape, 6.0, 1.25, 1.15, 2.45, ((-5.7, -3.9), (-3.8, -2.2), (-0.9, 0.9), (1.0, 2.9), (4.9, 5.75)))
    _doors(shape, 1.25, 0.35, 2.45, ((3.05, 4.75), (-2.1, -1.0)))
    _ends(shape, 6.0, 1.25, 1.05, 2.75)
    return shape.to_mesh()


def _tram():
    shape = Shape("Throng tram")
    paint, roof = materials.plain("tram paint", (0.52, 0.47, 0.36), 0.25), materials.plain("tram roof",
                                                                                           (0.24, 0.24, 0.24), 0.6)
    dark = materials.plain("bellows", (0.02, 0.02, 0.02), 0.9)
    for low, high in ((-14.0, -4.9), (-4.3, 4.3), (4.9, 14.0)):
        middle = 0.5 * (low + high)
        _hull(shape, 0.5 * (high - low), 1.2, 0.22, 3.35, paint, roof, middle, tapered=(low == -14.0, high == 14.0))
    for x in (-4.6, 4.6):
        shape.prism([(x - 0.32, -1.08), (x + 0.32, -1.08), (x + 0.32, 1.08), (x - 0.32, 1.08)], 0.35, 3.2, dark)
    panes = [(x, x + 1.55) for x in (-12.6, -9.1, -7.3, -3.9, -0.8, 2.35, 5.7, 7.5, 11.0)]
    _glazing(shape, 14.0, 1.2, 1.0, 2.55, panes)
    _doors(shape, 1.2, 0.28, 2.55, ((-10.85, -9.3), (-2.2, -0.95), (0.95, 2.2), (9.3, 10.85)), both=True)
    _ends(shape, 14.0, 1.2, 1.05, 2.7)
    return shape.to_mesh()


def _hull(shape, half_length, half_width, low, high, paint, roof, middle=0.0, tapered=(True, True)):
    """A box with ends that narrow a little."""
    back, front = (0.12 if end else 0.0 for end in tapered)
    x0, x1 = middle - half_length, middle + half_length
    outline = [(x0, -half_width + back), (x0 + 2.5 * back, -half_width), (x1 - 2.5 * front, -half_width),
               (x1, -half_width + front), (x1, half_width - front), (x1 - 2.5 * front, half_width),
               (x0 + 2.5 * back, half_width), (x0, half_width - back)]
    outline = [p for i, p in enumerate(outline) if p != outline[i - 1]]
    shape.prism(outline, low, high, paint, roof)


def _side_pane(shape, x0, x1, y, low, high, material):
    quad = [(x0, y, low), (x1, y, low), (x1, y, high), (x0, y, high)]
    shape.face(quad if y < 0.0 else quad[::-1], material)


def _glazing(shape, half_length, half_width, low, high, panes):
    glass = materials.plain("car glass", (0.012, 0.015, 0.018), 0.05)
    for x0, x1 in panes:
        for side in (-1.0, 1.0):
            _side_pane(shape, x0, x1, side * (half_width + 0.006), low, high, glass)


def _doors(shape, half_width, low, high, places, both=False):
    """Where people get on: on the right, or on both sides."""
    glass = materials.plain("car glass", (0.012, 0.015, 0.018), 0.05)
    frame = materials.plain("car trim", (0.012, 0.012, 0.012), 0.55)
    for x0, x1 in places:
        for side in (-1.0, 1.0) if both else (-1.0,):
            _side_pane(shape, x0, x1, side * (half_width + 0.005), low, high, frame)
            middle = 0.5 * (x0 + x1)
            for a, b in ((x0 + 0.07, middle - 0.03), (middle + 0.03, x1 - 0.07)):
                _side_pane(shape, a, b, side * (half_width + 0.010), low + 0.25, high - 0.1, glass)


def _ends(shape, half_length, half_width, low, high):
    glass = materials.plain("car glass", (0.012, 0.015, 0.018), 0.05)
    white = materials.plain("headlamp", (0.62, 0.63, 0.62), 0.1)
    red = materials.plain("tail lamp", (0.28, 0.008, 0.006), 0.2)
    for forward, lamp in ((1.0, white), (-1.0, red)):
        x, half = forward * (half_length + 0.008), half_width - 0.22
        panes = [((-half, low), (half, high), glass)]
        panes += [((side * half - 0.16, 0.62), (side * half + 0.16, 0.78), lamp) for side in (-1.0, 1.0)]
        for (y0, z0), (y1, z1), material in panes:
            quad = [(x, y0, z0), (x, y1, z0), (x, y1, z1), (x, y0, z1)]
            shape.face(quad if forward > 0.0 else quad[::-1], material)


def _bicycle():
    """And who rides it, in everyday clothes."""
    shape, frame = Shape("Throng bicycle"), materials.plain("bicycle frame", (0.03, 0.10, 0.12), 0.3)
    for a, b in (((-0.52, 0, 0.34), (-0.05, 0, 0.30)), ((-0.05, 0, 0.30), (0.36, 0, 0.78)),
                 ((-0.05, 0, 0.30), (-0.20, 0, 0.88)), ((-0.17, 0, 0.76), (0.34, 0, 0.84)),
                 ((-0.52, 0, 0.34), (-0.17, 0, 0.76)), ((0.52, 0, 0.34), (0.33, 0, 0.98)),
                 ((0.33, -0.24, 1.02), (0.33, 0.24, 1.02)), ((-0.32, 0, 0.90), (-0.08, 0, 0.90))):
        _rod(shape, a, b, 0.016, frame)
    cloth, jeans = materials.plain("rider's jacket", (0.11, 0.13, 0.10), 0.8), materials.plain(
        "rider's jeans", (0.03, 0.04, 0.07), 0.85)
    skin, hair = materials.plain("rider's skin", (0.45, 0.28, 0.20), 0.55), materials.plain("rider's hair",
                                                                                          (0.03, 0.02, 0.015), 0.7)
    _rod(shape, (-0.19, 0, 0.92), (-0.10, 0, 1.15), 0.155, cloth, 12)
    _rod(shape, (-0.10, 0, 1.15), (0.02, 0, 1.42), 0.165, cloth, 12)
    for side, knee, foot in ((-1.0, (0.20, 0.72), (0.02, 0.18)), (1.0, (0.13, 0.90), (-0.10, 0.45))):
        y = 0.10 * side
        _rod(shape, (-0.17, y, 0.93), (knee[0], y, knee[1]), 0.075, jeans, 10)
        _rod(shape, (knee[0], y, knee[1]), (foot[0], y, foot[1]), 0.052, jeans, 10)
        _rod(shape, (foot[0] - 0.06, y, foot[1] - 0.05), (foot[0] + 0.17, y, foot[1] - 0.05), 0.045, hair, 8)
        _ball(shape, (0.01, 0.19 * side, 1.40), 0.075, cloth)
        _rod(shape, (0.01, 0.19 * side, 1.40), (0.16, 0.24 * side, 1.19), 0.048, cloth)
        _rod(shape, (0.16, 0.24 * side, 1.19), (0.32, 0.21 * side, 1.05), 0.038, cloth)
        _ball(shape, (0.33, 0.20 * side, 1.04), 0.045, skin)
    _rod(shape, (0.02, 0, 1.42), (0.06, 0, 1.54), 0.055, skin)
    _ball(shape, (0.08, 0, 1.62), 0.105, skin, 12, 8)
    _ball(shape, (0.055, 0, 1.65), 0.112, hair, 12, 8)
    return shape.to_mesh()
