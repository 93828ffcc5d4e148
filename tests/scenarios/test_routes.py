# SPDX-License-Identifier: Apache-2.0
"""Routes: the shortest ways, on large sites and to many goals, and such as heed the crowd."""
import csv
import json
import subprocess
import sys
import time

import numpy
import pytest

HALL = {
    "throng": 1,
    "simulation": {"duration": 40},
    "walls": [{"points": [[0, -12], [0, -1]], "thickness": 0.2}, {"points": [[0, 1], [0, 4]], "thickness": 0.2},
              {"points": [[0, 6], [0, 12]], "thickness": 0.2}],
    "formations": [
        {"id": "walker", "type": "agents", "arrival": "leave",
         "agents": [{"position": [-10, 0], "goal": [10, 0], "speed": 1.3, "radius": 0.25}]},
        {"id": "waiting", "type": "grid", "origin": [-2.4, -0.65], "rows": 3, "columns": 9, "spacing": 0.6,
         "goal": {"offset": [0, 0]}, "people": {"radius": 0.25}},
    ],
}


@pytest.mark.parametrize("heeds, door, seed", [(True, 5.0, 1), (True, 5.0, 2), (True, 5.0, 3), (False, 0.0, 1)])
@pytest.mark.quick
def test_a_door_full_of_people_is_avoided(throng, tmp_path, heeds, door, seed):
    """Also a test of two rules that keep people going past others who stand: docs/motion.md says how it ends without
    them."""
    layout = {**HALL, "simulation": {**HALL["simulation"], "avoid_congestion": heeds, "seed": seed}}
    (tmp_path / "hall.json").write_text(json.dumps(layout))
    throng("bake", tmp_path / "hall.json", "-o", tmp_path / "bake", "-q", "--no-gltf")
    way = numpy.load(tmp_path / "bake" / "streams" / "pos.npy")[:, 0, :2]
    through = way[numpy.argmin(numpy.abs(way[:, 0]))]
    assert through[1] == pytest.approx(door, abs=1.1)


def rows(bake):
    with open(bake / "agents.csv", newline="") as file:
        return list(csv.DictReader(file))


# A process counts the memory of who forked it as its own, so this measures from a small one.
MEASURE = """
import resource, subprocess, sys
status = subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL).returncode
print(status, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024)
"""


def run_measured(*command):
    """@returns exit status, stderr, s, and the most MiB of memory that it held"""
    began = time.monotonic()
    measured = subprocess.run([sys.executable, "-S", "-c", MEASURE, *map(str, command)], capture_output=True, text=True)
    status, megabytes = measured.stdout.split()
    return int(status), measured.stderr, time.monotonic() - began, float(megabytes)


def blocks():
    """Four blocks of 4 m with alleys between, and somebody who walks from corner to corner."""
    square = lambda x, y: {"closed": True, "points": [[x, y], [x + 4, y], [x + 4, y + 4], [x, y + 4]]}
    return {"throng": 1, "simulation": {"duration": 30},
            "walls": [square(x, y) for x in (-5.333, 1.333) for y in (-5.333, 1.333)],
            "formations": [{"id": "one", "type": "agents", "arrival": "stay", "goal_tolerance": 0.05,
                            "people": {"speed": 1.34, "radius": 0.2},
                            "agents": [{"position": [-7.2807, -7.32749], "goal": [7.2807, 7.32749]}]}]}


def shortest_between_blocks():
    """Along tangents to the circles that the body's middle walks on round three corners: leaving the first on the left,
    the second on the right, and the third on the left again."""
    radius = 0.2
    stops = numpy.array([[-7.2807, -7.32749], [-1.333, -5.333], [1.333, -1.333], [5.333, 1.333], [7.2807, 7.32749]])
    legs = numpy.diff(stops, axis=0)
    apart = numpy.hypot(*legs.T)
    # A tangent from a point leaves the circle's middle by a radius, one between two circles on either side by two.
    aside = radius * numpy.array([1, 2, 2, 1])
    heading = numpy.arctan2(legs[:, 1], legs[:, 0]) + numpy.array([-1, 1, -1, 1]) * numpy.arcsin(aside / apart)
    return numpy.sqrt(apart ** 2 - aside ** 2).sum() + radius * numpy.abs(numpy.diff(heading)).sum()


@pytest.mark.quick
def test_somebody_alone_walks_the_shortest_way_and_is_told_its_length(throng, tmp_path):
    (tmp_path / "blocks.json").write_text(json.dumps(blocks()))
    throng("bake", tmp_path / "blocks.json", "-o", tmp_path / "bake", "-q", "--no-gltf")
    row = rows(tmp_path / "bake")[0]
    assert row["outcome"] == "arrived"
    assert shortest_between_blocks() == pytest.approx(22.58, abs=0.05)
    assert float(row["shortest_way"]) == pytest.approx(shortest_between_blocks(), rel=0.02)
    # What was walked until the end: past a goal that is only 5 cm wide, and back, would count, too.
    assert float(row["distance_walked"]) == pytest.approx(shortest_between_blocks(), rel=0.02)


def test_without_foresight_corners_and_goals_are_overshot(throng, tmp_path):
    (tmp_path / "blocks.json").write_text(json.dumps(blocks()))
    throng("bake", tmp_path / "blocks.json", "-o", tmp_path / "bake", "-q", "--no-gltf", "--set",
           "motion.foresight.enabled=false")
    walked = float(rows(tmp_path / "bake")[0]["distance_walked"])
    assert 1.03 * shortest_between_blocks() < walked < 1.08 * shortest_between_blocks()


def test_nobody_walks_round_and_round_a_place_that_is_full(throng, tmp_path):
    """Forty people who are to stay on four square metres."""
    layout = {"throng": 1, "simulation": {"duration": 60},
              "areas": [{"id": "from", "polygon": [[-20, -4], [-10, -4], [-10, 4], [-20, 4]]},
                        {"id": "small", "polygon": [[10, 0], [12, 0], [12, 2], [10, 2]]}],
              "flows": [{"id": "f", "from": "from", "to": "small", "count": 40, "end": 20, "arrival": "stay"}]}
    (tmp_path / "full.json").write_text(json.dumps(layout))
    throng("bake", tmp_path / "full.json", "-o", tmp_path / "bake", "-q", "--no-gltf")
    people = rows(tmp_path / "bake")
    assert [row["outcome"] for row in people] == ["arrived"] * 40
    assert max(float(row["distance_walked"]) / float(row["shortest_way"]) for row in people) < 2.5


def house(x, y, side, door):
    """Four walls with a door in the middle of the southern one; walls of 0.2 m have round ends."""
    left, right = x + (side - door) / 2 - 0.1, x + (side + door) / 2 + 0.1
    return [{"points": [[left, y], [x, y], [x, y + side], [x + side, y + side], [x + side, y], [right, y]],
             "thickness": 0.2}]


def large_site(houses, extent=1000.0, side=12.0, door=0.8):
    """Houses over a square site; from outside one person walks into each."""
    step = (extent - side) / (houses - 1)
    corners = [(i * step, j * step) for i in range(houses) for j in range(houses)]
    agents = [{"position": [extent / 2 - 40 + 1.5 * (n % 50), -10 - 1.5 * (n // 50)],
               "goal": [x + side / 2, y + side / 2], "radius": 0.15, "speed": 1.4} for n, (x, y) in enumerate(corners)]
    return {"throng": 1, "simulation": {"duration": 1}, "formations": [{"id": "all", "type": "agents", "agents": agents}],
            "walls": [wall for x, y in corners for wall in house(x, y, side, door)]}


def test_doors_on_a_site_of_one_kilometre_are_open_and_soon_known(throng, tmp_path):
    (tmp_path / "site.json").write_text(json.dumps(large_site(4)))
    status, errors, seconds, megabytes = run_measured(throng.binary, "check", tmp_path / "site.json")
    assert status == 0 and errors == ""
    assert megabytes < 512
    assert seconds < 20  # 2 s where nothing else runs


def test_196_goals_in_rooms_of_their_own_fit_in_half_a_gigabyte(throng, tmp_path):
    (tmp_path / "rooms.json").write_text(json.dumps(large_site(14, extent=84.0, side=4.5)))
    status, errors, _, megabytes = run_measured(throng.binary, "check", tmp_path / "rooms.json")
    assert status == 0 and errors == ""
    assert megabytes < 512
