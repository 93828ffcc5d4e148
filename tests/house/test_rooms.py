# SPDX-License-Identifier: Apache-2.0
"""Rooms stand on floors: what includes what points down, and never round in a circle."""
import collections
import pathlib
import re
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
# From the ground up; rooms of one line know nothing of each other.
FLOORS = (("shaders",), ("base",), ("authoring",), ("sim", "recording"), ("io",), ("analysis",), ("cli", "bench"))
CODE = (".h", ".cpp", ".glsl", ".comp", ".vert", ".frag")
LONGEST_LINE = 120


def tracked(*suffixes):
    listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard"], cwd=ROOT,
                            stdout=subprocess.PIPE, text=True, check=True).stdout
    return [path for path in sorted(set(listed.splitlines())) if path.endswith(suffixes) and (ROOT / path).exists()]


def includes(path):
    return re.findall(r'^#include "([^"]+)"', (ROOT / path).read_text(), re.MULTILINE)


def floor_of(path):
    room = path.split("/")[0]
    return next((number for number, rooms in enumerate(FLOORS) if room in rooms), None)


def arrows():
    """(from, to), file by file; those of the tests, which look at everything, are left out."""
    return [(path, included) for path in tracked(*CODE) if floor_of(path) is not None for included in includes(path)]


def circle_in(graph):
    """The nodes of one circle, or None."""
    state, way = {}, []

    def visit(node):
        state[node] = "open"
        way.append(node)
        for following in sorted(graph[node]):
            if state.get(following) == "open":
                return way[way.index(following):]
            if following not in state and (found := visit(following)):
                return found
        state[node] = "done"
        way.pop()
        return None

    return next((found for node in sorted(graph) if node not in state and (found := visit(node))), None)


def graph_of(pairs):
    graph = collections.defaultdict(set)
    for one, other in pairs:
        if one != other:
            graph[one].add(other)
            graph[other] = graph[other]
    return graph


def test_a_circle_is_found():
    assert circle_in(graph_of([("a", "b"), ("b", "c"), ("c", "a"), ("d", "a")])) == ["a", "b", "c"]
    assert circle_in(graph_of([("a", "b"), ("a", "c"), ("b", "c")])) is None


def test_every_include_is_a_file_of_a_room():
    known = set(tracked(*CODE))
    assert [(path, included) for path, included in arrows() if included not in known] == []


def test_no_include_points_to_a_higher_room():
    floors = len(FLOORS)  # whatever is no room stands above all
    upwards = [(one, other) for one, other in arrows() if one.split("/")[0] != other.split("/")[0]
               and (floors if floor_of(other) is None else floor_of(other)) >= floor_of(one)]
    assert upwards == []


@pytest.mark.parametrize("depth", ["rooms", "folders", "files"])
def test_includes_go_in_no_circle(depth):
    def place(path):
        return path.split("/")[0] if depth == "rooms" else path.rpartition("/")[0] if depth == "folders" else path

    assert circle_in(graph_of((place(one), place(other)) for one, other in arrows())) is None


def test_the_simulation_knows_scenes_and_no_layouts():
    known = {"authoring/scene.h", "authoring/diagram_method.h", "authoring/scene/distance_solver.h",
             "authoring/terrain/terrain.h"}
    taken = {other for one, other in arrows() if one.startswith("sim/") and other.startswith("authoring/")}
    assert taken <= known


def test_lines_end_in_time():
    scripts = [path for path in tracked("") if path.startswith(("scripts/", ".ci/")) and not path.endswith(".txt")]
    long = [f"{path}:{number}" for path in (*tracked(*CODE, ".txt", ".cmake"), *scripts)
            for number, line in enumerate((ROOT / path).read_text().split("\n"), 1) if len(line) > LONGEST_LINE]
    assert long == []
