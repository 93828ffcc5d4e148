# SPDX-License-Identifier: Apache-2.0
"""UMANS: a simulation's XML, with its agents and obstacles in it or in files that it names."""
from __future__ import annotations

import collections
import pathlib

from ..base.errors import ImportFailed
from .files import Reader, child, children, read_xml, tag
from .scene import Scene

ROOT = "Simulation"
RADIUS, SPEED = 0.24, 1.3  # UMANS's own defaults
MOST_FILES = 64


def read(path: pathlib.Path, scene: Scene) -> None:
    reader, root = Reader(path), read_xml(path, ROOT)
    if root.get("end_time"):
        scene.duration = reader.attribute(root, "end_time")
    world = child(root, "World")
    if world is not None and (world.get("type") or "Infinite") != "Infinite":
        scene.report.left_out(f"world of type {world.get('type')}", "edges do not lead to the other side")
    elements = list(root) + (list(world) if world is not None else [])
    for element in elements:
        kind = tag(element)
        if kind == "Agents":
            _agents(*_followed(reader, element, kind), scene)
        elif kind == "Obstacles":
            _obstacles(*_followed(reader, element, kind), scene)
        elif kind == "Policies":
            scene.report.left_out("policies", "people move by Throng's own rules")
        elif kind != "World":
            scene.report.left_out(f"<{kind}>", "has no counterpart")


def _followed(reader: Reader, element, kind: str):
    """What an element holds, or the file that it names, or the file that that one names ..."""
    for _ in range(MOST_FILES):
        if not element.get("file"):
            return reader, element
        path = reader.beside(element.get("file"), element)
        reader, element = Reader(path), read_xml(path, kind)
    raise ImportFailed("files that name each other without an end", reader.file)


def _agents(reader: Reader, element, scene: Scene) -> None:
    groups = collections.defaultdict(list)
    for agent in children(element, "Agent"):
        position, goals = child(agent, "pos"), children(agent, "goal")
        if position is None:
            raise ImportFailed("an agent without <pos>", reader.file, agent.sourceline)
        scene.report.altered("people", "without a goal: they stay where they are", not goals)
        begin, *via, end = [(reader.attribute(each, "x"), reader.attribute(each, "y"))
                            for each in (position, *(goals or [position]))]
        arrival = "leave" if (agent.get("remove_at_goal") or "").lower() in ("true", "1") else "stay"
        groups[arrival].append(scene.person(
            begin, end, reader.attribute(agent, "pref_speed", SPEED), reader.attribute(agent, "rad", RADIUS),
            via=[(point, 0.0) for point in via], start=reader.attribute(agent, "start_time", 0.0)))
    for arrival, people in sorted(groups.items()):
        scene.agents("agents", people, arrival)


def _obstacles(reader: Reader, element, scene: Scene) -> None:
    for obstacle in children(element, "Obstacle"):
        ring = [(reader.attribute(point, "x"), reader.attribute(point, "y")) for point in children(obstacle, "Point")]
        if len({*ring}) == 2:
            scene.line(ring[:2], what="obstacles")
        else:
            scene.solid(scene.polygon(ring, "obstacles"), what="obstacles")
