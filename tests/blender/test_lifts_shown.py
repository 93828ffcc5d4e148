# SPDX-License-Identifier: Apache-2.0
"""Lifts of a bake in Blender: cabins are where the bake has them, and its doors open where a cabin stands."""
import json
import pathlib

import numpy
import pytest

from results import result_of
from sample_bake import SMALL_CAST, write_bake

HERE = pathlib.Path(__file__).resolve().parent
ADDON = HERE.parent.parent / "blender_addon"
FRAMES, UPPER = 48, 4.0


@pytest.fixture(scope="module")
def shown(blender, tmp_path_factory):
    """A cabin that stands open below for half a second, and open above in the last frame."""
    folder = tmp_path_factory.mktemp("lifts") / "bake"
    write_bake(folder, agents=2, frames=FRAMES, **SMALL_CAST)
    manifest = json.loads((folder / "bake.json").read_text())
    track = numpy.zeros((FRAMES, 1, 4), dtype=numpy.float32)
    track[:12, 0] = (0.0, 1.0, 3.0, 0.0)
    track[12:, 0, 0] = numpy.linspace(0.0, UPPER, FRAMES - 12)
    track[12:, 0, 3] = 1.0
    track[-1, 0, 1] = 0.5
    numpy.save(folder / "lifts.npy", track)
    manifest["lifts"] = {"file": "lifts.npy", "columns": ["height", "open", "aboard", "stop"], "list": [
        {"id": "lift", "at": [5.0, 6.0], "size": [2.4, 1.6], "doors": -90, "door_width": 1.2, "capacity": 8, "stops": [
            {"level": "ground", "height": 0.0, "doors": -90}, {"level": "upper", "height": UPPER, "doors": 90}]}]}
    (folder / "bake.json").write_text(json.dumps(manifest))
    return result_of(blender(HERE / "check_lifts.py", ADDON, folder)), track


def test_cabins_are_where_the_bake_has_them(shown):
    result, track = shown
    assert result["cabins"] == 1
    for shot in result["shots"]:
        assert shot["cabin"] == pytest.approx([5.0, 6.0, track[shot["frame"] - 1, 0, 0]], abs=1e-4)
    assert result["size"][:2] == pytest.approx([2.4 - 0.14, 1.6 - 0.14], abs=0.04)  # within the shaft


def test_doors_are_open_where_the_cabin_stands(shown):
    result, _ = shown
    folded = {shot["frame"]: [1.0 - scale for _, scale in shot["doors"]] for shot in result["shots"]}
    assert folded[1] == pytest.approx([0.92, 0.92, 0.0, 0.0], abs=1e-4)  # two leaves below, two above
    assert folded[30] == pytest.approx([0.0] * 4, abs=1e-4)
    assert folded[48] == pytest.approx([0.0, 0.0, 0.46, 0.46], abs=1e-4)
