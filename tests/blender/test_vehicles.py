# SPDX-License-Identifier: Apache-2.0
"""Vehicles of a bake in Blender: where the bake has them, on wheels that turn, by curves alone."""
import json
import pathlib

import numpy
import pytest

from results import result_of
from sample_bake import SMALL_CAST, write_bake

HERE = pathlib.Path(__file__).resolve().parent
ADDON = HERE.parent.parent / "blender_addon"
FRAMES, SPEED, WHEEL = 48, 6.0, 0.32  # m/s, m
DOORS, WIDTH, TRAM = (3.9, 11.1), 1.3, (40.0, 5.0)  # m: of a tram that stands there
OPEN = {2: 0.0, 10: 0.0, 40: 1.0}  # its doors on the right, by the frames that are looked at


@pytest.fixture(scope="module")
def shown(blender, tmp_path_factory):
    """A car that comes in frame 8 and drives north, a tram whose doors open, and a light that turns green after a
    second."""
    folder = tmp_path_factory.mktemp("traffic") / "bake"
    write_bake(folder, agents=2, frames=FRAMES, **SMALL_CAST)
    manifest = json.loads((folder / "bake.json").read_text())
    track = numpy.zeros((FRAMES, 2, 8), dtype=numpy.float32)
    for frame in range(8, FRAMES):
        along = SPEED * (frame - 8) / 24
        track[frame, 0] = (3.0, along - 2.25, 0.0, numpy.pi / 2, SPEED, along, 1.0, 0.0)
    track[:, 1] = (*TRAM, 0.0, 0.0, 0.0, 14.0, 2.0, 0.0)
    doors = numpy.zeros((FRAMES, 2, 5), dtype=numpy.float32)
    doors[12:, 1, 1] = numpy.minimum(numpy.arange(FRAMES - 12) / 24, 1.0)
    doors[:, 1, 2] = numpy.where(numpy.arange(FRAMES) < 5, 9, numpy.where(numpy.arange(FRAMES) < 20, 4, 500))
    numpy.save(folder / "vehicles.npy", track)
    numpy.save(folder / "doors.npy", doors)
    manifest["doors"] = {"file": "doors.npy", "columns": ["left", "right", "aboard", "boarded", "alighted"], "list": [
        {"at": [], "width": 0, "left": False, "right": False, "capacity": 0},
        {"at": DOORS, "width": WIDTH, "left": True, "right": True, "capacity": 100}]}
    manifest["vehicles"] = {
        "file": "vehicles.npy", "columns": ["x", "y", "z", "heading", "speed", "along", "state", "braking"],
        "list": [{"flow": "cars", "kind": "car", "length": 4.5, "width": 1.8, "height": 1.5, "wheel": WHEEL},
                 {"flow": "4", "kind": "tram", "length": 28.0, "width": 2.4, "height": 3.4, "wheel": 0.33}]}
    manifest.setdefault("geometry", {})["traffic"] = {
        "crossings": [{"id": "zebra", "polygon": [[1, 4], [5, 4], [5, 8], [1, 8]]}],
        "lanes": [{"id": "lane", "points": [[3, -30], [3, 30]], "width": 3.5,
                   "stops": [{"at": [3, 2], "signal": "lights"}]}],
        "signals": [{"id": "lights", "offset": 0, "phases": [
            {"name": "", "seconds": 1.0, "crossings": [], "lanes": []},
            {"name": "", "seconds": 60.0, "crossings": [], "lanes": ["lane"]}]}]}
    (folder / "bake.json").write_text(json.dumps(manifest))
    return result_of(blender(HERE / "check_traffic.py", ADDON, folder)), track


def test_vehicles_are_where_the_bake_has_them(shown):
    result, track = shown
    for shot in result["shots"]:
        car, row = shot["vehicles"][0], track[shot["frame"] - 1, 0]
        assert car["hidden"] == (row[6] == 0)
        if row[6] == 0:
            continue
        assert car["place"] == pytest.approx(row[:3].tolist(), abs=1e-4)
        assert car["heading"] == pytest.approx(row[3], abs=1e-5)
        assert car["turn"] == pytest.approx(row[5] / WHEEL, abs=1e-4)


def test_wheels_stand_on_the_ground_and_cars_are_as_large_as_their_boxes(shown):
    result, _ = shown
    assert result["lowest"] == pytest.approx(0.0, abs=0.005)
    assert result["size"][0] == pytest.approx(4.5, abs=0.6) and result["size"][0] < 4.6
    assert result["size"][1] == pytest.approx(1.8, abs=0.1)


def test_lamps_are_lit_as_the_signal_goes(shown):
    lamps = [shot["lamps"] for shot in shown[0]["shots"]]
    assert [lit["Throng red lamp"] for lit in lamps] == [True, True, False]
    assert [lit["Throng green lamp"] for lit in lamps] == [False, False, True]


def test_doors_slide_open_on_the_side_where_the_bake_has_them_open(shown):
    middles = numpy.array([TRAM[0] + 14.0 - at for at in DOORS])
    for shot in shown[0]["shots"]:
        leaves = numpy.array(shot["doors"])
        assert len(leaves) == 8  # two a door, on both sides
        right = leaves[leaves[:, 1] < TRAM[1]]
        slid = abs(right[:, 0, None] - middles).min(axis=1)
        assert slid == pytest.approx(0.48 * WIDTH * OPEN[shot["frame"]], abs=1e-3)
        left = leaves[leaves[:, 1] > TRAM[1]]
        assert abs(left[:, 0, None] - middles).min(axis=1) == pytest.approx(0.0, abs=1e-4)
        assert left[:, 1] == pytest.approx(TRAM[1] + 1.2, abs=1e-4)


def test_as_many_passengers_are_seen_as_are_aboard_and_have_room(shown):
    for shot in shown[0]["shots"]:
        places = numpy.array(shot["passengers"])
        assert len(places) == {2: 9, 10: 4, 40: 48}[shot["frame"]]
        assert (abs(places[:, 0] - TRAM[0]) < 13.0).all() and (abs(places[:, 1] - TRAM[1]) < 0.7).all()
        middles = numpy.array([TRAM[0] + 14.0 - at for at in DOORS])
        assert abs(places[:, :1] - middles).min() > 0.7, "doors are free"
        assert places[:, 2] == pytest.approx(0.05)
