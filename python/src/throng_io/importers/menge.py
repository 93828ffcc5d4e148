# SPDX-License-Identifier: Apache-2.0
"""Menge: a project's scene and behaviour."""
from __future__ import annotations

import dataclasses
import math
import pathlib
import random
from collections.abc import Callable

import shapely

from ..base.errors import ImportFailed
from .files import Reader, child, children, read_xml, tag
from .scene import MOST_PEOPLE, Scene

ROOT = "Project"
RADIUS, SPEED = 0.19, 1.34
Point = tuple[float, float]
MODELS = ("SpatialQuery", "Elevation", "AgentProfile", "AgentGroup", "ObstacleSet", "Common")


def read(path: pathlib.Path, scene: Scene) -> None:
    reader, project = Reader(path), read_xml(path, ROOT)
    if project.get("duration"):
        scene.duration = reader.attribute(project, "duration")
    scene_path = reader.beside(project.get("scene"), project)
    behaviour_path = reader.beside(project.get("behavior"), project)
    behaviour = Behaviour(behaviour_path, scene)
    Experiment(scene_path, scene, behaviour).take()
    scene.report.left_out("the view", "layouts have no cameras", bool(project.get("view")))


class Experiment:
    """The scene: profiles, groups of agents, obstacles."""

    def __init__(self, path: pathlib.Path, scene: Scene, behaviour: Behaviour):
        self.reader, self.root, self.scene = Reader(path), read_xml(path, "Experiment"), scene
        self.behaviour, self.random = behaviour, random.Random(1)
        self.profiles = {each.get("name"): each for each in children(self.root, "AgentProfile")}

    def take(self) -> None:
        for group in children(self.root, "AgentGroup"):
            self.group(group)
        for obstacles in children(self.root, "ObstacleSet"):
            self.obstacles(obstacles)
        for element in self.root:
            if tag(element) not in MODELS:
                self.scene.report.left_out(f"<{tag(element)}>", "people move by Throng's own rules")
            elif tag(element) == "Elevation" and element.get("type") != "flat":
                self.scene.report.left_out("elevation", "the ground is flat")

    def obstacles(self, element) -> None:
        if element.get("type", "explicit") != "explicit":
            self.scene.report.left_out(f"obstacles of the type {element.get('type')}", "are in a file of their own")
            return
        for obstacle in children(element, "Obstacle"):
            ring = [(self.reader.attribute(point, "p_x"), self.reader.attribute(point, "p_y"))
                    for point in children(obstacle, "Vertex")]
            if obstacle.get("closed", "1") not in ("1", "true"):
                self.scene.line(ring, what="obstacles")
            elif len(ring) > 2 and shapely.Polygon(ring).is_valid and not shapely.LinearRing(ring).is_ccw:
                # Menge's people are inside of obstacles that go round clockwise.
                self.scene.line([*ring, ring[0]], what="obstacles")
            else:
                self.scene.solid(self.scene.polygon(ring, "obstacles"), what="obstacles")

    def value(self, name: str | None, key: str, default: float) -> float | Callable[[], float]:
        """Of a profile, or of the one that it inherits from."""
        seen = set()
        while name is not None:
            if name in seen:
                raise ImportFailed(f"profiles inherit from each other in a circle: {name!r}", self.reader.file)
            seen.add(name)
            profile = self.profiles.get(name)
            if profile is None:
                raise ImportFailed(f"there is no profile {name!r}", self.reader.file)
            common = child(profile, "Common")
            for told in [] if common is None else children(common, "Property"):
                if told.get("name") == key:
                    return self.distribution(told, "value", "mean")
            if common is not None and common.get(key) is not None:
                return self.reader.attribute(common, key)
            name = profile.get("inherits")
        return default

    def distribution(self, told, constant: str = "value", mean: str = "mean") -> Callable[[], float]:
        kind = told.get("dist", "c")
        number = self.reader.attribute
        if kind == "c":
            value = number(told, constant)
            return lambda: value
        if kind == "u":
            least, most = number(told, "min"), number(told, "max")
            return lambda: self.random.uniform(least, most)
        if kind == "n":
            middle, deviation = number(told, mean), number(told, "stddev")
            least, most = number(told, "min", middle - 3 * deviation), number(told, "max", middle + 3 * deviation)
            return lambda: min(max(self.random.gauss(middle, deviation), least), most)
        raise ImportFailed(f"a distribution of the kind {kind!r} is not known", self.reader.file, told.sourceline)

    def chosen(self, group, what: str) -> list[tuple[str, float]]:
        """[(name, weight)] of profiles or states."""
        selector = child(group, f"{what}Selector")
        if selector is None:
            raise ImportFailed(f"a group without <{what}Selector>", self.reader.file, group.sourceline)
        if selector.get("type") == "const":
            return [(selector.get("name"), 1.0)]
        found = [(each.get("name"), self.reader.attribute(each, "weight", 1.0)) for each in selector]
        if not found:
            raise ImportFailed(f"<{what}Selector> that has nothing to choose", self.reader.file, selector.sourceline)
        return found

    def group(self, group) -> None:
        profiles, states = self.chosen(group, "Profile"), self.chosen(group, "State")
        people = []
        for place in self.places(group):
            profile, state = self.drawn(profiles), self.drawn(states)
            speed, radius = (value() if callable(value) else value for value in (
                self.value(profile, "pref_speed", SPEED), self.value(profile, "r", RADIUS)))
            *via, (goal, _) = self.behaviour.goals_of(state, place)
            people.append(self.scene.person(place, goal, speed, radius, via=via))
        self.scene.agents(profiles[0][0] or "agents", people, "stay")

    def drawn(self, choices: list[tuple[str, float]]) -> str:
        names, weights = zip(*choices)
        if not sum(weights) > 0 or min(weights) < 0:
            raise ImportFailed("weights: expected numbers of which one is above 0", self.reader.file)
        return self.random.choices(names, weights)[0]

    def places(self, group) -> list[Point]:
        generator = child(group, "Generator")
        kind = None if generator is None else generator.get("type")
        if kind == "explicit":
            found = [(self.reader.attribute(each, "p_x"), self.reader.attribute(each, "p_y"))
                     for each in children(generator, "Agent")]
        elif kind == "rect_grid":
            found = self.grid(generator)
        else:
            self.scene.report.left_out(f"groups of the generator {kind}", "has no counterpart")
            found = []
        most = 0.0 if generator is None else self.reader.attribute(generator, "displace_max", 0.0)
        if not most:
            return found
        self.scene.report.altered("people", "displaced at random: by a seed of ours", len(found))
        angles = [(self.random.uniform(0, math.tau), self.random.uniform(0, most)) for _ in found]
        return [(x + far * math.cos(angle), y + far * math.sin(angle)) for (x, y), (angle, far) in zip(found, angles)]

    def grid(self, told) -> list[Point]:
        (anchor_x, anchor_y, offset_x, offset_y), turn = (
            [self.reader.attribute(told, key) for key in ("anchor_x", "anchor_y", "offset_x", "offset_y")],
            math.radians(self.reader.attribute(told, "rotation", 0.0)))
        columns, rows = (int(self.reader.attribute(told, key)) for key in ("count_x", "count_y"))
        if not (0 <= columns <= MOST_PEOPLE and 0 <= rows <= MOST_PEOPLE and columns * rows <= MOST_PEOPLE):
            raise ImportFailed(f"a grid of {columns} x {rows} people", self.reader.file, told.sourceline)
        cosine, sine = math.cos(turn), math.sin(turn)
        offsets = [(column * offset_x, row * offset_y) for column in range(columns) for row in range(rows)]
        return [(anchor_x + cosine * x - sine * y, anchor_y + sine * x + cosine * y) for x, y in offsets]


@dataclasses.dataclass
class Transition:
    """Out of a state: where to, each with a weight, and after how long if that is told."""

    targets: list[tuple[str, float]]
    seconds: Callable[[], float] | None


class Behaviour:
    """The state machine: where the people of a state go in the end."""

    def __init__(self, path: pathlib.Path, scene: Scene):
        self.reader, self.scene, self.random = Reader(path), scene, random.Random(2)
        self.root = read_xml(path, "BFSM")
        self.states = {each.get("name"): each for each in children(self.root, "State")}
        self.goals: dict[str, dict[str, tuple[Callable[[], Point], float]]] = {}
        for goals in children(self.root, "GoalSet"):
            self.goals[goals.get("id")] = {each.get("id"): self.place(each) for each in children(goals, "Goal")}
        self.next: dict[str, Transition] = {}
        for transition in children(self.root, "Transition"):
            self.transition(transition)
        for state in self.states.values():
            scene.report.left_out("actions of states", "has no counterpart", len(children(state, "Action")))

    def place(self, goal) -> tuple[Callable[[], Point], float]:
        """What draws a point of it, and its weight."""
        number, kind = self.reader.attribute, goal.get("type")
        weight, uniform = number(goal, "weight", 1.0), self.random.uniform
        self.scene.report.altered("goals", "with an extent: everybody goes to a point of them", kind != "point")
        if kind == "AABB":
            low, high = ((number(goal, f"{end}_x"), number(goal, f"{end}_y")) for end in ("min", "max"))
            return lambda: (uniform(low[0], high[0]), uniform(low[1], high[1])), weight
        if kind not in ("point", "circle", "OBB"):
            raise ImportFailed(f"a goal of the type {kind!r} is not known", self.reader.file, goal.sourceline)
        x, y = number(goal, "x"), number(goal, "y")
        if kind == "OBB":
            angle = math.radians(number(goal, "angle", 0.0))
            width, height = number(goal, "width"), number(goal, "height")
            cosine, sine = math.cos(angle), math.sin(angle)

            def in_box() -> Point:
                along, across = uniform(0, width), uniform(0, height)
                return x + cosine * along - sine * across, y + sine * along + cosine * across

            return in_box, weight
        radius = number(goal, "radius") if kind == "circle" else 0.0

        def in_disc() -> Point:
            angle, far = uniform(0, math.tau), radius * math.sqrt(self.random.random())
            return x + far * math.cos(angle), y + far * math.sin(angle)

        return (in_disc if radius else lambda: (x, y)), weight

    def transition(self, transition) -> None:
        targets = self.targets(transition)
        condition = child(transition, "Condition")
        kind = None if condition is None else condition.get("type")
        self.scene.report.altered("transitions", f"by {kind}: people go on when they are there",
                                  kind not in (None, "goal_reached", "auto", "timer"))
        seconds = self.seconds(condition) if kind == "timer" else None
        for state in (transition.get("from") or "").split(","):
            if not targets:
                self.scene.report.left_out("transitions", "without a state to go to")
            elif state.strip() in self.next:
                self.scene.report.left_out("further transitions of a state", "the first is taken")
            else:
                self.next[state.strip()] = Transition(targets, seconds)

    def targets(self, transition) -> list[tuple[str, float]]:
        """[(state, weight)] of those that it leads to: everybody draws one of them."""
        if transition.get("to") is not None:
            return [(transition.get("to"), 1.0)]
        within = child(transition, "Target")
        states = [] if within is None else children(within, "State")
        found = [(each.get("name"), self.reader.attribute(each, "weight", 1.0)) for each in states]
        if found and (min(weight for _, weight in found) < 0 or not sum(weight for _, weight in found) > 0):
            raise ImportFailed("weights: expected numbers of which one is above 0", self.reader.file, within.sourceline)
        return found

    def seconds(self, timer) -> Callable[[], float] | None:
        """How long people are in a state, where a timer says so."""
        number, kind = self.reader.attribute, timer.get("dist", "c")
        if kind == "c":
            value = number(timer, "value")
            return lambda: value
        if kind == "u":
            least, most = number(timer, "min"), number(timer, "max")
            return lambda: self.random.uniform(least, most)
        self.scene.report.altered("transitions", f"by a timer of the distribution {kind}: people go on when they are "
                                                 "there")
        return None

    def goals_of(self, state: str, place: Point) -> list[tuple[Point, float]]:
        """Places, and for how many seconds to stand there: through the states, until one comes again or no more
        follow."""
        seen, found = set(), []
        while state in self.states and state not in seen:
            seen.add(state)
            here = found[-1][0] if found else place
            goal = self.selected(self.states[state], here)
            following = self.next.get(state)
            wait = 0.0
            if following is not None and following.seconds is not None:
                wait = self.standing(goal, following.seconds())
            if goal is None and wait > 0:
                goal = here
            if goal is not None:
                if found and goal == found[-1][0]:
                    wait += found.pop()[1]
                found.append((goal, wait))
            state = self.drawn(following)
        self.scene.report.altered("people", "who go round states in a circle: once", state in seen)
        if state and state not in self.states:
            raise ImportFailed(f"there is no state {state!r}", self.reader.file)
        self.scene.report.altered("people", "without a goal: they stay where they are", not found)
        return found or [(place, 0.0)]

    def standing(self, goal: Point | None, seconds: float) -> float:
        """A timer of people who go nowhere is how long they stand; of others, it cuts their way short."""
        self.scene.report.altered("people", "whose way a timer ends: they go on when they are there", goal is not None)
        return 0.0 if goal is not None else max(seconds, 0.0)

    def drawn(self, following: Transition | None) -> str:
        if following is None:
            return ""
        names, weights = zip(*following.targets)
        return names[0] if len(names) == 1 else self.random.choices(names, weights)[0]

    def selected(self, state, place: Point) -> Point | None:
        selector = child(state, "GoalSelector")
        kind = "identity" if selector is None else selector.get("type")
        if kind == "identity":
            return None
        if kind == "mirror":
            x, y = (-1 if selector.get(f"mirror_{axis}") == "1" else 1 for axis in "xy")
            return x * place[0], y * place[1]
        goals = self.goals.get(selector.get("goal_set") or "", {})
        if goals:
            return self.of_set(selector, kind, goals, place)
        self.scene.report.left_out(f"goals chosen by {kind}", "has no set of goals that is known")
        return None

    def of_set(self, selector, kind: str, goals: dict, place: Point) -> Point:
        if kind == "explicit":
            if selector.get("goal") not in goals:
                raise ImportFailed(f"there is no goal {selector.get('goal')!r}", self.reader.file, selector.sourceline)
            return goals[selector.get("goal")][0]()
        if kind in ("nearest", "farthest"):
            return (min if kind == "nearest" else max)((draw() for draw, _ in goals.values()),
                                                       key=lambda point: math.dist(point, place))
        if kind not in ("random", "weighted"):
            self.scene.report.altered("goals", f"chosen by {kind}: at random instead")
        weights = [weight if kind == "weighted" else 1.0 for _, weight in goals.values()]
        return self.random.choices([draw for draw, _ in goals.values()], weights)[0]()
