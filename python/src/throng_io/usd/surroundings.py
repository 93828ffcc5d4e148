# SPDX-License-Identifier: Apache-2.0
"""Walls and ground as meshes."""
from __future__ import annotations

import numpy
import shapely
import shapely.geometry

from ..base.geometry import polygons, wall_shape


def prism(shape: shapely.Geometry, low: float, high: float) -> tuple[numpy.ndarray, list[list[int]]]:
    """Points and faces of a polygon that stands from low to high: its sides and its top."""
    points: list[tuple[float, float, float]] = []
    faces: list[list[int]] = []
    for piece in polygons(shape):
        piece = shapely.geometry.polygon.orient(piece)
        for ring in (piece.exterior, *piece.interiors):
            corners = list(ring.coords)[:-1]
            first, count = len(points), len(corners)
            points += [(x, y, z) for z in (low, high) for x, y, *_ in corners]
            for here in range(count):
                after = (here + 1) % count
                faces.append([first + here, first + after, first + count + after, first + count + here])
        _flat(piece, high, points, faces)
    return numpy.array(points), faces


def flat(shape: shapely.Geometry, height: float) -> tuple[numpy.ndarray, list[list[int]]]:
    points: list[tuple[float, float, float]] = []
    faces: list[list[int]] = []
    for piece in polygons(shape):
        _flat(piece, height, points, faces)
    return numpy.array(points), faces


def _flat(piece: shapely.Polygon, height: float, points: list, faces: list) -> None:
    for triangle in shapely.get_parts(shapely.constrained_delaunay_triangles(piece)):
        corners = shapely.geometry.polygon.orient(triangle).exterior.coords[:-1]
        faces.append([len(points) + number for number in range(3)])
        points += [(x, y, height) for x, y, *_ in corners]


def wall_prism(wall: dict, origin: numpy.ndarray) -> tuple[numpy.ndarray, list[list[int]]]:
    """From the lowest ground along it to its height over the highest."""
    low, high = wall.get("ground", (0.0, 0.0))
    points, faces = prism(wall_shape(wall), low, high + wall.get("height", 3.0))
    return points - origin, faces
