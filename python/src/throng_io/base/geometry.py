# SPDX-License-Identifier: Apache-2.0
"""What stands and lies on the ground, as Shapely geometry."""
from __future__ import annotations

import math
from collections.abc import Iterable

import shapely
import shapely.affinity

ROUND_ENDS = 8  # segments a quarter of a circle


def wall_shape(wall: dict) -> shapely.Geometry:
    """The ground that a wall covers: its polygon, or its line as thick as it is, with round ends."""
    if wall.get("closed"):
        return shapely.make_valid(shapely.Polygon(wall["points"]))
    return shapely.LineString(wall["points"]).buffer(0.5 * wall.get("thickness", 0.2), quad_segs=ROUND_ENDS)


def road_shape(road: dict) -> shapely.Geometry:
    return shapely.LineString(road["centreline"]).buffer(0.5 * road.get("width", 3.0), cap_style="flat",
                                                         join_style="round", quad_segs=ROUND_ENDS)


def area_shape(area: dict) -> shapely.Geometry:
    return shapely.make_valid(shapely.Polygon(area["polygon"]))


def way_beside(points, place) -> tuple[tuple[float, float], tuple[float, float]]:
    """(the nearest place on a polyline, where it leads there)"""
    line = shapely.LineString(points)
    along = min(max(line.project(shapely.Point(place[:2])), 1e-3), line.length - 1e-3)
    here, ahead = (line.interpolate(along + step) for step in (-1e-3, 1e-3))
    length = here.distance(ahead)
    at = line.interpolate(along)
    return (at.x, at.y), ((ahead.x - here.x) / length, (ahead.y - here.y) / length)


def stripes(crossing: shapely.Geometry, way: tuple[float, float], wide: float) -> shapely.Geometry:
    """Of a zebra: bands along the way, as far apart as they are wide."""
    turned = shapely.affinity.rotate(crossing, -math.atan2(way[1], way[0]), origin=(0.0, 0.0), use_radians=True)
    low, start, high, end = turned.bounds
    bands = [shapely.box(low, at, high, at + wide) for at in (
        start + wide * (0.5 + 2.0 * number) for number in range(int((end - start) / (2.0 * wide)) + 1))
        if at + wide <= end + 1e-6]
    back = shapely.affinity.rotate(shapely.union_all(bands), math.atan2(way[1], way[0]), origin=(0.0, 0.0),
                                   use_radians=True)
    return back.intersection(crossing)


def named(things: Iterable[dict], kind: str, shape) -> dict[str, shapely.Geometry]:
    """{id: shape}; those without an id are called by their kind and number."""
    return {thing.get("id") or f"{kind}{number}": shape(thing) for number, thing in enumerate(things)}


def polygons(geometry: shapely.Geometry) -> list[shapely.Polygon]:
    """Those with an area, of whatever it is."""
    parts = shapely.get_parts(geometry) if hasattr(geometry, "geoms") else [geometry]
    return [polygon for part in parts
            for polygon in ([part] if part.geom_type == "Polygon" else polygons(part) if hasattr(part, "geoms") else [])
            if not polygon.is_empty]


def walkable_ground(walls: Iterable[shapely.Geometry], reach: shapely.Geometry) -> shapely.Geometry:
    """The reach without the walls."""
    return shapely.make_valid(reach.difference(shapely.union_all(list(walls))))


def piece_with(ground: shapely.Geometry, points) -> shapely.Polygon:
    """Of ground that walls cut into pieces, the one that holds most of the points; ties go to the larger."""
    pieces = polygons(ground)
    held = [int(shapely.contains_xy(piece, points[:, 0], points[:, 1]).sum()) for piece in pieces]
    return max(zip(held, (piece.area for piece in pieces), range(len(pieces)), pieces))[3]
