# SPDX-License-Identifier: Apache-2.0
"""Parked cars, some hundred faces each; the paint's colour goes by the object."""
import math

import bpy

from . import materials
from .shading import Shading
from .shapes import Shape

_PAINTS = ((0.55, 0.55, 0.54), (0.012, 0.012, 0.014), (0.16, 0.17, 0.18), (0.30, 0.31, 0.32), (0.020, 0.045, 0.13),
           (0.23, 0.012, 0.012), (0.62, 0.60, 0.55), (0.045, 0.075, 0.055))

# Stations from front to back: (x, lowest, belt, top, half width, half width of the top), in metres. Where the top is
# the belt there is a bonnet or a boot, elsewhere a cabin with windows.
_BODIES = {
    "hatchback": ((2.02, 0.34, 0.60, 0.62, 0.74, 0.70), (1.92, 0.26, 0.74, 0.76, 0.84, 0.76),
                  (1.05, 0.24, 0.92, 0.95, 0.88, 0.76), (0.28, 0.24, 0.95, 1.43, 0.89, 0.62),
                  (-1.15, 0.24, 0.97, 1.45, 0.89, 0.62), (-1.80, 0.26, 0.98, 1.12, 0.87, 0.68),
                  (-1.96, 0.34, 0.86, 0.90, 0.80, 0.70)),
    "saloon": ((2.26, 0.34, 0.58, 0.60, 0.76, 0.72), (2.14, 0.26, 0.72, 0.75, 0.86, 0.78),
               (1.08, 0.22, 0.90, 0.93, 0.90, 0.78), (0.30, 0.22, 0.93, 1.40, 0.91, 0.62),
               (-0.95, 0.22, 0.95, 1.41, 0.91, 0.62), (-1.62, 0.22, 0.96, 1.00, 0.90, 0.76),
               (-2.16, 0.28, 0.92, 0.95, 0.87, 0.78), (-2.28, 0.38, 0.78, 0.82, 0.80, 0.72)),
    "van": ((2.28, 0.34, 0.80, 0.84, 0.84, 0.80), (2.16, 0.26, 1.00, 1.05, 0.92, 0.84),
            (1.62, 0.24, 1.14, 1.20, 0.94, 0.82), (0.95, 0.24, 1.16, 1.94, 0.95, 0.80),
            (-2.10, 0.24, 1.20, 1.98, 0.95, 0.82), (-2.28, 0.34, 1.18, 1.86, 0.92, 0.80)),
}
_CABINS = {"hatchback": (2, 5), "saloon": (2, 5), "van": (2, 4)}  # first and last station whose tops are windows' edges
_WHEEL, _TREAD = 0.32, 0.20


def build_car(kind):
    """A mesh, front towards +x."""
    shape = _body(kind, f"Throng {kind}")
    for x, _, half, _ in axles_of(kind):
        for side in (-1.0, 1.0):
            _wheel(shape, x, side, half, _dark())
    _lights(shape, _BODIES[kind])
    return shape.to_mesh()


def build_body(kind):
    """The same without wheels, for cars that drive."""
    shape = _body(kind, f"Throng {kind} without wheels")
    for x, radius, half, _ in axles_of(kind):
        for side in (-1.0, 1.0):
            _disc(shape, x, side * (half + 0.004), radius + 0.02, radius + 0.06, _dark(), side)
    _lights(shape, _BODIES[kind])
    return shape.to_mesh()


def axles_of(kind):
    """(x, radius of wheels, half of how far they are apart, how broad they are) of each."""
    stations = _BODIES[kind]
    return tuple((x, _WHEEL, stations[2][4], _TREAD) for x in (stations[0][0] - 0.82, stations[-1][0] + 0.80))


def _dark():
    return materials.plain("car trim", (0.012, 0.012, 0.012), 0.55)


def _body(kind, name):
    stations, shape = _BODIES[kind], Shape(name)
    paint, glass = _paint(), materials.plain("car glass", (0.012, 0.015, 0.018), 0.05)
    dark = _dark()
    rings = [_ring(station) for station in stations]
    for front, back in zip(rings, rings[1:]):
        for i in range(len(front) - 1):
            shape.face([front[i], front[i + 1], back[i + 1], back[i]], dark if i in (0, len(front) - 2) else paint)
    shape.face(rings[0][::-1], paint)
    shape.face(rings[-1], paint)
    first, last = _CABINS[kind]
    for i in range(first, last):
        _windows(shape, stations[i], stations[i + 1], glass, ends=(i == first, i == last - 1 and kind != "van"))
    if kind == "van":
        _end_window(shape, stations[-2], stations[-1], glass)
    return shape


def _ring(station):
    """Points round a cross-section, from the bottom's middle on the right over the roof to the left."""
    x, low, belt, top, half, half_top = station
    right = [(x, -0.6 * half, low), (x, -0.94 * half, low + 0.08), (x, -half, 0.5 * (low + belt)),
             (x, -0.975 * half, belt), (x, -half_top, top)]
    return right + [(x, -y, z) for x, y, z in right[::-1]]


def _between(a, b, t):
    return tuple(p + (q - p) * t for p, q in zip(a, b))


def _pane(shape, corners, glass, out):
    """A pane a little inside four corners, and a little in front of them."""
    middle = tuple(sum(c[axis] for c in corners) / 4.0 for axis in range(3))
    shape.face([tuple(value + shift for value, shift in zip(_between(c, middle, 0.09), out)) for c in corners], glass)


def _windows(shape, front, back, glass, ends):
    """Panes at both sides of a stretch of the cabin, and at its ends where it slopes."""
    for side in (-1.0, 1.0):
        corners = []
        for x, _, belt, top, half, half_top in (front, back):
            corners.append([(x, side * 0.975 * half, belt + 0.02), (x, side * half_top, max(top - 0.05, belt + 0.03))])
        quad = [corners[0][0], corners[1][0], corners[1][1], corners[0][1]]
        _pane(shape, quad if side < 0.0 else quad[::-1], glass, (0.0, side * 0.012, 0.006))
    for is_end, forward in zip(ends, (1.0, -1.0)):
        if is_end:
            (xa, _, _, za, _, ha), (xb, _, _, zb, _, hb) = (front, back)
            quad = [(xa, -ha, za), (xa, ha, za), (xb, hb, zb), (xb, -hb, zb)]
            _pane(shape, quad, glass, (0.008 * forward, 0.0, 0.010))


def _end_window(shape, front, back, glass):
    x, _, belt, top, half, half_top = back
    _pane(shape, [(x, 0.9 * half, belt), (x, -0.9 * half, belt), (x, -half_top, top), (x, half_top, top)], glass,
          (-0.01, 0.0, 0.0))


def _disc(shape, x, y, z, radius, material, side, count=14):
    ring = [(x + radius * math.cos(math.tau * i / count), y, z + radius * math.sin(math.tau * i / count))
            for i in range(count)]
    shape.face(ring if side < 0.0 else ring[::-1], material)


def _wheel(shape, x, side, half, dark):
    tyre = materials.plain("tyre", (0.018, 0.018, 0.018), 0.9)
    rim = materials.plain("rim", (0.32, 0.32, 0.33), 0.35)
    _disc(shape, x, side * (half + 0.004), _WHEEL + 0.02, _WHEEL + 0.06, dark, side)
    inner, outer = side * (half - _TREAD), side * (half + 0.022)
    for i in range(14):
        a, b = (math.tau * k / 14 for k in (i, i + 1))
        quad = [(x + _WHEEL * math.cos(t), y, _WHEEL + _WHEEL * math.sin(t)) for y, t in
                ((outer, a), (outer, b), (inner, b), (inner, a))]
        shape.face(quad if side < 0.0 else quad[::-1], tyre)
    _disc(shape, x, outer, _WHEEL, _WHEEL, tyre, side)
    _disc(shape, x, outer + side * 0.004, _WHEEL, 0.62 * _WHEEL, rim, side)


def _lights(shape, stations):
    white = materials.plain("headlamp", (0.62, 0.63, 0.62), 0.1)
    red = materials.plain("tail lamp", (0.28, 0.008, 0.006), 0.2)
    plate = materials.plain("number plate", (0.55, 0.54, 0.46), 0.5)
    for (x, low, belt, _, half, _), forward, material in ((stations[0], 1.0, white), (stations[-1], -1.0, red)):
        at, z = x + 0.012 * forward, low + 0.55 * (belt - low)
        for y0, y1, colour, height in ((-0.96 * half, -0.55 * half, material, 0.11),
                                       (0.55 * half, 0.96 * half, material, 0.11), (-0.26, 0.26, plate, 0.10)):
            quad = [(at, y0, z), (at, y1, z), (at, y1, z + height), (at, y0, z + height)]
            shape.face(quad if forward > 0.0 else quad[::-1], colour)


def _paint():
    found = bpy.data.materials.get("throng car paint")
    if found:
        return found
    material = materials.plain("car paint", (0.3, 0.3, 0.3), 0.22)
    nodes = material.node_tree.nodes
    shader = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    shading = Shading(material.node_tree)
    colours = shading.node("ShaderNodeValToRGB")
    colours.color_ramp.interpolation = "CONSTANT"
    while len(colours.color_ramp.elements) < len(_PAINTS):
        colours.color_ramp.elements.new(0.5)
    for i, element in enumerate(colours.color_ramp.elements):
        element.position, element.color = i / len(_PAINTS), (*_PAINTS[i], 1.0)
    shading.link(shading.node("ShaderNodeObjectInfo").outputs["Random"], colours.inputs[0])
    shading.link(colours.outputs[0], shader.inputs["Base Color"])
    return material
