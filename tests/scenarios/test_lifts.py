# SPDX-License-Identifier: Apache-2.0
"""Lifts: people wait before them, let others off, ride and get off; cabins take no more than they hold."""
import json
import math
import signal
import subprocess
import time

import numpy
import pytest

AT, SIZE, STOREY = (0.0, 4.5), (2.0, 2.0), 4.0  # m
CAPACITY = 8


def box(x0, y0, x1, y1):
    return [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]


def lift(levels, **more):
    return {"id": "lift", "type": "lift", "levels": levels, "at": list(AT), "size": list(SIZE), "doors": -90,
            "door_width": 1.2, "capacity": CAPACITY, **more}


def house(storeys, flows, duration, links=None, **more):
    """Floors above each other with a lift at the north side, and a place in the west and in the east of each."""
    names = ["ground", "upper", "top"][:storeys]
    areas = [{"id": f"{name}-{side}", "level": name, "polygon": box(x, -4, x + 2, 2)}
             for name in names for side, x in (("west", -7.5), ("east", 5.5))]
    return {"throng": 1, "simulation": {"duration": duration},
            "levels": [{"id": name, "height": STOREY * i, "floor": box(-8, -6, 8, 6)} for i, name in enumerate(names)],
            "links": [lift(names)] if links is None else links, "areas": areas, "flows": flows, **more}


def flow(start, end, count, until=10, **more):
    return {"id": f"{start}-{end}", "from": f"{start}-west", "to": f"{end}-east", "count": count, "end": until,
            "people": {"radius": 0.24}, **more}


def bake(throng, folder, layout, *options):
    (folder / "layout.json").write_text(json.dumps(layout))
    throng("bake", folder / "layout.json", "-o", folder / "bake", "-q", "--no-gltf", *options)
    return folder / "bake"


class Ridden:
    """A bake with one lift: frames by people."""

    def __init__(self, folder):
        self.places = numpy.load(folder / "streams" / "pos.npy")
        self.there = numpy.load(folder / "streams" / "state.npy")[..., 0] > 0
        track = numpy.load(folder / "lifts.npy")[:, 0]
        self.height, self.open, self.aboard, self.stop = track.T
        columns = json.loads((folder / "bake.json").read_text())["lifts"]["columns"]
        assert columns == ["height", "open", "aboard", "stop"]
        away = numpy.abs(self.places[..., :2] - AT)
        self.inside = self.there & (away[..., 0] < SIZE[0] / 2) & (away[..., 1] < SIZE[1] / 2)

    def passages(self, goes_in):
        """(frame, person) of everybody who goes through the doors."""
        before, after = self.inside[:-1], self.inside[1:]
        passes = (~before & after) if goes_in else (before & ~after)
        return [(int(frame) + 1, int(person)) for frame, person in zip(*numpy.nonzero(passes & self.there[1:]))]

    def visits(self):
        """Frames in which the doors are open without a break: (first, last)."""
        is_open = numpy.concatenate([[False], self.open > 0.99, [False]])
        edges = numpy.flatnonzero(numpy.diff(is_open.astype(int)))
        return list(zip(edges[::2], edges[1::2]))


@pytest.fixture(scope="module")
def up(throng, once):
    """Thirty people and one cabin for eight of them."""
    layout = house(2, [flow("ground", "upper", 30)], 200)
    return once("lift up", lambda folder: bake(throng, folder, layout)) / "bake"


@pytest.fixture(scope="module")
def three(throng, once):
    """Three storeys, from each of which people go to both of the others."""
    names = ["ground", "upper", "top"]
    flows = [flow(a, b, 6, 20) for a in names for b in names if a != b]
    return once("lift three", lambda folder: bake(throng, folder, house(3, flows, 300))) / "bake"


@pytest.mark.parametrize("case, count", [("up", 30), ("three", 36)])
def test_all_arrive_and_nobody_is_in_anybody(throng, request, case, count):
    figures = json.loads(throng("measure", request.getfixturevalue(case), "--json").stdout)
    assert (figures["arrived"], figures["stuck"], figures["wall_crossings"]) == (count, 0, 0)
    assert figures["deepest_overlap_percent"] < 2


def test_the_cabin_goes_as_often_as_it_has_to(up):
    ridden = Ridden(up)
    rides = [ridden.aboard[first - 1] for first in range(1, len(ridden.height))
             if ridden.height[first] > 0.01 >= ridden.height[first - 1] and ridden.aboard[first - 1] > 0]
    assert len(rides) == math.ceil(30 / CAPACITY)
    assert max(rides) == CAPACITY


@pytest.mark.parametrize("case", ["up", "three"])
def test_nobody_is_above_capacity_or_in_the_shaft(request, case):
    ridden = Ridden(request.getfixturevalue(case))
    assert ridden.inside.sum(axis=1).max() == ridden.aboard.max() == CAPACITY
    apart = numpy.abs(ridden.places[..., 2] - ridden.height[:, None])[ridden.inside]
    assert apart.max() < 0.02 and ridden.inside.sum() > 1000  # m: in the shaft means on the cabin's floor
    on_a_floor = numpy.abs(ridden.places[..., 2] / STOREY - numpy.round(ridden.places[..., 2] / STOREY)) < 0.01
    assert (on_a_floor | ridden.inside)[ridden.there].all()


@pytest.mark.parametrize("case", ["up", "three"])
def test_people_get_off_before_others_come_in_and_only_through_open_doors(request, case):
    ridden = Ridden(request.getfixturevalue(case))
    passages = ridden.passages(False) + ridden.passages(True)
    assert all(ridden.open[max(frame - 8, 0):frame + 9].max() > 0.99 for frame, _ in passages)  # averaged over 0.25 s
    both = 0
    for first, last in ridden.visits():
        leaves = [frame for frame, _ in ridden.passages(False) if first <= frame <= last]
        enters = [frame for frame, _ in ridden.passages(True) if first <= frame <= last]
        both += bool(leaves and enters)
        assert not leaves or not enters or max(leaves) < min(enters)
    assert case == "up" or both >= 4


def test_a_cabin_without_people_stays_where_it_is(throng, tmp_path):
    ridden = Ridden(bake(throng, tmp_path, house(2, [flow("ground", "upper", 1, 1)], 60)))
    assert ridden.height[-1] == pytest.approx(STOREY)
    assert ridden.open[-1] == 0 and ridden.stop[-1] == 1
    moving = numpy.flatnonzero(numpy.abs(numpy.diff(ridden.height)) > 1e-4)
    steps = numpy.diff(ridden.height)[moving[0]:moving[-1] + 1]
    assert abs(numpy.diff(steps)).max() < 0.005, "it moves evenly: in every frame"  # m, each: 0.8 m/s^2 make 0.0014
    seconds = (moving[-1] - moving[0] + 2) / 24
    assert seconds == pytest.approx(STOREY / 1.0 + 1.0 / 0.8, abs=0.2)  # at 1 m/s, set out and stopped at 0.8 m/s^2


def test_who_rides_stands_and_looks_at_the_doors(up):
    ridden = Ridden(up)
    facing = numpy.load(up / "streams" / "dir.npy")
    for frame in numpy.flatnonzero((ridden.height > 1) & (ridden.height < 3) & (ridden.aboard > 0))[::6]:
        rows = ridden.inside[frame]
        assert facing[frame, rows, 2].max() < 0.1  # m/s
        assert (facing[frame, rows, 1] < -0.9).mean() > 0.8  # to the south


def test_those_who_wait_leave_the_way_out_free_and_do_not_press(up):
    ridden = Ridden(up)
    doors = AT[1] - SIZE[1] / 2
    rides = (ridden.height > 0.5) & (ridden.height < 3.5)
    waits = ridden.there & (ridden.places[..., 2] < 0.1) & (numpy.abs(ridden.places[..., 0]) < 4)
    in_the_way = waits & (numpy.abs(ridden.places[..., 0]) < 0.6) & (ridden.places[..., 1] > doors - 2.2)
    assert in_the_way[rides].sum() < 0.02 * waits[rides].sum()
    speeds = numpy.load(up / "streams" / "dir.npy")[..., 2]
    assert numpy.median(speeds[waits & rides[:, None]]) < 0.1


def test_routes_take_stairs_unless_the_lift_is_sooner(throng, tmp_path):
    """Stairs right beside the way for those who would wait for long; a lift where the stairs are far."""
    shares = {}
    for name, begin in (("near", -2.0), ("far", -58.0)):
        stairs = {"id": "stairs", "from": "ground", "to": "upper", "path": [[begin, -3], [begin + 8, -3]]}
        layout = house(2, [flow("ground", "upper", 4, 2)], 10, [lift(["ground", "upper"]), stairs])
        for level in layout["levels"]:
            level["floor"] = box(-64, -6, 8, 6)
        (tmp_path / name).mkdir()
        ridden = Ridden(bake(throng, tmp_path / name, layout))
        # Some way towards the stairs, or before the lift.
        shares[name] = float((ridden.places[-1, :, 1] > 0.5).mean())
    assert shares == {"near": 0.0, "far": 1.0}


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_where_many_wait_others_take_the_stairs(throng, tmp_path, seed):
    """With seed 1, the last who was to come in once found who was already in standing in its way for good."""
    stairs = {"id": "stairs", "from": "ground", "to": "upper", "path": [[-24, -3], [-16, -3]]}
    layout = house(2, [flow("ground", "upper", 40, 40)], 120, [lift(["ground", "upper"]), stairs])
    for level in layout["levels"]:
        level["floor"] = box(-32, -6, 8, 6)
    layout["simulation"]["seed"] = seed
    folder = bake(throng, tmp_path, layout)
    figures = json.loads(throng("measure", folder, "--json").stdout)
    climbed = figures["links"][0]["forward"]
    assert figures["arrived"] == 40
    rode = {person for _, person in Ridden(folder).passages(True)}
    assert climbed >= 8 and len(rode) >= 8


def test_a_bake_that_was_stopped_goes_on_to_the_same_bytes(throng, tmp_path, up):
    layout = up.parent / "layout.json"
    stopped = subprocess.Popen([throng.binary, "bake", str(layout), "-o", str(tmp_path / "parts"), "-q", "--no-gltf",
                                "--checkpoint", "0.02"])
    while stopped.poll() is None and not list((tmp_path / "parts.unfinished").glob("checkpoint.[ab]")):
        time.sleep(0.005)
    stopped.send_signal(signal.SIGTERM)
    stopped.communicate()
    assert stopped.returncode != 0  # it had not finished
    throng("bake", layout, "-o", tmp_path / "parts", "-q", "--no-gltf", "--resume")
    for name in ("streams/pos.npy", "streams/dir.npy", "lifts.npy"):
        assert (tmp_path / "parts" / name).read_bytes() == (up / name).read_bytes()


BAD = {
    "to nowhere": ({"levels": ["ground"]}, "a lift that serves one level leads nowhere"),
    "levels that are none": ({"levels": ["ground", "uper"]}, "there is no level `uper`"),
    "the same twice": ({"levels": ["ground", "ground"]}, "serves level `ground` already"),
    "too many for the cabin": ({"capacity": 20}, "has room for 9 of the layout's people, not for 20"),
    "nobody fits in": ({"size": [0.8, 0.8], "door_width": 0.6, "capacity": None, "body": 0.5},
                       "has room for 0 of the layout's people"),
    "doors to no floor": ({"at": [0, 5], "doors": 90}, "the doors of lift `lift` open onto no floor at level `ground`"),
    "doors into a wall": ({"wall": [[-2, 3.2], [2, 3.2]]}, "open into wall `in the way` at level `ground`"),
    "doors wider than it": ({"door_width": 1.9}, "`door_width` can be 1.80 here"),
    "a path": ({"path": [[0, 0], [1, 1]]}, "`path` is of links that people walk on"),
    "not served": ({"opposite": ["top"]}, "the lift does not serve level `top`"),
}


@pytest.mark.parametrize("case", BAD)
def test_mistakes_are_told(throng, tmp_path, case):
    changes, told = BAD[case]
    layout = house(3, [flow("ground", "upper", 2, 1)], 5)
    layout["links"][0]["levels"] = ["ground", "upper"]
    wall, body = changes.pop("wall", None), changes.pop("body", None)
    if wall:
        layout["walls"] = [{"id": "in the way", "points": wall}]
    if body:
        layout["flows"][0]["people"]["radius"] = body
    layout["links"][0].update(changes)
    layout["links"][0] = {key: value for key, value in layout["links"][0].items() if value is not None}
    (tmp_path / "layout.json").write_text(json.dumps(layout))
    failed = throng("check", tmp_path / "layout.json", expect=3)
    assert told in failed.stderr
    assert "layout.json:1:" in failed.stderr
