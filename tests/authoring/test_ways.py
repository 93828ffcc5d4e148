# SPDX-License-Identifier: Apache-2.0
"""`throng check` tells of ways that those who walk them cannot walk, and of no others."""
import json

import pytest

from conftest import ROOT

ALL = sorted([*(ROOT / "examples").glob("*.json"), *(ROOT / "scenarios").rglob("*.json")])


def layout(door, radius=0.3, gate=None, at=None, groups=1):
    """A room cut in two by a wall with a door, and people who go through it."""
    walls = [{"id": "north", "points": [[10, 5 + door / 2 + 0.1], [10, 11]]},
             {"id": "south", "points": [[10, -1], [10, 5 - door / 2 - 0.1]]},
             {"id": "round", "points": [[-1, -1], [21, -1], [21, 11], [-1, 11], [-1, -1]]}]
    made = {"throng": 1, "simulation": {"duration": 20},
            "areas": [{"id": "a", "polygon": [[0, 0], [8, 0], [8, 10], [0, 10]]},
                      {"id": "b", "polygon": [[12, 0], [20, 0], [20, 10], [12, 10]]}],
            "walls": walls, "events": [],
            "flows": [{"id": f"f{i}", "from": "a", "to": "b", "count": 5, "people": {"radius": radius}}
                      for i in range(groups)]}
    if gate:
        walls.append({"id": "gate", "points": [[10, 5 - door / 2], [10, 5 + door / 2]]})
        made["events"] = [{"at": at, gate: "gate"}]
    return made


@pytest.fixture
def warnings(throng, tmp_path):
    def told(made, expect=0):
        path = tmp_path / "layout.json"
        path.write_text(json.dumps(made, indent=1))
        [found] = json.loads(throng("check", path, "--json", expect=expect).stdout)
        return found["diagnostics"]

    return told


def test_a_door_narrower_than_the_widest_body_is_told_once_with_its_place(warnings):
    made = layout(door=0.45, groups=3)
    made["flows"].append({**made["flows"][0], "id": "small", "people": {"radius": 0.15}})  # a way, for these
    [told] = warnings(made)
    assert told["severity"] == "warning" and told["hint"] and told["line"] > 0
    assert told["pointer"] in ("/walls/0", "/walls/1") and "`f0` and of 2 more groups" in told["message"]
    x, y = map(float, told["message"].split("[")[1].split("]")[0].split(", "))
    assert abs(x - 10) < 1.0 and abs(y - 5) < 1.0


@pytest.mark.parametrize("door", [0.65, 0.8, 1.2])
def test_doors_that_bodies_fit_through_are_not(warnings, door):
    assert warnings(layout(door=door)) == []


def test_a_gate_that_opens_after_the_shot_is_told(warnings):
    [told] = warnings(layout(door=1.2, gate="open", at=30))
    assert "gate `gate`" in told["message"] and told["pointer"] == "/walls/3"


def test_a_gate_that_opens_in_time_or_closes_later_is_not(warnings):
    assert warnings(layout(door=1.2, gate="open", at=10)) == []
    assert warnings(layout(door=1.2, gate="close", at=10)) == []


def test_walls_all_round_are_an_error_and_no_warning_beside_it(warnings):
    shut = layout(door=1.2)
    shut["walls"] += [{"id": "across", "points": [[10, 3], [10, 7]]}]
    assert {told["severity"] for told in warnings(shut, expect=3)} == {"error"}


def to_the_nearest(fence, kind="flow", people=1):
    """A fenced place and an open one, and people who go to the nearest."""
    fences = [[[14, 4.4], [14, 1], [18, 1], [18, 9], [14, 9], [14, 5.6]]]
    if fence == "shut":
        fences.append([[14, 4.4], [14, 5.6]])
    made = {"throng": 1, "simulation": {"duration": 20},
            "areas": [{"id": "a", "polygon": [[0, 0], [8, 0], [8, 10], [0, 10]]},
                      {"id": "fenced", "polygon": [[15, 3], [17, 3], [17, 7], [15, 7]]},
                      {"id": "open", "polygon": [[22, 0], [26, 0], [26, 10], [22, 10]]}],
            "walls": [{"id": f"fence{i}", "points": points} for i, points in enumerate(fences)]}
    goal = {"nearest": ["open", "fenced"]}
    if kind == "flow":
        made["flows"] = [{"id": f"f{i}", "from": "a", "to": goal, "count": 5} for i in range(people)]
    else:
        made["formations"] = [{"id": "f0", "type": "grid", "origin": [2, 2], "rows": 3, "columns": 3, "goal": goal}]
    return made


@pytest.mark.parametrize("kind", ["flow", "formation"])
def test_one_of_the_nearest_places_behind_walls_is_told(warnings, kind):
    [told] = warnings(to_the_nearest("shut", kind))
    assert told["severity"] == "warning" and told["hint"] and told["line"] > 0
    assert told["pointer"].endswith("/nearest/1") and "`f0`" in told["message"] and "`fenced`" in told["message"]
    assert warnings(to_the_nearest("gap", kind)) == []


def test_a_place_that_several_groups_cannot_reach_is_told_once(warnings):
    [told] = warnings(to_the_nearest("shut", people=3))
    assert "`f0` and of 2 more groups" in told["message"]


def test_what_the_repository_has_gets_no_false_warning(throng):
    for found in json.loads(throng("check", *ALL, "--json").stdout):
        assert not [told for told in found["diagnostics"] if "the way of" in told["message"] or
                    "can walk to" in told["message"]], found["file"]
