# SPDX-License-Identifier: Apache-2.0
"""Lofts: rings of points joined into skins. Pure Python."""
import math


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def scale(a, f):
    return (a[0] * f, a[1] * f, a[2] * f)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def length(a):
    return math.sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2])


def unit(a):
    size = length(a)
    return scale(a, 1.0 / size) if size > 1e-9 else (0.0, 0.0, 1.0)


def mix(a, b, t):
    return (a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t, a[2] + (b[2] - a[2]) * t)


def turn_z(v, angle):
    c, s = math.cos(angle), math.sin(angle)
    return (v[0] * c - v[1] * s, v[0] * s + v[1] * c, v[2])


def turn_y(v, angle):
    """Positive tips +z towards +x: a forward lean."""
    c, s = math.cos(angle), math.sin(angle)
    return (v[0] * c + v[2] * s, v[1], -v[0] * s + v[2] * c)


def ring(centre, x_axis, y_axis, rx, ry, count, squareness=0.0):
    """An ellipse, blended towards a rounded box by `squareness`."""
    points = []
    for i in range(count):
        a = 2.0 * math.pi * i / count
        c, s = math.cos(a), math.sin(a)
        if squareness:
            power = 1.0 - 0.45 * squareness
            c, s = math.copysign(abs(c) ** power, c), math.copysign(abs(s) ** power, s)
        points.append(add(centre, add(scale(x_axis, rx * c), scale(y_axis, ry * s))))
    return points


class MeshBuilder:
    """Vertices, faces and a material slot for each face."""

    def __init__(self):
        self.vertices = []
        self.faces = []
        self.materials = []

    def loft(self, rings, material, cap_start=True, cap_end=True):
        base, count = len(self.vertices), len(rings[0])
        for points in rings:
            self.vertices.extend(points)
        for k in range(len(rings) - 1):
            for i in range(count):
                a, b = base + k * count + i, base + k * count + (i + 1) % count
                self._face((a, b, b + count, a + count), material)
        if cap_start:
            self._face(tuple(base + i for i in reversed(range(count))), material)
        if cap_end:
            top = base + (len(rings) - 1) * count
            self._face(tuple(top + i for i in range(count)), material)

    def limb(self, start, end, profile, material, count=8, flat=1.0, side=(0.0, 1.0, 0.0)):
        """A tube from start to end; profile is [(share of the length, radius)], `flat` narrows it fore and aft."""
        axis = unit(sub(end, start))
        across = unit(cross(side, axis))
        beside = cross(axis, across)
        rings = [ring(mix(start, end, t), across, beside, radius * flat, radius, count) for t, radius in profile]
        self.loft(rings, material)

    def ball(self, centre, radii, material, count=10, levels=6, tilt=0.0):
        rings = []
        for k in range(levels + 1):
            a = math.pi * (k + 0.15) / (levels + 0.3)
            z, r = -math.cos(a), math.sin(a)
            up = turn_y((0.0, 0.0, radii[2] * z), tilt)
            rings.append(ring(add(centre, up), turn_y((1.0, 0.0, 0.0), tilt), (0.0, 1.0, 0.0), radii[0] * r, radii[1] * r, count))
        self.loft(rings, material)

    def box(self, centre, half, yaw, material, taper=1.0):
        rings = []
        for z, f in ((-1.0, 1.0), (-0.85, 1.06), (0.85, 1.06 * taper), (1.0, taper)):
            corner = [(half[0] * f, half[1] * f), (-half[0] * f, half[1] * f), (-half[0] * f, -half[1] * f), (half[0] * f, -half[1] * f)]
            rings.append([add(centre, turn_z((x, y, half[2] * z), yaw)) for x, y in corner])
        self.loft(rings, material)

    def _face(self, corners, material):
        self.faces.append(corners)
        self.materials.append(material)
