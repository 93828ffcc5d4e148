# SPDX-License-Identifier: Apache-2.0
"""Vadere: a scenario's topography and the people who come and go."""
from __future__ import annotations

import math
import pathlib
from typing import Any

import shapely

from ..base.errors import ImportFailed
from .files import number, read_json
from .scene import Scene

PEOPLE = {"speedDistributionMean": 1.34, "speedDistributionStandardDeviation": 0.26, "minimumSpeed": 0.5,
          "maximumSpeed": 2.2, "radius": 0.2}
# Parts of a topography that have no counterpart, with why.
LEFT = {"measurementAreas": "layouts measure across a line only", "stairs": "the ground is flat",
        "targetChangers": "people do not change their minds on the way", "absorbingAreas": "people leave at goals only",
        "aerosolClouds": "there is no infection", "droplets": "there is no infection"}


def is_one(found: Any) -> bool:
    return isinstance(found, dict) and isinstance(found.get("scenario"), dict) and "topography" in found["scenario"]


def read(path: pathlib.Path, scene: Scene) -> None:
    found = read_json(path)
    if not is_one(found):
        raise ImportFailed("expected a scenario with a topography", str(path))
    try:
        Scenario(path, found, scene).take()
    except (KeyError, TypeError, AttributeError, IndexError) as error:
        raise ImportFailed(f"not the form of a Vadere scenario: {type(error).__name__} {error}", str(path)) from error


class Scenario:
    def __init__(self, path: pathlib.Path, found: dict, scene: Scene):
        self.file, self.scene, self.scenario = str(path), scene, found["scenario"]
        self.topography: dict = self.scenario["topography"]
        self.targets: dict[int, dict] = {}
        self.names: dict[int, str] = {}

    def number(self, holder: dict, key: str, default: float | None = None) -> float:
        value = holder.get(key, default)
        return number(value, key, self.file)

    def take(self) -> None:
        self.scene.duration = self.number(self.scenario.get("attributesSimulation", {}), "finishTime", 500.0)
        self.border()
        for obstacle in self.topography.get("obstacles", []):
            self.scene.solid(self.shape(obstacle["shape"], "obstacles"), what="obstacles")
        for target in self.topography.get("targets", []):
            name = self.scene.area(self.shape(target["shape"], "targets"), f"target {target['id']}", "targets")
            if name:
                self.targets[target["id"]], self.names[target["id"]] = target, name
        for source in self.topography.get("sources", []):
            self.source(source)
        self.standing()
        for key, why in LEFT.items():
            self.scene.report.left_out(key, why, len(self.topography.get(key) or []))
        for key in ("teleporter", "attributesCar"):
            self.scene.report.left_out(key, "has no counterpart", bool(self.topography.get(key)))
        self.scene.report.left_out(f"the model {str(self.scenario.get('mainModel')).rpartition('.')[2]}",
                                   "people move by Throng's own rules")
        self.scene.report.left_out("stimuli", "has no counterpart", len(self.scenario.get("stimulusInfos") or []))

    def border(self) -> None:
        about = self.topography["attributes"]
        if not about.get("bounded", True):
            return
        bounds, width = about["bounds"], self.number(about, "boundingBoxWidth", 0.5)
        x, y = self.number(bounds, "x"), self.number(bounds, "y")
        inside = shapely.box(x + width, y + width, x + self.number(bounds, "width") - width,
                             y + self.number(bounds, "height") - width)
        self.scene.line(inside.buffer(0.1, join_style="mitre").exterior.coords, 0.2, "border", what="borders")

    def shape(self, told: dict, what: str) -> shapely.Geometry:
        kind = told.get("type", "RECTANGLE")
        if kind == "RECTANGLE":
            x, y = self.number(told, "x"), self.number(told, "y")
            return self.scene.polygon(
                shapely.box(x, y, x + self.number(told, "width"), y + self.number(told, "height")).exterior.coords,
                what)
        if kind == "POLYGON":
            return self.scene.polygon([(self.number(point, "x"), self.number(point, "y"))
                                       for point in told["points"]], what)
        if kind == "CIRCLE":
            centre = told["center"]
            return shapely.Point(self.number(centre, "x"), self.number(centre, "y")).buffer(
                self.number(told, "radius"))
        raise ImportFailed(f"a shape of the type {kind!r} is not known", self.file)

    # ---- people

    def ways(self, ids: list[int]) -> dict[str, Any] | None:
        """Where people go: through all targets but the last."""
        known = [each for each in ids if each in self.names]
        if not known:
            return None
        stops = []
        for each in known[:-1]:
            wait = self.waiting(self.targets[each])
            stops.append({"at": self.names[each], "wait": wait} if wait else {"at": self.names[each]})
        last = self.targets[known[-1]]
        absorbing = last.get("absorbing", (last.get("absorber") or {}).get("enabled", True))
        self.scene.report.left_out("waiting at the last target", "people leave at their goal or stay there",
                                   bool(self.waiting(last)))
        keys: dict[str, Any] = {"to": self.names[known[-1]], "arrival": "leave" if absorbing else "stay"}
        return {**keys, "via": stops} if stops else keys

    def waiting(self, target: dict) -> float:
        waiter = target.get("waiter") or {}
        if waiter.get("enabled"):
            return self.number(waiter.get("distribution") or {}, "updateFrequency", 0.0)
        return self.number(target, "waitingTime", 0.0) if "waitingTime" in target else 0.0

    def people(self, given: dict | None) -> dict[str, Any]:
        about = {**(self.topography.get("attributesPedestrian") or {}), **(given or {})}
        mean, deviation, least, most, radius = (self.number(about, key, default) for key, default in PEOPLE.items())
        least, most = max(least, 0.05), min(most, 10.0)
        people: dict[str, Any] = {"speed": {"normal": [min(max(mean, least), most), max(deviation, 0.0)],
                                            "min": least, "max": most}}
        return {**people, "radius": min(max(radius, 0.1), 1.0)}

    def source(self, source: dict) -> None:
        keys = self.ways(source.get("targetIds") or [])
        if keys is None:
            self.scene.report.left_out("sources", "people without a target")
            return
        area = self.scene.area(self.shape(source["shape"], "sources"), f"source {source['id']}", "sources")
        if area is None:
            return
        people = self.people(source.get("attributesPedestrian"))
        sizes = list(source.get("groupSizeDistribution") or [1.0])
        if len(sizes) > 1:
            self.scene.report.left_out("groups of five and more", "groups are up to four", any(sizes[4:]))
            if sum(sizes[:4]) > 0:
                people["groups"] = [max(0.0, size) for size in sizes[:4]]
        count = self.count(source)
        self.scene.report.left_out("sources", "bring nobody", not count)
        if count:
            self.scene.flow(area, count, **{"from": area}, **keys, **self.span(source), people=people)

    def spawner(self, source: dict) -> dict[str, Any]:
        """What the versions 1 and 2 of the format say, in one form."""
        new = source.get("spawner")
        if not new:
            kind = str(source.get("interSpawnTimeDistribution", "")).rpartition(".")[2]
            numbers = source.get("distributionParameters") or [1.0]
            return {"kind": kind, "numbers": numbers if isinstance(numbers, list) else list(numbers.values()),
                    "each": source.get("spawnNumber", 1), "most": source.get("maxSpawnNumberTotal", -1),
                    "start": source.get("startTime", 0.0), "end": source.get("endTime", 0.0)}
        shape = new.get("distribution") or {}
        return {"kind": str(shape.get("type", "")).rpartition(".")[2].replace("Attributes", ""),
                "numbers": [value for key, value in shape.items() if key != "type"],
                "each": new.get("eventElementCount", 1), "most": new.get("constraintsElementsMax", -1),
                "start": new.get("constraintsTimeStart", 0.0), "end": new.get("constraintsTimeEnd", 0.0)}

    def span(self, source: dict) -> dict[str, float]:
        told = self.spawner(source)
        start = min(max(number(told["start"], "start of a source", self.file), 0.0), 86400.0)
        end = min(number(told["end"], "end of a source", self.file), self.scene.duration)
        if end <= start:
            self.scene.report.altered("sources", "bring people all at once: within a second")
            end = start + 1.0
        return {"start": start, "end": end}

    def count(self, source: dict) -> int:
        """How many a source brings in all."""
        told, each = self.spawner(source), number(self.spawner(source)["each"], "number of a source", self.file)
        start, end = (number(told[key], f"{key} of a source", self.file) for key in ("start", "end"))
        seconds = min(end, self.scene.duration) - start
        events = 1.0
        if seconds > 0:
            values = [number(value, "parameter of a source", self.file) for value in told["numbers"]]
            interval = values[0] if values else 0.0
            if told["kind"] == "PoissonDistribution":
                interval = 1.0 / interval if interval > 0 else 0.0
            if interval <= 0:
                self.scene.report.left_out("sources", f"without an interval ({told['kind']})")
                return 0
            if told["kind"] != "ConstantDistribution":
                self.scene.report.altered("sources", f"{told['kind']}: as many on average, at even intervals")
            events = math.floor(seconds / interval + 1e-9) + 1
        count, most = int(each * events), number(told["most"], "most of a source", self.file)
        return count if most < 0 else min(count, int(most))

    def standing(self) -> None:
        people = []
        for person in self.topography.get("dynamicElements", []):
            if person.get("type", "PEDESTRIAN") != "PEDESTRIAN":
                self.scene.report.left_out(f"elements of the type {person.get('type')}", "has no counterpart")
                continue
            position = person["position"]
            place = self.number(position, "x"), self.number(position, "y")
            ids = [each for each in person.get("targetIds") or [] if each in self.names]
            self.scene.report.altered("targets on the way of single people", "their middles", len(ids) > 1)
            if not ids:
                self.scene.report.altered("people", "without a target: they stay where they are")
            goal = self.names[ids[-1]] if ids else place
            speed = person.get("freeFlowSpeed")
            people.append(self.scene.person(
                place, goal, None if speed is None else number(speed, "freeFlowSpeed", self.file),
                self.number(person.get("attributes") or {}, "radius", 0.2),
                via=[(self.middle(each), self.waiting(self.targets[each])) for each in ids[:-1]]))
        self.scene.agents("dynamic elements", people)

    def middle(self, target: int) -> tuple[float, float]:
        point = self.shape(self.targets[target]["shape"], "targets").representative_point()
        return point.x, point.y
