# SPDX-License-Identifier: Apache-2.0
"""Walls that are drawn by their two faces: lines that are parallel, near, and beside each other are one wall."""
from __future__ import annotations

import dataclasses
import math

import shapely

from ..base.geometry import polygons

THINNEST, THICKEST = 0.04, 0.6  # m between the faces of a wall
PARALLEL = math.sin(math.radians(1.5))
LEAST = 0.5      # of the shorter face has to have the other beside it
GRAIN = 0.001    # m; what is shorter is nothing

Point = tuple[float, float]
Span = tuple[float, float]


@dataclasses.dataclass
class Face:
    first: Point
    last: Point
    curved: bool = False
    used: list[Span] = dataclasses.field(default_factory=list)  # parts that have the other face, in m from the first

    def __post_init__(self) -> None:
        self.length = math.dist(self.first, self.last)
        self.along = tuple((end - start) / self.length for start, end in zip(self.first, self.last))

    def at(self, distance: float) -> Point:
        return self.first[0] + distance * self.along[0], self.first[1] + distance * self.along[1]

    def place(self, point: Point) -> tuple[float, float]:
        """How far along, and how far to the left."""
        x, y = point[0] - self.first[0], point[1] - self.first[1]
        return x * self.along[0] + y * self.along[1], y * self.along[0] - x * self.along[1]

    def free(self, span: Span) -> list[Span]:
        """The parts of a span that have no other face yet."""
        parts = [span]
        for low, high in self.used:
            parts = [part for first, last in parts for part in ((first, min(last, low)), (max(first, high), last))
                     if part[1] - part[0] > GRAIN]
        return parts


def _beside(one: Face, other: Face) -> tuple[float, Span] | None:
    """The distance of two faces of one wall, and where on the first."""
    if abs(one.along[0] * other.along[1] - one.along[1] * other.along[0]) > PARALLEL:
        return None
    (start, left), (end, also_left) = one.place(other.first), one.place(other.last)
    low, high = max(0.0, min(start, end)), min(one.length, max(start, end))
    distance = 0.5 * abs(left + also_left)
    enough = max(LEAST * min(one.length, other.length), 0.0 if one.curved and other.curved else distance)
    if left * also_left <= 0 or not THINNEST <= distance <= THICKEST or high - low < max(enough, GRAIN):
        return None
    return distance, (low, high)


def walls_of(faces: list[Face]) -> tuple[list[shapely.Polygon], list[list[Point]]]:
    """Solid walls, and the lines that have no other beside them."""
    if not faces:
        return [], []
    lines = [shapely.LineString([face.first, face.last]) for face in faces]
    tree = shapely.STRtree(lines)
    near = tree.query(lines, predicate="dwithin", distance=THICKEST)
    pairs = sorted((found[0], one, other, found[1]) for one, other in near.T.tolist() if one < other
                   if (found := _beside(faces[one], faces[other])))
    solid = []
    for _, one, other, span in pairs:
        solid += _wall(faces[one], faces[other], span)
    walls = _corners_filled(shapely.union_all(solid), faces)
    inside = walls.buffer(2 * GRAIN, join_style="mitre")
    left = [[face.at(low), face.at(high)] for face in faces for low, high in face.free((0.0, face.length))]
    thin = [line for line in left if not inside.covers(shapely.LineString(line))]
    merged = shapely.line_merge(shapely.MultiLineString(thin)) if thin else shapely.MultiLineString()
    return polygons(walls), [list(line.coords) for line in shapely.get_parts(merged)]


def _corners_filled(walls: shapely.Geometry, faces: list[Face]) -> shapely.Geometry:
    """Where walls meet, their outer faces enclose a corner that has no inner ones."""
    left = [shapely.LineString([face.at(low), face.at(high)]) for face in faces
            for low, high in face.free((0.0, face.length)) if high - low <= THICKEST]
    rings = shapely.polygonize(shapely.get_parts(shapely.union_all([walls.boundary, *left], grid_size=GRAIN)))
    corners = [ring for ring in shapely.get_parts(rings)
               if ring.length <= 4 * THICKEST and not walls.covers(ring.representative_point())]
    return shapely.union_all([walls, *corners], grid_size=GRAIN)


def _wall(one: Face, other: Face, span: Span) -> list[shapely.Polygon]:
    """Between two faces, where neither has another yet."""
    found = []
    for low, high in one.free(span):
        there = sorted(other.place(one.at(distance))[0] for distance in (low, high))
        for first, last in other.free((max(0.0, there[0]), min(other.length, there[1]))):
            ends = sorted(one.place(other.at(distance))[0] for distance in (first, last))
            corners = [one.at(ends[0]), one.at(ends[1]), *sorted(
                (other.at(first), other.at(last)), key=lambda point: -one.place(point)[0])]
            shape = shapely.Polygon(corners)
            if shape.is_valid and shape.area > GRAIN * THINNEST:
                found.append(shape)
                one.used.append((ends[0], ends[1]))
                other.used.append((first, last))
    return found
