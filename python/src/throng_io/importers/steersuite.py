# SPDX-License-Identifier: Apache-2.0
"""SteerSuite: test cases of SteerBench. Their ground is x and z, y is up: here x and -z."""
from __future__ import annotations

import collections
import itertools
import math
import pathlib
import random

import shapely
import shapely.affinity

from ..base.errors import ImportFailed
from .files import Reader, child, children, read_xml, tag
from .scene import RADII, Scene

ROOT = "SteerBenchTestCase"
OVERHEAD = 2.2        # m; what begins higher is walked under
TRIES = 200           # for a random place that is free
MOST_AT_RANDOM = 100_000
CELL = 2 * RADII[1]   # m: who touch are in cells that are neighbours
KNOWN = ("header", "suggestedCameraView", "obstacle", "circleObstacle", "orientedBoxObstacle", "obstacleRegion",
         "agent", "agentRegion")


def read(path: pathlib.Path, scene: Scene) -> None:
    case = Case(path, scene)
    for kind in ("obstacle", "circleObstacle", "orientedBoxObstacle"):
        for element in children(case.root, kind):
            case.obstacle(element)
    for element in children(case.root, "obstacleRegion"):
        case.obstacle_region(element)
    people = [case.agent(element, element) for element in children(case.root, "agent")]
    for element in children(case.root, "agentRegion"):
        people += case.agent_region(element)
    scene.agents("agents", people)
    for element in case.root:
        if tag(element) not in KNOWN:
            scene.report.left_out(f"<{tag(element)}>", "has no counterpart")
    scene.report.left_out("camera views", "layouts have no cameras", len(children(case.root, "suggestedCameraView")))


class Case:
    def __init__(self, path: pathlib.Path, scene: Scene):
        self.reader, self.root, self.scene = Reader(path), read_xml(path, ROOT), scene
        self.random = random.Random(1)
        self.solids: list[shapely.Geometry] = []
        self.taken: dict[tuple[int, int], list[tuple[float, float, float]]] = collections.defaultdict(list)
        header = child(self.root, "header")
        bounds = None if header is None else child(header, "worldBounds")
        self.world = (-100.0, -100.0, 100.0, 100.0) if bounds is None else self.box(bounds)

    def box(self, element) -> tuple[float, float, float, float]:
        low_x, high_x, low_z, high_z = (self.reader.text(element, name) for name in ("xmin", "xmax", "zmin", "zmax"))
        return min(low_x, high_x), -max(low_z, high_z), max(low_x, high_x), -min(low_z, high_z)

    def place(self, element) -> tuple[float, float]:
        return self.reader.text(element, "x"), -self.reader.text(element, "z")

    def part(self, element, name: str):
        found = child(element, name)
        if found is None:
            raise ImportFailed(f"<{tag(element)}> without <{name}>", self.reader.file, element.sourceline)
        return found

    def obstacle(self, element) -> None:
        if tag(element) == "obstacle":
            low, height = self.reader.text(element, "ymin", 0.0), self.reader.text(element, "ymax", 1.0)
            if low >= OVERHEAD:
                self.scene.report.left_out("obstacles", "overhead")
                return
            shape = shapely.box(*self.box(element))
        elif tag(element) == "circleObstacle":
            height = self.reader.text(element, "height", 1.0)
            shape = shapely.Point(self.place(self.part(element, "position"))).buffer(
                abs(self.reader.text(element, "radius")))
        else:
            size, (x, y) = self.part(element, "size"), self.place(self.part(element, "position"))
            height = self.reader.text(size, "y", 1.0)
            half_x, half_z = (0.5 * self.reader.text(size, name) for name in "xz")
            shape = shapely.affinity.rotate(shapely.box(x - half_x, y - half_z, x + half_x, y + half_z),
                                            self.reader.text(element, "thetaY", 0.0))
        self.solid(shape, height)

    def solid(self, shape: shapely.Geometry, height: float) -> None:
        self.solids.append(shape)
        self.scene.solid(shape, height=height if height > 0 else None, what="obstacles")

    def obstacle_region(self, element) -> None:
        count, size = self.count(element, "numObstacles"), self.reader.text(element, "obstacleSize")
        low_x, low_y, high_x, high_y = self.box(self.part(element, "regionBounds"))
        self.scene.report.altered("obstacles", "at random: placed by a seed of ours", count)
        for _ in range(count):
            x, y = self.random.uniform(low_x, high_x), self.random.uniform(low_y, high_y)
            self.solid(shapely.box(x - size / 2, y - size / 2, x + size / 2, y + size / 2),
                       self.reader.text(element, "obstacleHeight", 1.0))

    def count(self, element, name: str) -> int:
        count = self.reader.text(element, name)
        if not 0 <= count <= MOST_AT_RANDOM:
            raise ImportFailed(f"{name}: expected 0 to {MOST_AT_RANDOM}, found {count:g}", self.reader.file,
                               element.sourceline)
        return int(count)

    def agent_region(self, element) -> list[dict]:
        count, box = self.count(element, "numAgents"), self.box(self.part(element, "regionBounds"))
        self.scene.report.altered("people", "at random: placed by a seed of ours", count)
        return [self.agent(element, element, box) for _ in range(count)]

    def free_place(self, box, radius: float) -> tuple[float, float]:
        """Where nobody and nothing is, if there is such a place."""
        tree = shapely.STRtree(self.solids)
        for _ in range(TRIES):
            x, y = self.random.uniform(box[0], box[2]), self.random.uniform(box[1], box[3])
            if not len(tree.query(shapely.Point(x, y), predicate="dwithin", distance=radius)) and all(
                    math.hypot(x - other_x, y - other_y) >= radius + other for other_x, other_y, other in
                    self.near(x, y)):
                return x, y
        self.scene.report.altered("people", "at random: found no free place, and stand in each other")
        return x, y

    def cell(self, x: float, y: float) -> tuple[int, int]:
        return math.floor(x / CELL), math.floor(y / CELL)

    def near(self, x: float, y: float):
        """Who may be in the way."""
        column, row = self.cell(x, y)
        for place in itertools.product((column - 1, column, column + 1), (row - 1, row, row + 1)):
            yield from self.taken.get(place, ())

    def agent(self, element, holder, box=None) -> dict:
        start = self.part(holder, "initialConditions")
        radius = self.reader.text(start, "radius", 0.5)
        position = child(start, "position")
        if box is None and position is not None and child(position, "random") is None:
            x, y = self.place(position)
        else:
            x, y = self.free_place(box or self.world, min(radius, RADII[1]))
        self.taken[self.cell(x, y)].append((x, y, min(radius, RADII[1])))
        direction, heading = child(start, "direction"), None
        if direction is not None and child(direction, "random") is None:
            along_x, along_y = self.place(direction)
            heading = math.degrees(math.atan2(along_y, along_x))
        (*via, goal), speed = self.goals(element, (x, y))
        return self.scene.person((x, y), goal, speed, radius, heading, [(place, 0.0) for place in via])

    def goals(self, element, position) -> tuple[list[tuple[float, float]], float | None]:
        """The places of the sequence that stand still."""
        sequence = child(element, "goalSequence")
        found, speed = [], None
        for goal in [] if sequence is None else sequence:
            target = child(goal, "targetLocation")
            if tag(goal) != "seekStaticTarget" or target is None:
                self.scene.report.left_out(f"goals of the kind {tag(goal)}", "has no counterpart")
                continue
            if child(target, "random") is not None:
                found.append(self.free_place(self.world, 0.5))
                self.scene.report.altered("goals", "at random: placed by a seed of ours")
            else:
                found.append(self.place(target))
            speed = self.reader.text(goal, "desiredSpeed", 1.3)
        self.scene.report.altered("people", "without a goal: they stay where they are", not found)
        return found or [position], speed
