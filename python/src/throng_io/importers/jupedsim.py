# SPDX-License-Identifier: Apache-2.0
"""JuPedSim: geometry as WKT, and trajectory files with geometry and people."""
from __future__ import annotations

import contextlib
import math
import pathlib
import sqlite3

import numpy
import shapely

from ..base.errors import ImportFailed
from ..base.geometry import polygons
from .files import read_bytes, read_text
from .scene import MOST_PEOPLE, Scene

MOST_ROWS = 50_000_000
STANDING = 0.05  # m; who goes no further stays


def read_wkt(path: pathlib.Path, scene: Scene) -> None:
    _ground(read_text(path).strip(), path, scene)


def _ground(text: str, path: pathlib.Path, scene: Scene) -> None:
    try:
        shape = shapely.from_wkt(text)
    except shapely.errors.GEOSException as error:
        raise ImportFailed(f"no WKT: {error}", str(path)) from error
    coordinates = shapely.get_coordinates(shape)
    if not len(coordinates) or not numpy.isfinite(coordinates).all():
        raise ImportFailed("expected a geometry with finite coordinates", str(path))
    if not shape.is_valid:
        scene.report.altered("walkable areas", "crossed themselves, and were mended")
        shape = shapely.make_valid(shape)
    parts = [part for part in shapely.get_parts(shape) if not polygons(part)]
    scene.report.left_out("points and lines of the geometry", "have no area", len(parts))
    scene.enclosure(shapely.union_all(polygons(shape)))


def read_sqlite(path: pathlib.Path, scene: Scene) -> None:
    if not read_bytes(path).startswith(b"SQLite format 3\0"):
        raise ImportFailed("expected an SQLite database", str(path))
    try:
        with contextlib.closing(sqlite3.connect(f"{path.absolute().as_uri()}?mode=ro", uri=True)) as database:
            grounds = {str(row[0]) for row in database.execute("SELECT wkt FROM geometry LIMIT 1000")}
            about = dict(database.execute("SELECT key, value FROM metadata LIMIT 1000"))
            rows = numpy.array(database.execute(
                "SELECT id, frame, pos_x, pos_y FROM trajectory_data ORDER BY id, frame LIMIT ?",
                (MOST_ROWS,)).fetchall(), dtype=float).reshape(-1, 4)
    except (sqlite3.Error, ValueError, TypeError) as error:
        raise ImportFailed(f"no trajectory file of JuPedSim: {error}", str(path)) from error
    scene.report.altered("walkable areas", "change over time: all of them together", len(grounds) > 1)
    if not grounds:
        raise ImportFailed("has no geometry", str(path))
    _ground(shapely.union_all([_parsed(text, path) for text in sorted(grounds)]).wkt, path, scene)
    try:
        fps = float(about.get("fps", "nan"))
    except ValueError:
        fps = math.nan
    if not (math.isfinite(fps) and fps > 0) or not numpy.isfinite(rows).all():
        raise ImportFailed("expected finite positions and a frame rate above 0", str(path))
    _people(rows, fps, scene)


def _parsed(text: str, path: pathlib.Path) -> shapely.Geometry:
    try:
        return shapely.make_valid(shapely.from_wkt(text))
    except shapely.errors.GEOSException as error:
        raise ImportFailed(f"no WKT: {error}", str(path)) from error


def _people(rows: numpy.ndarray, fps: float, scene: Scene) -> None:
    """Everybody goes from the first to the last place that was recorded, from the moment on that it was."""
    if not len(rows):
        return
    first_frame = rows[:, 1].min()
    begin = numpy.nonzero(numpy.diff(rows[:, 0], prepend=numpy.nan) != 0)[0]
    if len(begin) > MOST_PEOPLE:
        raise ImportFailed(f"more than {MOST_PEOPLE:,} people", scene.report.source)
    people = []
    for way in numpy.split(rows, begin[1:]):
        length = numpy.hypot(*numpy.diff(way[:, 2:], axis=0).T).sum()
        seconds = (way[-1, 1] - way[0, 1]) / fps
        speed = max(length / seconds, 0.05) if seconds > 0 and length > STANDING else None
        people.append(scene.person(way[0, 2:], way[-1, 2:], speed, start=float(way[0, 1] - first_frame) / fps))
    scene.agents("people", people)
    scene.report.altered("people", "walk from their first to their last place, at their mean speed", len(begin))
