# SPDX-License-Identifier: Apache-2.0
"""People for plans that have none: two streams between the ends of the largest ground on which one can walk."""
from __future__ import annotations

import shapely

from ..base.errors import ImportFailed
from ..base.geometry import area_shape, polygons, road_shape, wall_shape
from .scene import Scene

CLEAR = 0.6    # m that the ends keep from walls
BODY = 0.35    # m; where a body does not pass, ground is not connected
MARGIN = 2.0   # m round a plan that is open to the outside


def add_people(scene: Scene, count: int) -> None:
    if scene.people or count < 1:
        return
    room = _room(scene)
    if room.area < 1.0:
        raise ImportFailed("there is no ground for people", scene.report.source)
    corners = [shapely.Point(point) for piece in polygons(room) for point in piece.exterior.coords]
    first = max(corners, key=room.centroid.distance)
    last = max(corners, key=first.distance)
    ends = [scene.area(_largest(polygons(point.buffer(1.2).intersection(room))), name, "ends for people")
            for point, name in ((first, "one end"), (last, "other end"))]
    if None in ends:
        raise ImportFailed("there is no ground for people", scene.report.source)
    for (start, end), share in ((ends, count - count // 2), (ends[::-1], count // 2)):
        if share:
            scene.flow(f"from {start}", share, **{"from": start, "to": end, "end": float(max(1, share))})
    scene.report.altered("people", "made up: nobody is in the plan", count)


def _room(scene: Scene) -> shapely.Geometry:
    """Where people can stand clear of walls and come from each place to each other. Rooms come before the ground round
    the plan."""
    solid = shapely.union_all([shapely.make_valid(wall_shape(wall)) for wall in scene.walls])
    ways = [road_shape(road) for road in scene.roads] + [area_shape(area) for area in scene.areas if scene.roads]
    everything = shapely.union_all([solid, *map(area_shape, scene.areas)])
    if everything.is_empty and not ways:
        return shapely.Polygon()
    free = shapely.union_all(ways) if ways else shapely.box(*everything.bounds).buffer(MARGIN, join_style="mitre")
    pieces = polygons(free.difference(solid.buffer(BODY)))
    inner = pieces if ways else [piece for piece in pieces if not piece.intersects(free.boundary)]
    return _largest(inner or pieces).buffer(BODY - CLEAR)


def _largest(pieces: list[shapely.Polygon]) -> shapely.Polygon:
    return max(pieces, key=lambda piece: piece.area, default=shapely.Polygon())
