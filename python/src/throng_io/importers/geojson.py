# SPDX-License-Identifier: Apache-2.0
"""GeoJSON: features with OpenStreetMap's tags, or with `throng`: wall, area or road."""
from __future__ import annotations

import pathlib
from typing import Any

import numpy
import shapely
import shapely.geometry

from ..base.errors import ImportFailed
from ..base.geometry import polygons
from .files import number, read_json
from .options import Options
from .projection import between, to_metres
from .scene import Scene
from .tags import Meaning, meaning

KINDS = {"wall": "building", "building": "building", "area": "area", "road": "road"}


def is_one(found: Any) -> bool:
    return isinstance(found, dict) and found.get("type") in ("FeatureCollection", "Feature", "GeometryCollection",
                                                             "Polygon", "MultiPolygon", "LineString",
                                                             "MultiLineString")


def read(path: pathlib.Path, scene: Scene, options: Options) -> None:
    found = read_json(path)
    if not is_one(found):
        raise ImportFailed("expected GeoJSON", str(path))
    features = _features(found)
    shapes = [_shape(geometry, path) for geometry, _ in features]
    points = numpy.concatenate([shapely.get_coordinates(shape) for shape in shapes] or [numpy.empty((0, 2))])
    if not len(points) or not numpy.isfinite(points).all():
        raise ImportFailed("expected features with finite coordinates", str(path))
    moved = _projected(points, found, scene, options)
    begin = 0
    for shape, (_, properties) in zip(shapes, features):
        count = len(shapely.get_coordinates(shape))
        shape = shapely.set_coordinates(shapely.force_2d(shape), moved[begin:begin + count])
        begin += count
        _take(shape, properties, scene)


def _features(found: dict) -> list[tuple[dict | None, dict]]:
    if found["type"] == "FeatureCollection":
        return [(each.get("geometry"), each.get("properties") or {}) for each in found.get("features", [])
                if isinstance(each, dict)]
    if found["type"] == "Feature":
        return [(found.get("geometry"), found.get("properties") or {})]
    return [(found, {})]


def _shape(geometry: dict | None, path: pathlib.Path) -> shapely.Geometry:
    if geometry is None:
        return shapely.Point()
    try:
        return shapely.geometry.shape(geometry)
    except (shapely.errors.ShapelyError, KeyError, TypeError, ValueError, AttributeError, IndexError,
            RecursionError) as error:
        raise ImportFailed(f"a geometry that is none: {error}", str(path)) from error


def _projected(points: numpy.ndarray, found: dict, scene: Scene, options: Options) -> numpy.ndarray:
    named = found.get("crs") if isinstance(found.get("crs"), dict) else {}
    crs = options.crs or (named.get("properties") or {}).get("name")
    if crs and "CRS84" not in str(crs):
        return between(points, str(crs), scene.report)
    degrees = abs(points[:, 0]).max() <= 180 and abs(points[:, 1]).max() <= 90
    if degrees and options.unit is None:
        return to_metres(points, scene.report)
    scene.report.altered("coordinates", f"taken as units of {options.unit or 1:g} m")
    return points * (options.unit or 1.0)


def _meaning(shape: shapely.Geometry, properties: dict) -> Meaning:
    """By `throng`, by the tags, or: polygons are areas, lines are walls."""
    wanted = properties.get("throng")
    closed = "Polygon" in shape.geom_type
    if wanted in KINDS:
        kind = KINDS[wanted] if closed or wanted != "wall" else "barrier"
        return Meaning(kind, f"{wanted}s", 0.2 if kind == "barrier" else 3.0)
    if wanted is not None:
        return Meaning("", f"features with throng={str(wanted)[:40]}", why="expected wall, area or road")
    tags = {str(key): str(value) for key, value in properties.items() if value is not None}
    return meaning(tags, closed) or (Meaning("area", "areas") if closed else Meaning("barrier", "walls", 0.2))


def _take(shape: shapely.Geometry, properties: dict, scene: Scene) -> None:
    if shape.is_empty or shape.geom_type in ("Point", "MultiPoint"):
        scene.report.left_out("points", "have no extent")
        return
    found = _meaning(shape, properties)
    if not found.kind:
        scene.report.left_out(found.what, found.why)
        return
    given = {key: number(properties[key], key, scene.report.source) for key in ("width", "thickness", "height")
             if isinstance(properties.get(key), (int, float))}
    place(shape, found, scene, str(properties.get("name") or properties.get("id") or found.what), given)


def place(shape: shapely.Geometry, found: Meaning, scene: Scene, name: str, given: dict[str, float]) -> None:
    """What a shape means, in the scene."""
    if "Polygon" in shape.geom_type or found.kind in ("building", "area"):
        if not shape.is_valid:
            scene.report.altered(found.what, "crossed themselves, and were mended")
            shape = shapely.make_valid(shape)
        if found.kind == "area":
            scene.area(shape, name, found.what)
        elif found.kind == "road":
            scene.report.left_out(found.what, "roads are lines")
        elif not polygons(shape):
            scene.report.left_out(found.what, "no closed outline")
        else:
            scene.solid(shape, name, given.get("height", found.height), found.what)
        return
    for line in shapely.get_parts(shape):
        if found.kind == "road":
            scene.road(line.coords, given.get("width", found.size), name, found.what)
        else:
            scene.line(line.coords, given.get("thickness", found.size), name, given.get("height", found.height),
                       found.what)
