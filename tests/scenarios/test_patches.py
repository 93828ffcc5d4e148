# SPDX-License-Identifier: Apache-2.0
"""Patches: people walk round ground where that is worth it, and at another pace on it; some of it for a time."""
import json

import numpy
import pytest

FAR_WALL = {"points": [[-14, -16], [14, -16]]}


def lawn(half, **told):
    """6 m across, from -half to half."""
    return {"id": "lawn", "polygon": [[-3, -half], [3, -half], [3, half], [-3, half]], **told}


def walker(position=(-3.5, 0), goal=(3.5, 0), **told):
    return {"position": list(position), "goal": list(goal), "speed": 1.3, "radius": 0.25, **told}


def layout(patches, agents=(), duration=20, **others):
    formations = [{"id": "people", "type": "agents", "arrival": "leave", "agents": list(agents)}] if agents else []
    return {"throng": 1, "simulation": {"duration": duration}, "patches": patches, "formations": formations, **others}


def ways(throng, folder, told):
    """Places by frame and row, and whether somebody is there."""
    (folder / "layout.json").write_text(json.dumps(told))
    throng("bake", folder / "layout.json", "-o", folder / "bake", "-q", "--no-gltf")
    streams = folder / "bake" / "streams"
    return numpy.load(streams / "pos.npy")[:, :, :2], numpy.load(streams / "state.npy")[:, :, 0] > 0.5


def passed_at(way):
    """How far beside the middle somebody was on its way past it."""
    return abs(way[numpy.argmin(numpy.abs(way[:, 0])), 1])


# Across 1 m and three times 6 m, round twice `half` and 6 m.
@pytest.mark.parametrize("walls", [[], [FAR_WALL]])
@pytest.mark.parametrize("half, beside", [(5, 5.0), (8, 0.0)])
@pytest.mark.quick
def test_people_walk_round_a_lawn_where_that_is_worth_it(throng, tmp_path, half, beside, walls):
    places, there = ways(throng, tmp_path, layout([lawn(half, cost=3)], [walker()], walls=walls))
    assert passed_at(places[:, 0]) == pytest.approx(beside, abs=0.6)
    assert not there[-1].any()  # and arrive


@pytest.mark.parametrize("half, beside", [(5, 5.0), (8, 0.0)])
def test_flows_walk_round_a_lawn_too(throng, tmp_path, half, beside):
    square = lambda name, x: {"id": name, "polygon": [[x - 0.5, -0.5], [x + 0.5, -0.5], [x + 0.5, 0.5], [x - 0.5, 0.5]]}
    told = layout([lawn(half, cost=3)], areas=[square("from", -3.6), square("to", 3.6)],
                  flows=[{"id": "flow", "from": "from", "to": "to", "count": 3, "end": 8}])
    places, _ = ways(throng, tmp_path, told)
    for row in range(3):
        assert passed_at(places[:, row]) == pytest.approx(beside, abs=1.2)


@pytest.mark.parametrize("half, beside", [(15, 15.0), (24, 0.0)])
def test_on_large_sites_too(throng, tmp_path, half, beside):
    """Three times as large, on fields in blocks: a wall makes these."""
    patch = {"polygon": [[-9, -half], [9, -half], [9, half], [-9, half]], "cost": 3}
    far = {"points": [[-180, -180], [180, -180]]}
    told = layout([patch], [walker((-10.5, 0), (10.5, 0), speed=2)], 40, walls=[far])
    places, _ = ways(throng, tmp_path, told)
    assert passed_at(places[:, 0]) == pytest.approx(beside, abs=1)


@pytest.mark.parametrize("pace", [0.5, 1.25])
@pytest.mark.quick
def test_people_are_as_fast_as_the_ground_lets_them(throng, tmp_path, pace):
    patch = {"polygon": [[0, -9], [10, -9], [10, 9], [0, 9]], "pace": pace, "cost": 1}
    places, _ = ways(throng, tmp_path, layout([patch], [walker((-10, 0), (20, 0))], 30))
    x = places[:, 0, 0]
    speed = lambda least, most: numpy.diff(x)[(x[:-1] > least) & (x[:-1] < most)].mean() * 24
    assert speed(-6, -2) == pytest.approx(1.3, rel=0.03)
    assert speed(2.5, 9) == pytest.approx(1.3 * pace, rel=0.05)
    assert speed(13, 18) == pytest.approx(1.3, rel=0.03)


@pytest.mark.quick
def test_a_pace_begins_and_ends(throng, tmp_path):
    patch = {"polygon": [[-90, -9], [90, -9], [90, 9], [-90, 9]], "pace": 0.5, "cost": 1, "from": 5, "until": 10}
    places, _ = ways(throng, tmp_path, layout([patch], [walker((-20, 0), (20, 0))], 16))
    speed = numpy.diff(places[:, 0, 0]) * 24
    mean = lambda first, last: speed[int(24 * first):int(24 * last)].mean()
    assert mean(2, 4.5) == pytest.approx(1.3, rel=0.03)
    assert mean(6.5, 9.5) == pytest.approx(0.65, rel=0.05)
    assert mean(11.5, 15) == pytest.approx(1.3, rel=0.03)


@pytest.mark.quick
def test_what_is_avoided_for_a_time_is_so_then_only(throng, tmp_path):
    agents = [walker(start=start) for start in (0, 14, 40)]
    patch = lawn(3, cost=10, **{"from": 10, "until": 34})
    places, there = ways(throng, tmp_path, layout([patch], agents, 52))
    beside = [passed_at(numpy.where(there[:, row, None], places[:, row], 99)) for row in range(3)]
    assert beside[0] < 0.3 and beside[2] < 0.3
    assert 2.5 < beside[1] < 5


@pytest.mark.quick
def test_patches_of_a_level_are_on_it_alone(throng, tmp_path):
    floor = [[-12, -12], [12, -12], [12, 12], [-12, 12]]
    people = lambda name: {"id": name, "type": "agents", "arrival": "leave", "level": name,
                           "agents": [walker((-8, 0), (8, 0))]}
    told = {"throng": 1, "simulation": {"duration": 24},
            "levels": [{"id": "low", "height": 0, "floor": floor}, {"id": "high", "height": 4, "floor": floor}],
            "patches": [{**lawn(4, cost=6), "level": "high"}], "formations": [people("low"), people("high")]}
    places, _ = ways(throng, tmp_path, told)
    assert passed_at(places[:, 0]) < 0.5
    assert passed_at(places[:, 1]) == pytest.approx(4, abs=0.7)


SQUARE = [[0, 0], [2, 0], [2, 2], [0, 2]]


def test_many_over_each_other_are_no_more_than_so_costly(throng, tmp_path):
    wide = {"polygon": [[-3, -20], [3, -20], [3, 20], [-3, 20]], "cost": 20}
    told = layout(8 * [wide], [walker()], walls=[FAR_WALL, {"points": [[-14, 16], [14, 16]]}])
    (tmp_path / "layout.json").write_text(json.dumps(told))
    throng("check", tmp_path / "layout.json", timeout=20)


@pytest.mark.parametrize("patch, others, words", [
    ({"polygon": SQUARE}, {}, "neither `cost` nor `pace`"),
    ({"polygon": SQUARE, "cost": 0.5}, {}, "expected at least 1 and at most 20"),
    ({"polygon": SQUARE, "pace": 0.1}, {}, "expected at least 0.2 and at most 1.5"),
    ({"polygon": SQUARE, "cost": 2, "from": 5, "until": 5}, {}, "ends before it begins"),
    ({"polygon": [[0, 0], [2, 2], [2, 0], [0, 2]], "cost": 2}, {}, "cross"),
    ({"polygon": SQUARE, "cost": 2, "until": 5}, {"simulation": {"avoid_congestion": False}}, "avoid_congestion"),
    ({"polygon": SQUARE, "cost": 2}, {"levels": [{"id": "a", "height": 0, "floor": [[-1, -1], [1, -1], [1, 1]]}]},
     "beyond the floor"),
])
@pytest.mark.quick
def test_mistakes_are_told(throng, tmp_path, patch, others, words):
    (tmp_path / "layout.json").write_text(json.dumps({**layout([patch], [walker((0, 0), (0, 0.5))]), **others}))
    told = throng("check", tmp_path / "layout.json", expect=3).stderr
    assert words in told and "layout.json:1:" in told
