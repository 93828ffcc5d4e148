# SPDX-License-Identifier: Apache-2.0
"""Doors of vehicles: people get off first, those who wait get on while there is room, and nobody is run over."""
import json
import struct

import numpy
import pytest

from conftest import khronos_issues

HALF, DOORS, FPS = 1.2, (3.9, 11.1, 16.9, 24.1), 24  # m: half of a tram's width, its doors behind the front
LEFT, RIGHT, ABOARD, BOARDED, ALIGHTED = range(5)
STATE, SPEED = 6, 4


def box(x0, y0, x1, y1):
    return [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]


def stop(duration, board=20, alight=8, tram=(), dwell=(10, 40), **changes):
    """A tram stop on the right of a lane along x, where fronts stand at x = 14."""
    layout = {
        "throng": 1, "simulation": {"duration": duration, "avoid_congestion": False, "seed": 3},
        "areas": [{"id": "platform", "polygon": box(-17, -5.5, 17, -1.3)},
                  {"id": "street", "polygon": box(-20, -9, 20, -5.5)},
                  {"id": "corner", "polygon": box(-20, -9, -17, -6)}],
        "lanes": [{"id": "rails", "points": [[-70, 0], [70, 0]], "speed": 11, "stops": [
            {"id": "market", "at": [14, 0], "platform": "platform", "dwell": list(dwell)}]}],
        "vehicles": [{"id": "4", "lane": "rails", "kind": "tram", "times": [0], **dict(tram)}],
        "flows": [{"id": "on", "from": "platform", "board": "market", "count": board, "end": 6},
                  {"id": "off", "alight": "market", "to": "corner", "count": alight}]}
    return {**layout, **changes}


def bake(throng, folder, layout, *options, **more):
    folder.mkdir(exist_ok=True)
    (folder / "layout.json").write_text(json.dumps(layout))
    throng("bake", folder / "layout.json", "-o", folder / "bake", "-q", "--no-gltf", *options, **more)
    return folder / "bake"


class Baked:
    def __init__(self, throng, folder):
        self.figures = json.loads(throng("measure", folder, "--json").stdout)
        self.doors, self.vehicles = numpy.load(folder / "doors.npy"), numpy.load(folder / "vehicles.npy")
        self.places = numpy.load(folder / "streams" / "pos.npy")
        self.there = numpy.load(folder / "streams" / "state.npy")[..., 0] > 0.5

    def stands(self, vehicle=0):
        return numpy.flatnonzero(self.vehicles[:, vehicle, STATE] == 2)


def test_nobody_gets_on_before_the_last_has_got_off_at_that_door(throng, tmp_path):
    baked = Baked(throng, bake(throng, tmp_path / "first", stop(60, board=40, alight=24)))
    assert baked.figures["calls"][0]["boarded"] == 40 and baked.figures["calls"][0]["alighted"] == 24
    front = baked.vehicles[baked.stands()[0], 0, 0] + 14
    inside = baked.there & (baked.places[..., 1] > -HALF)
    used = 0
    for behind in DOORS:
        here = inside & (abs(baked.places[..., 0] - (front - behind)) < 0.65)
        on, off = numpy.flatnonzero(here[:, :40].any(axis=1)), numpy.flatnonzero(here[:, 40:].any(axis=1))
        assert len(on) and len(off)
        used += 1
        assert on[0] > off[-1]
    assert used == 4
    # All who were inside of the tram's side were in one of its doors.
    stood = baked.stands()
    in_doors = (abs(baked.places[..., 0, None] - (front - numpy.array(DOORS))) < 0.65 - 0.22 + 0.02).any(axis=-1)
    assert not (inside & ~in_doors)[stood[0]:stood[-1] + 1].any()


def test_nobody_is_run_over_and_everybody_is_accounted_for(throng, tmp_path):
    layout = stop(115, board=90, alight=20, tram={"times": [0, 45], "capacity": 70})
    baked = Baked(throng, bake(throng, tmp_path / "all", layout))
    figures = baked.figures
    assert figures["run_over"] == 0 and figures["vehicle_clearance"] > 0.0
    assert figures["arrived"] == 90 + 40 == figures["agents"]
    assert sum(call["boarded"] for call in figures["calls"]) == 90
    assert sum(call["alighted"] for call in figures["calls"]) == 40
    open_ = baked.doors[..., :2].max(axis=-1) > 0
    assert not (open_ & (baked.vehicles[..., SPEED] > 0)).any()
    assert not baked.doors[..., LEFT].any() and baked.doors[..., RIGHT].max() == 1.0
    steps = numpy.linalg.norm(numpy.diff(baked.places[..., :2], axis=0), axis=-1)
    assert steps[baked.there[1:] & baked.there[:-1]].max() < 3.2 / FPS  # nobody is put elsewhere


def test_who_does_not_fit_takes_the_next(throng, tmp_path):
    tram = {"times": [0, 50], "capacity": 30, "aboard": 20}
    baked = Baked(throng, bake(throng, tmp_path / "full", stop(100, board=30, alight=5, tram=tram)))
    first, second = baked.figures["calls"]
    assert (first["boarded"], first["aboard"]) == (15, 30)
    assert (second["boarded"], second["aboard"]) == (15, 30)
    assert baked.doors[..., ABOARD].max() == 30
    assert baked.figures["arrived"] == 30 + 10


@pytest.mark.parametrize("board, least, most", [(0, 11.9, 12.1), (400, 18.0, 20.0)])
def test_a_tram_stands_as_long_as_it_has_to_and_no_longer_than_it_may(throng, tmp_path, board, least, most):
    layout = stop(45, board=board, alight=0, tram={"capacity": 1000}, dwell=(12, 20))
    layout["flows"][0]["end"] = 40
    baked = Baked(throng, bake(throng, tmp_path / "dwell", layout))
    stood = baked.stands()
    assert least <= len(stood) / FPS <= most + 1.5 / FPS
    # The leaves move for two seconds each.
    right = baked.doors[stood, 0, RIGHT]
    assert (numpy.diff(right) > 0).sum() / FPS == pytest.approx(2.0, abs=0.1)
    assert (numpy.diff(right) < 0).sum() / FPS == pytest.approx(2.0, abs=0.1)


@pytest.mark.parametrize("seed", [3, 4, 6])
def test_nobody_waits_for_company_for_good(throng, tmp_path, seed):
    """Neither in a door nor beside the tram, where parties that have got off stand between each other (there, 11 of 80
    did with seed 3, and 9 with seed 6, as long as company held back whoever does not get on)."""
    layout = stop(75, board=60, alight=20, dwell=(10, 50))
    layout["simulation"]["seed"] = seed
    for flow in layout["flows"]:
        flow["people"] = {"body": "adult", "groups": "leisure"}
    baked = Baked(throng, bake(throng, tmp_path / "company", layout))
    assert baked.figures["arrived"] == 80 and baked.figures["run_over"] == 0
    assert baked.figures["calls"][0]["dwell"] < 48


def test_people_take_their_lines_only(throng, tmp_path):
    layout = stop(95, board=12, alight=0)
    layout["vehicles"].append({"id": "9", "lane": "rails", "kind": "tram", "times": [45]})
    layout["flows"].append({"id": "on the 9", "from": "platform", "count": 7, "end": 6,
                            "board": {"stop": "market", "lines": ["9"]}})
    layout["flows"][0]["board"] = {"stop": "market", "lines": ["4"]}
    baked = Baked(throng, bake(throng, tmp_path / "lines", layout))
    assert [(call["flow"], call["boarded"]) for call in baked.figures["calls"]] == [("4", 12), ("9", 7)]


def test_a_bus_has_doors_on_the_right_and_cars_drive_past(throng, tmp_path):
    layout = stop(60, board=10, alight=4, tram={"kind": "bus"})
    layout["vehicles"].append({"id": "car", "lane": "rails", "times": [30]})
    baked = Baked(throng, bake(throng, tmp_path / "bus", layout))
    assert baked.figures["arrived"] == 14 and baked.figures["run_over"] == 0
    assert not (baked.vehicles[:, 1, STATE] == 2).any() and not baked.doors[:, 1].any()


def test_there_are_doors_where_doors_are_told(throng, tmp_path):
    (tmp_path / "layout.json").write_text(json.dumps(stop(20, tram={"doors": {"at": []}})))
    assert "expected one door or more" in throng("check", tmp_path / "layout.json", expect=3).stderr


SLOW = {"doors": {"flow": 0.3, "at": [3.9], "time": 0.5}}


def test_doors_wait_for_the_last_who_gets_off(throng, tmp_path):
    layout = stop(30, alight=3, dwell=(4, 40), tram=SLOW)
    del layout["flows"][0]
    found = Baked(throng, bake(throng, tmp_path, layout))
    call = found.figures["calls"][0]
    assert call["alighted"] == 3 and found.figures["run_over"] == 0


def test_a_call_ends_with_its_vehicle(throng, tmp_path):
    """Who was not clear of the doors when they shut does not hold them at the next stop, on the other side."""
    stops = [{"id": "market", "at": [14, 0], "platform": "platform", "dwell": [4, 7]},
             {"id": "park", "at": [90, 0], "platform": "island", "dwell": [10, 30]}]
    second = []
    for alight in (0, 3):
        layout = stop(75, alight=alight, tram=SLOW)
        layout["areas"].append({"id": "island", "polygon": box(60, 1.3, 95, 6)})
        layout["lanes"] = [{"id": "rails", "points": [[-70, 0], [200, 0]], "speed": 11, "stops": stops}]
        layout["flows"][0] = {"id": "on", "from": "island", "board": "park", "count": 5, "end": 5}
        found = Baked(throng, bake(throng, tmp_path / str(alight), layout))
        second.append(found.figures["calls"][1])
        assert found.figures["run_over"] == 0
    without, after = second
    assert after["boarded"] == without["boarded"] > 0 and abs(after["dwell"] - without["dwell"]) < 1


def test_doors_slide_in_crowd_glb(throng, tmp_path):
    folder = tmp_path / "bake"
    (tmp_path / "layout.json").write_text(json.dumps(stop(20, board=2, alight=2)))
    throng("bake", tmp_path / "layout.json", "-o", folder, "-q")
    content = (folder / "crowd.glb").read_bytes()
    size = struct.unpack_from("<I", content, 12)[0]
    document, data = json.loads(content[20:20 + size]), content[28 + size:]
    doors = [number for number, node in enumerate(document["nodes"]) if node["name"] == "door"]
    assert len(doors) == 2 * 2 * len(DOORS)  # two leaves, on both sides
    animation = document["animations"][0]
    slid = []
    for channel in animation["channels"]:
        if channel["target"]["node"] not in doors:
            continue
        accessor = document["accessors"][animation["samplers"][channel["sampler"]]["output"]]
        first = document["bufferViews"][accessor["bufferView"]].get("byteOffset", 0) + accessor.get("byteOffset", 0)
        places = numpy.frombuffer(data, "<f4", 3 * accessor["count"], first).reshape(-1, 3)
        rest = document["nodes"][channel["target"]["node"]]["translation"]
        right = rest[2] > 0.0  # z is to the right
        slid.append((right, abs(places[:, 0] - rest[0])))
    open_ = numpy.load(folder / "doors.npy")[:, 0, RIGHT]
    assert open_.max() == 1.0 and len(slid) == len(doors)
    for right, way in slid:
        assert way == pytest.approx(0.48 * 1.3 * open_ if right else 0.0, abs=1e-4)
    issues = khronos_issues(folder / "crowd.glb")
    assert issues["numErrors"] == 0, issues["messages"][:5]


@pytest.mark.parametrize("change, expected", [
    (lambda layout: layout["vehicles"][0].update(doors={"sides": "left"}), "has no doors on the right, where"),
    (lambda layout: layout["areas"][0].update(polygon=box(-17, -5.5, 17, -2)), "no ground of `platform`"),
    (lambda layout: layout["areas"][0].update(polygon=box(-17, -5.5, 5, -1.3)), "no ground of `platform`"),
    (lambda layout: layout["areas"][0].update(polygon=box(-17, -5.5, 17, -1)), "`platform` reaches into `4`"),
    (lambda layout: layout["vehicles"][0].update(kind="car"), "no vehicle with doors comes to `market`"),
    (lambda layout: layout["lanes"][0]["stops"][0].update(dwell=[30, 20]), "at least 30 s and at most 20 s"),
    (lambda layout: layout["lanes"][0]["stops"][0].update(dwell=[4, 5]), "take 2 s to open"),
    (lambda layout: layout["lanes"][0]["stops"][0].update(platform="platfrm"), "did you mean `platform`?"),
    (lambda layout: layout["lanes"][0]["stops"][0].pop("platform"), "only a stop with a `platform` has this"),
    (lambda layout: layout["vehicles"][0].update(capacity=0), "capacity"),
    (lambda layout: layout["vehicles"][0].update(capacity=9, aboard=10), "10 people are aboard, and there is"),
    (lambda layout: layout["vehicles"][0].update(aboard=3), "8 people get off each `4`, and 3 are aboard"),
    (lambda layout: layout["vehicles"][0].update(doors={"at": [40]}), "is not in the side of a tram"),
    (lambda layout: layout["vehicles"][0].update(doors={"at": [5, 6]}), "are in each other"),
    (lambda layout: layout["flows"][0].update(board="markt"), "did you mean `market`?"),
    (lambda layout: layout["flows"][0].update(board={"stop": "market", "lines": ["5"]}), "no vehicles `5` stop at"),
    (lambda layout: layout["flows"][0].update(to="corner"), "go nowhere else"),
    (lambda layout: layout["flows"][1].update({"from": "corner"}), "`from` has no meaning"),
])
def test_mistakes_are_told_with_their_line(throng, tmp_path, change, expected):
    layout = stop(10)
    change(layout)
    (tmp_path / "layout.json").write_text(json.dumps(layout, indent=1))
    told = throng("check", tmp_path / "layout.json", expect=3)
    assert expected in told.stderr + told.stdout
    assert "layout.json:" in told.stderr + told.stdout


def test_what_is_of_no_use_is_warned_of(throng, tmp_path):
    layout = stop(10, board=0)
    layout["flows"] = [{"id": "past", "from": "corner", "to": "platform", "count": 1}]
    (tmp_path / "layout.json").write_text(json.dumps(layout))
    assert "nobody gets on or off `4`" in throng("check", tmp_path / "layout.json").stderr
    layout["vehicles"][0].update(kind="car")
    (tmp_path / "layout.json").write_text(json.dumps(layout))
    assert "no vehicle with doors stops at `market`" in throng("check", tmp_path / "layout.json").stderr
