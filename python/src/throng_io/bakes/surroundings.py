# SPDX-License-Identifier: Apache-2.0
"""Walls, ground, floors and stands as meshes."""
from __future__ import annotations

import dataclasses
import json
import pathlib
import struct
from typing import Any

import numpy
import shapely
import shapely.geometry

from ..base.errors import BakeError
from ..base.geometry import area_shape, polygons, road_shape, stripes, wall_shape, way_beside
from ..cast import seat_mouths, seat_rows
from .bake import Bake

GROUND_MARGIN = 2.0           # m round everything
ROAD_HEIGHT = 0.005           # m over the ground, so that they do not fight for the same pixels
LANE_HEIGHT = 0.003           # m, likewise
STRIPE_HEIGHT, STRIPE = 0.01, 0.5  # m: over the ground, and how wide a zebra's stripes are
ABOVE = 0.0002                # m
GREY = {"walls": (0.55, 0.55, 0.53), "ground": (0.32, 0.33, 0.32), "roads": (0.42, 0.42, 0.41),
        "lanes": (0.09, 0.09, 0.1), "crossings": (0.09, 0.09, 0.1), "stripes": (0.6, 0.6, 0.57),
        "stands": (0.28, 0.28, 0.27), "seats": (0.04, 0.1, 0.23)}


@dataclasses.dataclass(frozen=True)
class Thing:
    """What stands or lies there, m from the bake's origin."""
    place: str                 # "Walls/wall0"
    points: numpy.ndarray      # V x 3
    faces: list[list[int]]     # corners of each, of any number
    colour: tuple[float, float, float]  # linear
    name: str | None = None    # in the layout


def things_of(bake: Bake) -> list[Thing]:
    """Walls and stands, ground with roads and streets, or in their place the terrain, which has the floors of a layout
    with levels, too."""
    about, origin = bake.about, bake.origin
    told = about["geometry"]
    hidden = {f"{block.get('id', '')} stand" for block in told.get("seats", ())}  # outlines of what is shown itself:
    # one for each piece of it, told apart by `_` at the end
    found = [Thing(f"Walls/wall{number}", *wall_prism(wall, origin), GREY["walls"], wall.get("id"))
             for number, wall in enumerate(told["walls"])
             if str(wall.get("id")).rstrip("_") not in hidden and not wall.get("edge")]
    found += [each for number, block in enumerate(told.get("seats", ()))
              for each in _stand_of(number, block, origin)]
    if about.get("terrain"):
        found.append(terrain_of(bake))
    else:
        found += _flat_ground(about, told, origin)
    return [thing for thing in found if len(thing.points)]


def _flat_ground(about: dict[str, Any], told: dict[str, Any], origin: numpy.ndarray) -> list[Thing]:
    low, high = about["bounds"]["min"], about["bounds"]["max"]
    shape = shapely.box(*low, *high).buffer(GROUND_MARGIN, join_style="mitre")
    found = [Thing("Ground/ground", *flat(shape, 0.0), GREY["ground"])]
    traffic = told.get("traffic") or {}
    flats = ([("road", road_shape(road), ROAD_HEIGHT, "roads", road.get("id")) for road in told["roads"]]
             + [("lane", road_shape({"centreline": lane["points"], "width": lane["width"]}), LANE_HEIGHT, "lanes",
                 lane.get("id")) for lane in traffic.get("lanes", ())]
             + [("crossing", area_shape(each), ROAD_HEIGHT, "crossings", each.get("id"))
                for each in traffic.get("crossings", ())]
             + [("stripes", _stripes(area_shape(each), traffic.get("lanes", ())), STRIPE_HEIGHT, "stripes",
                 each.get("id")) for each in traffic.get("crossings", ())])
    numbers: dict[str, int] = {}
    for kind, shape, height, colour, name in flats:
        numbers[kind] = numbers.get(kind, -1) + 1
        points, faces = flat(shape, height + ABOVE * numbers[kind])  # each of them, too, where they cross
        found.append(Thing(f"Ground/{kind}{numbers[kind]}", points - origin, faces, GREY[colour], name))
    return found


def _stripes(crossing: shapely.Geometry, lanes) -> shapely.Geometry:
    """Along the nearest lane, as vehicles go."""
    middle = crossing.centroid
    near = min(lanes, key=lambda lane: shapely.LineString(lane["points"]).distance(middle), default=None)
    way = way_beside(near["points"], (middle.x, middle.y))[1] if near else (1.0, 0.0)
    return stripes(crossing, way, STRIPE)


def _joined(faces: list[list[tuple[float, float, float]]]) -> tuple[numpy.ndarray, list[list[int]]]:
    """Points and faces of faces that are told by corners."""
    firsts = numpy.cumsum([0] + [len(face) for face in faces]).tolist()
    return (numpy.array([corner for face in faces for corner in face], dtype=float).reshape(-1, 3),
            [list(range(first, first + len(face))) for first, face in zip(firsts, faces)])


def _stand_of(number: int, block: dict, origin: numpy.ndarray) -> list[Thing]:
    """The steps of a block, and its seats."""
    steps: list = []
    seats: list = []
    slabs = seat_mouths.has_passages(block)
    for row in block["rows"]:
        front, back = seat_rows.step_of(block, row)
        bottom = seat_rows.bottom_of(block, row, seat_mouths.SLAB if slabs else None)
        if "heights" in row:
            steps += list(seat_rows.step_faces(front, back, seat_rows.heights_of(row), bottom))
        else:
            points, sides = prism(shapely.Polygon([*front, *back[::-1]]), bottom, float(row["height"]))
            steps += [[tuple(points[corner]) for corner in side] for side in sides]
        seats += [face for place, along, height in seat_rows.seats_of(block, row)
                  for face in seat_rows.seat_faces(place, along, height, seat_rows.SIDE * float(block["width"]))]
    for aisle in block["aisles"] if slabs else ():
        steps += seat_mouths.faces_of(block, aisle)
    kinds = (("stand", "stands", _joined(steps)), ("seats", "seats", _joined(seats)))
    return [Thing(f"Stands/{kind}{number}", points - origin, faces, GREY[colour], block.get("id"))
            for kind, colour, (points, faces) in kinds if faces]


def terrain_of(bake: Bake) -> Thing:
    """The mesh of terrain.glb, which `throng` writes: places of 3 float32 and triangles; y is up in it."""
    path = bake.folder / pathlib.PurePosixPath(str(bake.about["terrain"].get("file"))).name
    try:
        data = path.read_bytes()
        text = struct.unpack_from("<I", data, 12)[0]
        document, binary = json.loads(data[20:20 + text]), data[28 + text:]
        part = document["meshes"][0]["primitives"][0]
        points = _numbers(document, binary, part["attributes"]["POSITION"]).reshape(-1, 3)
        faces = _numbers(document, binary, part["indices"]).reshape(-1, 3)
    except (OSError, ValueError, LookupError, TypeError, struct.error) as error:
        raise BakeError(f"{path} cannot be read: {error}", "`throng verify` says what is wrong with a bake") from error
    return Thing("Ground/terrain", points[:, [0, 2, 1]] * [1.0, -1.0, 1.0], faces.tolist(), GREY["ground"])


def _numbers(document: dict, binary: bytes, accessor: int) -> numpy.ndarray:
    told = document["accessors"][accessor]
    view = document["bufferViews"][told["bufferView"]]
    kind = {5123: "<u2", 5125: "<u4", 5126: "<f4"}[told["componentType"]]
    count = told["count"] * {"SCALAR": 1, "VEC3": 3}[told["type"]]
    return numpy.frombuffer(binary, kind, count, view.get("byteOffset", 0) + told.get("byteOffset", 0))


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
