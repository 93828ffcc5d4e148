# SPDX-License-Identifier: Apache-2.0
"""What importers gather: walls, areas, roads and people, cleaned to what a layout may hold."""
from __future__ import annotations

import collections
import itertools
import math
from collections.abc import Iterable, Sequence
from typing import Any

import shapely
import shapely.affinity

from ..base.errors import ImportFailed
from ..base.geometry import polygons
from .report import Report

Point = Sequence[float]
FARTHEST = 1e8              # a coordinate, as layouts have them
MOST_PEOPLE = 1_000_000
MOST_POINTS = {"wall": 10_000, "area": 2_000, "road": 10_000}
SPEEDS, RADII = (0.05, 10.0), (0.1, 1.0)
DIGITS = 4                  # a tenth of a millimetre
SMALLEST = 1e-4             # m^2; what is smaller is no obstacle
PACE, SLACK = 0.6, 2.0      # of the time that is given to everybody: a slow walk, and as much again
LONGEST = 86400.0
ROUND_A_GOAL = 0.45         # m: a disc of this radius times the square root of a number holds so many people


class Scene:
    def __init__(self, name: str, report: Report):
        self.name, self.report = name, report
        self.duration: float | None = None
        self.walls: list[dict] = []
        self.areas: list[dict] = []
        self.roads: list[dict] = []
        self.flows: list[dict] = []
        self.formations: list[dict] = []
        self.people = 0
        self._names: dict[str, int] = {}

    # ---- points

    def point(self, x: float, y: float) -> list[float]:
        if not (math.isfinite(x) and math.isfinite(y) and abs(x) <= FARTHEST and abs(y) <= FARTHEST):
            raise ImportFailed(f"expected coordinates from -{FARTHEST:g} to {FARTHEST:g}, found {x:g}, {y:g}",
                               self.report.source)
        return [round(float(x), DIGITS), round(float(y), DIGITS)]

    def points(self, given: Iterable[Point]) -> list[list[float]]:
        """Without those that repeat the one before."""
        return [point for point, _ in itertools.groupby(self.point(each[0], each[1]) for each in given)]

    def unique(self, wanted: str) -> str:
        """A name that nothing else has."""
        name = " ".join(str(wanted).replace(":", " ").split())[:100] or "thing"
        self._names[name] = count = self._names.get(name, 0) + 1
        return name if count == 1 else self.unique(f"{name} {count}")

    # ---- things

    def polygon(self, ring: Iterable[Point], what: str, holes: Iterable[Iterable[Point]] = ()) -> shapely.Geometry:
        """Mended where it crosses itself."""
        outline = self.points(ring)
        if len(outline) > 1 and outline[0] == outline[-1]:
            outline.pop()
        if len(outline) < 3:
            self.report.left_out(what, "has fewer than three corners")
            return shapely.Polygon()
        rings = [points for points in map(self.points, holes) if len(points) > 2]
        shape = shapely.Polygon(outline, rings)
        if not shape.is_valid:
            self.report.altered(what, "crossed itself, and was mended")
            shape = shapely.make_valid(shape)
        return shape

    def solid(self, shape: shapely.Geometry, name: str = "", height: float | None = None, what: str = "walls") -> None:
        """A wall that fills a polygon. One with holes becomes several without."""
        for piece in (part for whole in polygons(shape) for part in _without_holes(whole)):
            piece = self._simple(piece, "wall", what)
            corners = self.points(piece.exterior.coords)[:-1] if not piece.is_empty else []
            if len(corners) < 3 or piece.area < SMALLEST:
                self.report.left_out(what, "smaller than a square centimetre")
                continue
            self._wall({"closed": True, "points": corners}, name, height, what)

    def line(self, points: Iterable[Point], thickness: float = 0.1, name: str = "", height: float | None = None,
             what: str = "walls") -> None:
        way = self.points(points)
        if len(way) < 2:
            self.report.left_out(what, "a line without a length")
            return
        for first in range(0, len(way) - 1, MOST_POINTS["wall"] - 1):
            part = way[first:first + MOST_POINTS["wall"]]
            self._wall({"points": part, "thickness": round(min(max(thickness, 0.0), 100.0), DIGITS)}, name, height,
                       what)

    def _wall(self, wall: dict, name: str, height: float | None, what: str) -> None:
        if name:
            wall["id"] = self.unique(name)
        if height is not None:
            wall["height"] = round(min(max(height, 0.01), 1000.0), 2)
        self.walls.append(wall)
        self.report.took(what)

    def enclosure(self, shape: shapely.Geometry, thickness: float = 0.2, what: str = "walkable areas") -> None:
        """Walls round ground that is not left, their faces on its edge; what is cut out of it is solid."""
        grounds = polygons(shape)
        around = shapely.union_all([shapely.Polygon(ground.exterior).buffer(thickness, join_style="mitre")
                                    for ground in grounds])
        self.solid(around.difference(shapely.union_all(grounds)), what="walls round walkable areas")
        self.report.took(what, len(grounds))

    def area(self, shape: shapely.Geometry, name: str, what: str = "areas") -> str | None:
        """The name that the area has got; of several pieces, the largest is taken."""
        pieces = sorted(polygons(shape), key=lambda piece: -piece.area)
        if not pieces or pieces[0].area < SMALLEST:
            self.report.left_out(what, "without an area")
            return None
        self.report.altered(what, "in pieces, of which only the largest was taken", len(pieces) > 1)
        self.report.altered(what, "has holes, which were filled", bool(pieces[0].interiors))
        whole = self._simple(shapely.Polygon(pieces[0].exterior), "area", what)
        found = self.unique(name)
        self.areas.append({"id": found, "polygon": self.points(whole.exterior.coords)[:-1]})
        self.report.took(what)
        return found

    def road(self, points: Iterable[Point], width: float, name: str, what: str = "roads",
             one_way: bool = False) -> None:
        way = self.points(points)
        if len(way) < 2:
            self.report.left_out(what, "a line without a length")
            return
        line = shapely.LineString(way)
        if len(way) > MOST_POINTS["road"]:
            raise ImportFailed(f"a road of more than {MOST_POINTS['road']} points", self.report.source)
        road = {"id": self.unique(name), "centreline": [list(point) for point in line.coords],
                "width": round(min(max(width, 0.5), 1000.0), 2)}
        self.roads.append({**road, "one_way": True} if one_way else road)
        self.report.took(what)

    def _simple(self, shape: shapely.Polygon, kind: str, what: str) -> shapely.Polygon:
        """With no more corners than a layout may have."""
        tolerance = 0.001
        while len(shape.exterior.coords) > MOST_POINTS[kind]:
            self.report.altered(what, "has too many corners, and was made simpler", tolerance == 0.001)
            shape, tolerance = shape.simplify(tolerance), 2 * tolerance
        return shape

    # ---- people

    def flow(self, name: str, count: int, **keys: Any) -> None:
        self._more(count)
        self.flows.append({"id": self.unique(name), **keys, "count": count})
        self.report.took("people", count)

    def person(self, position: Point, goal: Point | str, speed: float | None = None, radius: float | None = None,
               heading: float | None = None, via: Sequence[tuple[Point, float]] = (), start: float = 0.0) -> dict:
        """One of a list of agents. `goal`: a point, or the name of a place; `via`: places on the way and how long to
        wait there; `start`: when it comes; s."""
        self._more(1)
        person: dict[str, Any] = {"position": self.point(*position[:2]),
                                  "goal": goal if isinstance(goal, str) else self.point(*goal[:2])}
        if via:
            person["via"] = [{"point": self.point(*point[:2]), **({"wait": round(wait, 4)} if wait > 0 else {})}
                             for point, wait in via]
        if start:
            person["start"] = round(start, 4)
        for key, value, (least, most) in (("speed", speed, SPEEDS), ("radius", radius, RADII)):
            if value is not None:
                self.report.altered("people", f"{key} moved into {least:g} to {most:g}", not least <= value <= most)
                person[key] = round(min(max(value, least), most), DIGITS)
        if heading is not None:
            person["heading"] = round(heading, 2)
        return person

    def agents(self, name: str, people: list[dict], arrival: str = "leave", **keys: Any) -> None:
        if people:
            keys |= self._tolerance(people) if arrival == "stay" else {}
            self.formations.append({"id": self.unique(name), "type": "agents", "agents": people, "arrival": arrival,
                                    **keys})
            self.report.took("people", len(people))

    def _tolerance(self, people: list[dict]) -> dict[str, float]:
        """Those who share a goal and stay there stand round it."""
        most = max(collections.Counter(tuple(person["goal"]) for person in people).values())
        if most == 1:
            return {}
        self.report.altered("goals", "shared by several: people stand round them")
        return {"goal_tolerance": round(min(0.3 + ROUND_A_GOAL * math.sqrt(most), 100.0), 2)}

    def _more(self, count: int) -> None:
        self.people += count
        if self.people > MOST_PEOPLE:
            raise ImportFailed(f"more than {MOST_PEOPLE:,} people", self.report.source)

    # ---- the whole

    def _listed(self) -> list[dict]:
        return [person for group in self.formations for person in group["agents"]]

    def _farthest(self) -> float:
        """The diagonal of everything, m; never nothing."""
        known = [point for wall in self.walls for point in wall["points"]]
        known += [point for area in self.areas for point in area["polygon"]]
        known += [point for road in self.roads for point in road["centreline"]]
        people = self._listed()
        known += [person[key] for person in people for key in ("position", "goal") if not isinstance(person[key], str)]
        known += [stop["point"] for person in people for stop in person.get("via", ())]
        return math.dist(*_corners(known)) if known else 1.0

    def layout(self) -> dict[str, Any]:
        if self.duration is None:
            people = self._listed()
            waits = [sum(stop.get("wait", 0) for stop in person.get("via", ())) for person in people]
            last = max([flow.get("end", 0) for flow in self.flows]
                       + [person.get("start", 0) + wait for person, wait in zip(people, waits)] + [0])
            legs = max([1 + len(person.get("via", ())) for person in people] + [1])
            self.duration = 10 + last + SLACK * legs * self._farthest() / PACE
            self.report.altered("duration", f"chosen: {min(self.duration, LONGEST):.0f} s")
        layout: dict[str, Any] = {"throng": 1, "name": self.name,
                                  "simulation": {"duration": round(min(self.duration, LONGEST), 2)}}
        for key in ("roads", "areas", "walls", "flows", "formations"):
            if getattr(self, key):
                layout[key] = getattr(self, key)
        return layout


def _corners(points: list[Point]) -> tuple[Point, Point]:
    xs, ys = [point[0] for point in points], [point[1] for point in points]
    return (min(xs), min(ys)), (max(xs), max(ys))


def _without_holes(shape: shapely.Polygon) -> list[shapely.Polygon]:
    """Cut through the middle of each hole, until there is none."""
    done, waiting = [], [shape]
    while waiting:
        piece = waiting.pop()
        if not piece.interiors:
            done.append(piece)
            continue
        low_x, low_y, high_x, high_y = piece.bounds
        middle = shapely.Polygon(piece.interiors[0]).centroid.x
        for half in (shapely.box(low_x - 1, low_y - 1, middle, high_y + 1),
                     shapely.box(middle, low_y - 1, high_x + 1, high_y + 1)):
            waiting += polygons(piece.intersection(half))
    return done
