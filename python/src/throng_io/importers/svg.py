# SPDX-License-Identifier: Apache-2.0
"""SVG plans: shapes of chosen layers; strokes are walls as thick as they are drawn, closed fills are solid."""
from __future__ import annotations

import math
import pathlib
import re

from ..base.errors import ImportFailed, need
from .files import read_xml, tag
from .options import NAMES_OF_WALLS, Options, matches
from .scene import Scene

ROOT = "svg"
UNIT = 0.01           # m, where nobody says
DEEPEST = 32          # groups and uses in each other
MOST_SHAPES = 200_000
SHAPES = ("path", "rect", "circle", "ellipse", "line", "polyline", "polygon")
SILENT = ("title", "desc", "metadata", "defs", "style", "namedview", "script", "symbol", "marker", "clipPath", "mask",
          "linearGradient", "radialGradient", "pattern", "filter")
LABEL = "{http://www.inkscape.org/namespaces/inkscape}label"
HREF = "{http://www.w3.org/1999/xlink}href"
STYLES = ("fill", "stroke", "stroke-width", "display", "visibility")


def read(path: pathlib.Path, scene: Scene, options: Options) -> None:
    Drawing(path, scene, options).take()


class Drawing:
    def __init__(self, path: pathlib.Path, scene: Scene, options: Options):
        self.path, self.scene, self.options, self.root = path, scene, options, read_xml(path, ROOT)
        self.svg = need("svgelements", "import")
        self.named = {each.get("id"): each for each in self.root.iter() if each.get("id")}
        self.unit = options.unit or UNIT
        labels = [name for each in self.root.iter() for name in self.names(each)]
        self.has_walls = any(matches([name], NAMES_OF_WALLS) for name in labels)
        self.sizes: dict[str, int] = {}

    def take(self) -> None:
        if self.size(self.root, 0) > MOST_SHAPES:
            raise ImportFailed(f"more than {MOST_SHAPES:,} shapes", str(self.path))
        self.scene.report.altered("coordinates", f"a unit is {self.unit:g} m, y goes up")
        if any(tag(each) == "style" for each in self.root.iter()):
            self.scene.report.left_out("style sheets", "only styles of elements are read")
        self.walk(self.root, self.svg.Matrix(), {}, [], 0)

    def size(self, element, depth: int) -> int:
        """How many shapes an element is, those that it uses included."""
        if depth > DEEPEST:
            raise ImportFailed(f"groups and uses more than {DEEPEST} deep, or in a circle", str(self.path),
                               element.sourceline or 0)
        if tag(element) != "use":
            return 1 + sum(self.size(each, depth + 1) for each in element)
        name = self.used(element)
        if name in self.named and name not in self.sizes:
            self.sizes[name] = self.size(self.named[name], depth + 1)
        return self.sizes.get(name, 1)

    def used(self, element) -> str:
        return (element.get("href") or element.get(HREF) or "").lstrip("#")

    def names(self, element) -> list[str]:
        return [name for name in (element.get("id"), element.get(LABEL), *(element.get("class") or "").split())
                if name]

    def walk(self, element, matrix, style: dict[str, str], layers: list[str], depth: int) -> None:
        style = {**style, **self.style(element)}
        if style.get("display") == "none" or style.get("visibility") == "hidden":
            self.scene.report.left_out("shapes and groups", "are hidden")
            return
        layers = layers + self.names(element)
        matrix = self.moved(element, matrix)
        kind = tag(element)
        if kind in ("svg", "g", "a", "switch"):
            for each in element:
                self.walk(each, matrix, style, layers, depth + 1)
        elif kind == "use":
            self.use(element, matrix, style, layers, depth)
        elif kind in SHAPES:
            self.shape(element, kind, matrix, style, layers)
        elif kind and kind not in SILENT:
            self.scene.report.left_out(f"<{kind}>", "is no shape")

    def style(self, element) -> dict[str, str]:
        pairs = (each.partition(":")[::2] for each in (element.get("style") or "").split(";"))
        written = {key.strip(): value.strip() for key, value in pairs}
        own = {key: element.get(key) for key in STYLES if element.get(key)}
        return {**own, **{key: value for key, value in written.items() if key in STYLES}}

    def moved(self, element, matrix):
        text = element.get("transform")
        if not text:
            return matrix
        try:
            own = self.svg.Matrix(text)
            if not all(map(math.isfinite, (own.a, own.b, own.c, own.d, float(own.e), float(own.f)))):
                raise ValueError(text)
        except (ValueError, TypeError, IndexError) as error:
            raise ImportFailed(f"a transform that is none: {text[:40]!r}", str(self.path),
                               element.sourceline) from error
        return own * matrix

    def use(self, element, matrix, style, layers, depth: int) -> None:
        name = self.used(element)
        if name not in self.named:
            self.scene.report.left_out("<use>", "of something outside the file")
            return
        x, y = (self.length(element.get(axis)) for axis in "xy")
        self.walk(self.named[name], self.svg.Matrix.translate(x, y) * matrix, style, layers, depth + 1)

    def length(self, text: str | None) -> float:
        found = re.match(r"\s*([-+]?\d*\.?\d+(?:[eE][-+]?\d+)?)", text or "")
        return float(found[1]) if found else 0.0

    def shape(self, element, kind: str, matrix, style: dict[str, str], layers: list[str]) -> None:
        wanted = self.options.kind(layers, self.has_walls)
        if wanted is None:
            self.scene.report.left_out(f"shapes of {layers[0] if layers else 'no layer'}", "not a layer that is chosen")
            return
        for points in self.flattened(element, kind, matrix):
            self.place(points, wanted, style, layers, abs(matrix.determinant) ** 0.5)

    def flattened(self, element, kind: str, matrix) -> list[list[tuple[float, float]]]:
        """Lines in metres."""
        kinds = {"path": "Path", "rect": "Rect", "circle": "Circle", "ellipse": "Ellipse", "line": "SimpleLine",
                 "polyline": "Polyline", "polygon": "Polygon"}
        given = {key: value for key, value in element.attrib.items() if key not in ("style", "transform", "class")}
        try:
            made = getattr(self.svg, kinds[kind])(given)
            path = abs(self.svg.Path(made) * matrix)
        except (ValueError, TypeError, IndexError, AttributeError, ZeroDivisionError) as error:
            raise ImportFailed(f"<{kind}> that is none: {error}", str(self.path), element.sourceline) from error
        lines: list[list[tuple[float, float]]] = []
        for segment in path:
            if isinstance(segment, self.svg.Move):
                lines.append([])
            lines[-1:] = [[*(lines[-1] if lines else []), *self.along(segment)]]
        return [line for line in lines if len(line) > 1]

    def along(self, segment) -> list[tuple[float, float]]:
        """The points of a segment, so many that curves are as near as is asked for."""
        if segment.end is None:
            return []
        steps = 1
        if not isinstance(segment, (self.svg.Move, self.svg.Line, self.svg.Close)):
            low_x, low_y, high_x, high_y = segment.bbox()
            size = self.unit * (abs(high_x - low_x) + abs(high_y - low_y))
            steps = int(min(max(4, math.ceil(1.5 * math.sqrt(size / self.options.tolerance))), 256)) \
                if math.isfinite(size) else 1
        points = [segment.point(step / steps) for step in range(1, steps)] + [segment.end]
        return [(self.unit * point.x, -self.unit * point.y) for point in points]

    def place(self, points, wanted: str, style: dict[str, str], layers: list[str], scale: float) -> None:
        name, closed = layers[-1] if layers else "shape", points[0] == points[-1] and len(points) > 3
        width = self.unit * scale * self.length(style.get("stroke-width", "1"))
        if wanted == "areas":
            self.scene.area(self.scene.polygon(points, "areas"), name)
        elif wanted == "roads":
            self.scene.road(points, width, name)
        elif closed and style.get("fill", "black") != "none":
            self.scene.solid(self.scene.polygon(points, "walls"))
        elif style.get("stroke", "none") != "none" or not closed:
            self.scene.line(points, max(width, 0.01))
        else:
            self.scene.report.left_out("shapes", "neither filled nor drawn")
