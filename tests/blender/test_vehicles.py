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


@pytest.fixture(scope="module")
def shown(blender, tmp_path_factory):
    """A car that comes in frame 8 and drives north, and a light that turns green after a second."""
    folder = tmp_path_factory.mktemp("traffic") / "bake"
    write_bake(folder, agents=2, frames=FRAMES, **SMALL_CAST)
    manifest = json.loads((folder / "bake.json").read_text())
    track = numpy.zeros((FRAMES, 1, 8), dtype=numpy.float32)
    for frame in range(8, FRAMES):
        along = SPEED * (frame - 8) / 24
        track[frame, 0] = (3.0, along - 2.25, 0.0, numpy.pi / 2, SPEED, along, 1.0, 0.0)
    numpy.save(folder / "vehicles.npy", track)
    manifest["vehicles"] = {
        "file": "vehicles.npy", "columns": ["x", "y", "z", "heading", "speed", "along", "state", "braking"],
        "list": [{"flow": "cars", "kind": "car", "length": 4.5, "width": 1.8, "height": 1.5, "wheel": WHEEL}]}
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
