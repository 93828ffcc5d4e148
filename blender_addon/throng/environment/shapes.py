# SPDX-License-Identifier: Apache-2.0
"""Flat polygons and boxes, gathered into one mesh."""
import math

import bpy

from ..cast.mesh_builder import cross, sub, unit
from ..setting.plane import along_of as direction, area as signed_area, inside  # noqa: F401  what shapes are made by

UV_ROOMS = "rooms"  # the one UV map: where in which room a pane is (rooms.py)


def counter_clockwise(polygon):
    polygon = [tuple(point[:2]) for point in polygon]
    return polygon if signed_area(polygon) > 0.0 else polygon[::-1]


def offset_polygon(polygon, distance):
    """A counter-clockwise polygon moved outwards, corners mitred (limited, for sharp ones)."""
    result, count = [], len(polygon)
    for i, point in enumerate(polygon):
        before, _ = direction(polygon[i - 1], point)
        after, _ = direction(point, polygon[(i + 1) % count])
        n1, n2 = (before[1], -before[0]), (after[1], -after[0])
        nx, ny = n1[0] + n2[0], n1[1] + n2[1]
        size = max(0.25, 0.5 * (nx * nx + ny * ny))
        result.append((point[0] + nx / size * distance, point[1] + ny / size * distance))
    return result


class Shape:
    """A mesh in the making, with named material slots."""

    def __init__(self, name):
        self.name, self.vertices, self.faces, self.slots, self.materials = name, [], [], [], []
        self.places = {}  # on the UV maps of faces that have any: number of the face: the places of its corners

    def slot(self, material):
        if material not in self.materials:
            self.materials.append(material)
        return self.materials.index(material)

    def face(self, corners, material, places=None):
        if places:
            self.places[len(self.faces)] = places
        base = len(self.vertices)
        self.vertices.extend(corners)
        self.faces.append(tuple(range(base, base + len(corners))))
        self.slots.append(self.slot(material))

    def flat(self, polygon, z, material):
        self.face([(x, y, z) for x, y in counter_clockwise(polygon)], material)

    def limb(self, a, b, thick, thin, material, count=6):
        """A tapered branch, open at both ends. @return the rings of its corners there"""
        way = unit(sub(b, a))
        u = unit(cross(way, (1.0, 0.0, 0.0) if abs(way[0]) < 0.8 else (0.0, 1.0, 0.0)))
        v = cross(way, u)
        turns = [(math.cos(math.tau * i / count), math.sin(math.tau * i / count)) for i in range(count)]
        rings = [[tuple(p[axis] + radius * (u[axis] * c + v[axis] * s) for axis in range(3)) for c, s in turns]
                 for p, radius in ((a, thick), (b, thin))]
        for i in range(count):
            after = (i + 1) % count
            self.face([rings[0][i], rings[0][after], rings[1][after], rings[1][i]], material)
        return rings

    def prism(self, polygon, low, high, material, top=None):
        """Sides and lid of an extruded polygon."""
        polygon = counter_clockwise(polygon)
        for a, b in zip(polygon, polygon[1:] + polygon[:1]):
            self.face([(*a, low), (*b, low), (*b, high), (*a, high)], material)
        self.face([(x, y, high) for x, y in polygon], top or material)

    def band(self, polygon, low, high, out, material):
        """A ledge that runs round a building."""
        self.prism(offset_polygon(counter_clockwise(polygon), out), low, high, material)

    def panel(self, a, along, outward, start, width, low, high, out, material):
        """A rectangle on a facade, `out` metres in front of it."""
        def at(distance, z):
            return (a[0] + along[0] * distance + outward[0] * out, a[1] + along[1] * distance + outward[1] * out, z)

        self.face([at(start, low), at(start + width, low), at(start + width, high), at(start, high)], material)

    def strip(self, a, b, half_width, low, high, material):
        """A box along a line, ends flat."""
        along, _ = direction(a, b)
        side = (-along[1] * half_width, along[0] * half_width)
        self.prism([(a[0] - side[0], a[1] - side[1]), (b[0] - side[0], b[1] - side[1]),
                    (b[0] + side[0], b[1] + side[1]), (a[0] + side[0], a[1] + side[1])], low, high, material)

    def to_mesh(self):
        mesh = bpy.data.meshes.new(self.name)
        mesh.from_pydata(self.vertices, [], self.faces)
        for material in self.materials:
            mesh.materials.append(material)
        mesh.polygons.foreach_set("material_index", self.slots)
        self._map(mesh)
        mesh.update()
        return mesh

    def _map(self, mesh):
        if not self.places:
            return
        flat, none = [], (0.0, 0.0)
        for number, face in enumerate(self.faces):
            for place in self.places.get(number) or [none] * len(face):
                flat.extend(place)
        mesh.uv_layers.new(name=UV_ROOMS, do_init=False).data.foreach_set("uv", flat)

    def to_object(self):
        return bpy.data.objects.new(self.name, self.to_mesh())
