# SPDX-License-Identifier: Apache-2.0
"""OpenStreetMap's XML: buildings, ways for people on foot, plazas, crossings, steps and barriers, about a local
origin."""
from __future__ import annotations

import pathlib

import numpy
import shapely

from ..base.errors import ImportFailed
from .files import Reader, children, read_xml
from .geojson import place
from .options import Options
from .projection import to_metres
from .scene import Scene
from .tags import meaning

ROOT = "osm"
NODES = ("barrier", "highway", "entrance", "amenity", "natural")  # keys of nodes that are told of


def read(path: pathlib.Path, scene: Scene, options: Options) -> None:
    Map(path, scene).take()


class Map:
    def __init__(self, path: pathlib.Path, scene: Scene):
        self.reader, self.scene, root = Reader(path), scene, read_xml(path, ROOT)
        self.root = root
        nodes = [each for each in children(root, "node") if each.get("action") != "delete"]
        if not nodes:
            raise ImportFailed("has no nodes", str(path))
        degrees = numpy.array([[self.reader.attribute(node, "lon"), self.reader.attribute(node, "lat")]
                               for node in nodes])
        self.nodes = dict(zip((node.get("id") for node in nodes), to_metres(degrees, scene.report).tolist()))
        self.ways = {way.get("id"): way for way in children(root, "way")}
        self.of_relations: set[str] = set()

    def take(self) -> None:
        for relation in children(self.root, "relation"):
            self.relation(relation)
        for number, way in self.ways.items():
            tags = self.tags(way)
            if tags and not (number in self.of_relations and "building" not in tags and "highway" not in tags):
                self.way(way, tags)
        for node in children(self.root, "node"):
            tags = self.tags(node)
            for key in NODES:
                self.scene.report.left_out(f"nodes with {key}={tags.get(key)}", "have no extent", key in tags)

    def tags(self, element) -> dict[str, str]:
        return {each.get("k"): each.get("v") or "" for each in children(element, "tag")}

    def points(self, way) -> list[list[float]]:
        found = [self.nodes[each.get("ref")] for each in children(way, "nd") if each.get("ref") in self.nodes]
        self.scene.report.altered("ways", "reach out of the file, and were cut",
                                  len(found) < len(children(way, "nd")))
        return found

    def way(self, way, tags: dict[str, str]) -> None:
        points = self.points(way)
        closed = len(points) > 3 and points[0] == points[-1]
        found = meaning(tags, closed)
        if found is None:
            self.scene.report.left_out("ways", "with tags that do not concern people on foot")
        elif not found.kind:
            self.scene.report.left_out(found.what, found.why)
        elif len(points) < 2:
            self.scene.report.left_out(found.what, "fewer than two points in the file")
        else:
            name = tags.get("name") or f"{found.what[:-1] if found.what.endswith('s') else found.what} {way.get('id')}"
            self.scene.report.altered("steps", "are flat here", found.what == "steps")
            self.scene.report.altered(found.what, "lie on the ground here", tags.get("bridge", "no") != "no")
            filled = closed and found.kind in ("building", "area")
            place(shapely.Polygon(points) if filled else shapely.LineString(points), found, self.scene, name, {})

    def relation(self, relation) -> None:
        tags = self.tags(relation)
        if tags.get("type") != "multipolygon":
            self.scene.report.left_out(f"relations of the type {tags.get('type')}", "has no counterpart")
            return
        found = meaning(tags, True)
        if found is None or not found.kind:
            self.scene.report.left_out("multipolygons" if found is None else found.what,
                                       "with tags that do not concern people on foot" if found is None else found.why)
            return
        members = {"outer": [], "inner": []}
        for member in children(relation, "member"):
            way = self.ways.get(member.get("ref"))
            if member.get("type") == "way" and way is not None:
                self.of_relations.add(member.get("ref"))
                line = self.points(way)
                if len(line) > 1:
                    members["inner" if member.get("role") == "inner" else "outer"].append(shapely.LineString(line))
        outer, inner = map(_filled, members.values())
        if outer.is_empty:
            self.scene.report.left_out(found.what, "relations without a closed outline in the file")
            return
        place(shapely.make_valid(outer.difference(inner)), found, self.scene,
              tags.get("name") or f"relation {relation.get('id')}", {})


def _filled(lines: list[shapely.LineString]) -> shapely.Geometry:
    """What lines enclose."""
    if not lines:
        return shapely.Polygon()
    rings = shapely.polygonize(shapely.get_parts(shapely.union_all(lines)))
    return shapely.union_all(shapely.get_parts(rings))
