# SPDX-License-Identifier: Apache-2.0
"""DXF floor plans, by ezdxf: lines of chosen layers; two lines beside each other are the faces of a wall."""
from __future__ import annotations

import pathlib

import shapely

from ..base.errors import ImportFailed, need
from .files import read_bytes
from .options import NAMES_OF_WALLS, Options, matches
from .scene import Scene
from .wall_faces import Face, walls_of

DRAWN = {"LINE", "LWPOLYLINE", "POLYLINE", "ARC", "CIRCLE", "ELLIPSE", "SPLINE"}
CURVED = {"ARC", "CIRCLE", "ELLIPSE", "SPLINE"}
MOST_ENTITIES = 500_000
SOLID = 1.5  # m; closed outlines that are no wider are pillars


def read(path: pathlib.Path, scene: Scene, options: Options) -> None:
    Plan(path, scene, options).take()


class Plan:
    def __init__(self, path: pathlib.Path, scene: Scene, options: Options):
        self.path, self.scene, self.options = path, scene, options
        ezdxf = need("ezdxf", "import")
        need("ezdxf.path", "import")
        self.ezdxf = ezdxf
        read_bytes(path)  # of a sensible size, and a file
        try:
            self.document = ezdxf.readfile(path)
        except (ezdxf.DXFError, OSError, ValueError, LookupError, TypeError, ArithmeticError, AttributeError,
                RecursionError) as error:
            raise ImportFailed(f"no DXF: {error}", str(path)) from error
        self.unit = self.metres_of_a_unit()
        self.has_walls = any(matches([layer.dxf.name], NAMES_OF_WALLS) for layer in self.document.layers)

    def metres_of_a_unit(self) -> float:
        if self.options.unit:
            return self.options.unit
        units = need("ezdxf.units", "import")
        if not self.document.units:
            self.scene.report.altered("coordinates", "without a unit: taken as metres")
            return 1.0
        factor = units.conversion_factor(self.document.units, units.M)
        self.scene.report.altered("coordinates", f"a unit is {factor:g} m")
        return factor

    def take(self) -> None:
        self.expandable()
        faces: list[Face] = []
        for entity in self.entities(self.document.modelspace()):
            wanted = self.wanted(entity)
            if wanted is not None:
                for points in self.flattened(entity):
                    faces += self.place(entity, points, wanted)
        solids, lines = walls_of(faces)
        for solid in solids:
            self.scene.solid(solid)
        for line in lines:
            self.scene.line(line, 0.1, what="thin walls")

    def expandable(self) -> None:
        """Blocks that hold themselves, or each other many times over, are refused."""
        inner = {block.name: [each.dxf.name for each in block.query("INSERT")] for block in self.document.blocks}
        sizes: dict[str, int] = {}

        def size(name: str, above: tuple[str, ...]) -> int:
            if name in above or len(above) > 64:
                raise ImportFailed(f"the block {name!r} holds itself", str(self.path))
            if name not in sizes:
                sizes[name] = len(self.document.blocks.get(name) or ()) + sum(
                    size(each, (*above, name)) for each in inner.get(name, []))
            return sizes[name]

        total = 0
        for insert in self.document.modelspace().query("INSERT"):
            grid = max(1, insert.dxf.get("row_count", 1)) * max(1, insert.dxf.get("column_count", 1))
            total += grid * size(insert.dxf.name, ())
            if total > MOST_ENTITIES:
                raise ImportFailed(f"blocks hold more than {MOST_ENTITIES:,} entities", str(self.path))

    def entities(self, space):
        """Everything, blocks taken apart."""
        for entity in space:
            if entity.dxftype() == "INSERT":
                inserts = entity.multi_insert() if entity.mcount > 1 else [entity]
                for insert in inserts:
                    yield from self.entities(insert.virtual_entities())
            else:
                yield entity

    def wanted(self, entity) -> str | None:
        kind, layer = entity.dxftype(), entity.dxf.get("layer", "0")
        if kind not in DRAWN:
            self.scene.report.left_out(f"{kind} entities", "are no lines")
            return None
        wanted = self.options.kind([layer], self.has_walls)
        if wanted is None:
            self.scene.report.left_out(f"{kind} entities of the layer {layer}", "not a layer that is chosen")
        return wanted

    def flattened(self, entity) -> list[list[tuple[float, float]]]:
        tolerance = self.options.tolerance / self.unit
        try:
            path = self.ezdxf.path.make_path(entity)
            parts = path.sub_paths() if path.has_sub_paths else [path]
            return [[(self.unit * point.x, self.unit * point.y) for point in part.flattening(tolerance)]
                    for part in parts]
        except (self.ezdxf.DXFError, ValueError, TypeError, ZeroDivisionError, ArithmeticError) as error:
            raise ImportFailed(f"{entity.dxftype()} {entity.dxf.get('handle')}: {error}", str(self.path)) from error

    def place(self, entity, points: list[tuple[float, float]], wanted: str) -> list[Face]:
        """Areas and roads go to the scene; of walls the faces are given back."""
        points = [tuple(point) for point in self.scene.points(points)]
        layer, closed = entity.dxf.get("layer", "0"), len(points) > 3 and points[0] == points[-1]
        if len(points) < 2:
            self.scene.report.left_out(f"{entity.dxftype()} entities", "without a length")
        elif wanted == "areas":
            if closed:
                self.scene.area(self.scene.polygon(points, "areas"), layer)
            else:
                self.scene.report.left_out("areas", "no closed outline")
        elif wanted == "roads":
            self.scene.road(points, 3.0, layer)
            self.scene.report.altered("roads", "without a width: 3 m")
        elif closed and max(_sizes(points)) <= SOLID:
            self.scene.solid(self.scene.polygon(points, "walls"), what="pillars")
        else:
            curved = entity.dxftype() in CURVED
            return [Face(one, other, curved) for one, other in zip(points, points[1:])]
        return []


def _sizes(points) -> tuple[float, float]:
    low_x, low_y, high_x, high_y = shapely.LineString(points).bounds
    return high_x - low_x, high_y - low_y
