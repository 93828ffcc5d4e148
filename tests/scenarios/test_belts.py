# SPDX-License-Identifier: Apache-2.0
"""Escalators and travelators: ground that moves, people who stand and walk on it."""
import json

import numpy
import pytest


def box(x0, y0, x1, y1):
    return [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]


IN_PLAN = 0.5 * 7 / numpy.hypot(7, 4)  # m/s: of 0.5 m/s along the slope
BEGIN, END = -9, -2


def hall(links, flows, duration=60, **more):
    return {
        "throng": 1, "simulation": {"duration": duration},
        "levels": [{"id": "ground", "floor": box(-16, -5, 14, 5)},
                   {"id": "upper", "height": 4, "floor": box(-2, -5, 14, 5)}],
        "links": links, "flows": flows,
        "areas": [{"id": "door", "polygon": box(-15, -4, -14, 4)},
                  {"id": "above", "level": "upper", "polygon": box(12, -4, 13, 4)}], **more}


def escalator(**more):
    return {"id": "escalator", "type": "escalator", "from": "ground", "to": "upper", "path": [[BEGIN, 0], [END, 0]],
            **more}


def up(count, end=1, **people):
    return [{"id": "up", "from": "door", "to": "above", "count": count, "end": end,
             "people": {"speed": 1.34, "radius": 0.25, **people}}]


def bake(throng, folder, layout, *options):
    (folder / "layout.json").write_text(json.dumps(layout))
    throng("bake", folder / "layout.json", "-o", folder / "bake", "-q", "--no-gltf", *options)
    return folder / "bake"


def stream(folder, name):
    return numpy.load(folder / "streams" / f"{name}.npy")


def measured(throng, folder):
    return json.loads(throng("measure", folder, "--json").stdout)


def on_belt(folder, margin=1.0):
    """Frames by people: who is on the escalator's middle part."""
    x, height = stream(folder, "pos")[..., 0], stream(folder, "pos")[..., 2]
    is_there = (stream(folder, "state")[..., 0] > 0) & (height > 0.2)  # not beside it, below
    return is_there & (x > BEGIN + margin) & (x < END - margin)


def test_who_stands_is_carried_and_keeps_its_feet(throng, tmp_path):
    folder = bake(throng, tmp_path, hall([escalator(walking=0)], up(1)), "--feet")
    rides = on_belt(folder, 1.5)[:, 0]
    places, speeds = stream(folder, "pos")[:, 0], stream(folder, "dir")[:, 0, 2]
    steps = numpy.diff(places, axis=0)[rides[1:] & rides[:-1]]
    assert rides.sum() > 24 * 5
    assert steps[:, 0] * 24 == pytest.approx(IN_PLAN, abs=0.005)
    assert steps[:, 2] * 24 == pytest.approx(IN_PLAN * 4 / 7, abs=0.005)
    assert speeds[rides].max() < 0.02  # relative to the ground
    assert numpy.ptp(stream(folder, "state")[:, 0, 2][rides]) < 0.02  # cycles: no stride
    assert abs(stream(folder, "ground")[:, 0, :2][rides]).max() < 0.02  # feet are level
    # Planted feet are carried along: what is between them and the clip's does not change.
    late = on_belt(folder, 2.5)[:, 0]
    for foot in ("left_foot", "right_foot"):
        assert numpy.ptp(stream(folder, foot)[:, 0, :2][late], axis=0).max() < 0.02
    figures = measured(throng, folder)
    assert (figures["arrived"], figures["stuck"], figures["wall_crossings"]) == (1, 0, 0)
    assert figures["backward_percent"] == 0
    assert figures["links"][0]["forward"] == 1


def test_who_walks_is_as_much_faster_as_the_ground(throng, tmp_path):
    folder = bake(throng, tmp_path, hall([escalator(walking=1)], up(1)))
    rides = on_belt(folder)[:, 0]
    x = stream(folder, "pos")[:, 0, 0]
    assert numpy.diff(x)[rides[1:] & rides[:-1]].mean() * 24 == pytest.approx(IN_PLAN + 0.61, rel=0.05)
    assert stream(folder, "dir")[:, 0, 2][rides].mean() == pytest.approx(0.61, rel=0.05)


@pytest.mark.parametrize("side", ["right", "left"])
def test_people_stand_on_one_side_a_step_apart_and_walk_on_the_other(throng, tmp_path, side):
    """Those who stand beside others, whom a crowd pushed on, hold up those who would walk there: not many do."""
    found = [ridden(throng, tmp_path / str(seed), side, seed) for seed in (1, 2, 3)]
    on_side = numpy.concatenate([sides for sides, _ in found])
    gaps = numpy.concatenate([gaps for _, gaps in found])  # m
    assert (on_side > 0.1).mean() > 0.95
    assert len(gaps) > 300 and numpy.median(gaps) > 0.7 and (gaps > 0.55).mean() > 0.75 and (gaps > 0.4).mean() > 0.95


def ridden(throng, folder, side, seed):
    """@returns how far to their side those stand who do (m), and their distances along the escalator"""
    folder.mkdir()
    given = hall([escalator(stand=side, walking=0.4)], up(40, 40), duration=100)
    given["simulation"]["seed"] = seed
    folder = bake(throng, folder, given)
    figures = measured(throng, folder)
    assert (figures["arrived"], figures["stuck"], figures["wall_crossings"]) == (40, 0, 0)
    assert figures["deepest_overlap_percent"] < 2
    places, speeds, rides = stream(folder, "pos"), stream(folder, "dir")[..., 2], on_belt(folder, 1.5)
    walks = numpy.array([speeds[rides[:, row], row].mean() > 0.2 for row in range(40)])
    assert 6 <= walks.sum() <= 26  # 16 of 40, give or take three standard deviations
    sign = -1 if side == "right" else 1  # y: to the left of who goes up
    sides = numpy.array([places[rides[:, row], row, 1].mean() * sign for row in range(40)])
    assert (sides[~walks] > 0.1).mean() > 0.85
    assert (sides[walks] < -0.05).mean() > 0.9
    gaps = []
    for frame in range(0, len(places), 12):
        x = numpy.sort(places[frame, rides[frame] & ~walks, 0])
        gaps += list(numpy.diff(x))
    return sides[~walks], gaps


def test_nobody_goes_against_an_escalator(throng, tmp_path):
    """The way up is the stairs, far off to the side, though the way down is shorter."""
    down = {**escalator(), "from": "upper", "to": "ground", "path": [[END, 0], [BEGIN, 0]]}
    stairs = {"id": "stairs", "from": "ground", "to": "upper", "path": [[-8, 4], [-2, 4]], "width": 1.6}
    both = up(20, 10) + [{"id": "down", "from": "above", "to": "door", "count": 20, "end": 10}]
    figures = measured(throng, bake(throng, tmp_path, hall([down, stairs], both, duration=90)))
    flows = {link["id"]: link for link in figures["links"]}
    assert figures["arrived"] == 40
    assert flows["escalator"]["back"] == 0 and flows["stairs"]["forward"] == 20
    assert flows["escalator"]["forward"] > 15


def test_there_is_no_way_up_a_downward_escalator(throng, tmp_path):
    down = {**escalator(), "from": "upper", "to": "ground", "path": [[END, 0], [BEGIN, 0]]}
    (tmp_path / "layout.json").write_text(json.dumps(hall([down], up(2))))
    found = throng("check", tmp_path / "layout.json", expect=None)
    assert "up" in found.stdout + found.stderr and found.returncode != 0
    (tmp_path / "layout.json").write_text(json.dumps(hall([escalator()], up(2))))
    throng("check", tmp_path / "layout.json")


def test_a_travelator_carries_people_on_one_level(throng, tmp_path):
    belt = {"id": "travelator", "type": "travelator", "from": "ground", "to": "ground", "path": [[-10, 0], [8, 0]],
            "width": 1.2, "speed": 0.75, "walking": 1}
    layout = hall([belt], [{"id": "along", "from": "door", "to": "east", "count": 10, "end": 10,
                            "people": {"speed": 1.34, "radius": 0.25}}])
    layout["levels"] = layout["levels"][:1]
    layout["areas"] = [layout["areas"][0], {"id": "east", "polygon": box(12, -4, 13, 4)}]
    folder = bake(throng, tmp_path, layout)
    figures = measured(throng, folder)
    assert (figures["arrived"], figures["stuck"], figures["links"][0]["forward"]) == (10, 0, 10)
    x = stream(folder, "pos")[:, 0, 0]
    rides = (x > -8) & (x < 6)
    assert numpy.diff(x)[rides[1:] & rides[:-1]].mean() * 24 == pytest.approx(0.75 + 1.34, rel=0.06)


def test_nobody_is_faster_in_a_crowd_than_alone(throng, tmp_path):
    """A crowd before an escalator: what it takes is at most one person a step in each lane."""
    folder = bake(throng, tmp_path, hall([escalator(walking=0)], up(70, 15), duration=115))
    figures = measured(throng, folder)
    assert figures["arrived"] == 70 and figures["stuck"] == 0
    assert figures["deepest_overlap_percent"] < 5
    per_lane = IN_PLAN / 0.8
    assert 1.4 * per_lane < figures["links"][0]["flow"] < 2.1 * per_lane
    # The first come as fast as they walk, and need a second to stand.
    rides = on_belt(folder, 1.5)
    rides[24:] &= rides[:-24]
    rides[:24] = False
    x = stream(folder, "pos")[..., 0]
    steps = numpy.diff(x, axis=0)[rides[1:] & rides[:-1]] * 24
    assert steps.max() < IN_PLAN + 0.3 and numpy.median(steps) == pytest.approx(IN_PLAN, abs=0.01)
