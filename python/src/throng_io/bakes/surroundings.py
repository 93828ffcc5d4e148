# SPDX-License-Identifier: Apache-2.0
"""Walls and ground as meshes."""
from __future__ import annotations

import dataclasses
from typing import Any

import numpy
import shapely
import shapely.geometry

from ..base.geometry import polygons, road_shape, wall_shape

GROUND_MARGIN = 2.0           # m round everything
ROAD_HEIGHT = 0.005           # m over the ground, so that they do not fight for the same pixels
GREY = {"walls": (0.55, 0.55, 0.53), "ground": (0.32, 0.33, 0.32), "roads": (0.42, 0.42, 0.41)}


@dataclasses.dataclass(frozen=True)
class Thing:
    """What stands or lies there, m from the bake's origin."""
    place: str                 # "Walls/wall0"
    points: numpy.ndarray      # V x 3
    faces: list[list[int]]     # corners of each, of any number
    colour: tuple[float, float, float]  # linear
    name: str | None = None    # in the layout


def things_of(about: dict[str, Any], origin: numpy.ndarray) -> list[Thing]:
    """Walls, and where there is no terrain, which is a file of its own, ground and roads. @param about bake.json"""
    told = about["geometry"]
    found = [Thing(f"Walls/wall{number}", *wall_prism(wall, origin), GREY["walls"], wall.get("id"))
             for number, wall in enumerate(told["walls"])]
    if not about.get("terrain"):
        low, high = about["bounds"]["min"], about["bounds"]["max"]
        shape = shapely.box(*low, *high).buffer(GROUND_MARGIN, join_style="mitre")
        found.append(Thing("Ground/ground", *flat(shape, 0.0), GREY["ground"]))
        for number, road in enumerate(told["roads"]):
            points, faces = flat(road_shape(road), ROAD_HEIGHT)
            found.append(Thing(f"Ground/road{number}", points - origin, faces, GREY["roads"], road.get("id")))
    return [thing for thing in found if len(thing.points)]


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
