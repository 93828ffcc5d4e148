# SPDX-License-Identifier: Apache-2.0
"""Diagram images of bakes with levels in a real Blender: each storey shows the cells of those who are on it."""
import json
import sys

import numpy
import OpenEXR
import pytest

import throng_io
from conftest import EXAMPLES, ROOT
from results import ADDON, HERE, result_of

sys.path.insert(0, str(ROOT / "tests" / "bake"))
from test_diagram_storeys import two_floors  # noqa: E402

SCRIPT = HERE / "check_storey_cells.py"


class Storeys:
    """A bake, and what check_storey_cells.py has seen of it."""

    def __init__(self, blender, throng, folder, layout, frame=24):
        self.folder, self.frame = folder, frame
        throng("bake", layout, "-o", folder / "bake", "-q", "--no-gltf", "--diagrams", "24", "--set",
               "simulation.smoothing=0", "--set", f"simulation.duration={(frame + 24) / 24}")
        self.bake = throng_io.Bake(folder / "bake")
        self.there = numpy.nonzero(self.bake.there(frame))[0]
        (folder / "people.json").write_text(json.dumps(self.bake.pos[frame, self.there].tolist()))
        self.result = result_of(blender(SCRIPT, ADDON, folder / "bake", folder))

    def picture(self, name):
        with OpenEXR.File(str(self.folder / f"{name}.exr")) as file:
            return numpy.asarray(file.channels()["RGB"].pixels, dtype=float)

    def owners_below(self):
        """Whose cell the image has where a ray down from each person meets its floor; None where it meets nothing."""
        image = self.bake.diagram(self.frame).channels
        height, width = image["id"].shape
        owners = []
        for hit in self.result["hits"]:
            if hit is None:
                owners.append(None)
                continue
            line, column = int((1.0 - hit[1]) * height), int(hit[0] * width)
            owners.append(int(image["id"][line, column]) if image["kind"][line, column] == 1 else -1)
        return owners


@pytest.fixture(scope="module")
def storeys(blender, throng, tmp_path_factory):
    folder = tmp_path_factory.mktemp("storeys")
    (folder / "layout.json").write_text(json.dumps(two_floors()))
    return Storeys(blender, throng, folder, folder / "layout.json")


def test_everybody_stands_on_its_own_cell(storeys):
    owners = storeys.owners_below()
    assert len(owners) == 28 and sum(owner == row for owner, row in zip(owners, storeys.there)) >= 26, owners
    # All of both floors, but for 2.4 m x 4.8 m of the stair's opening below and the lift's, and all treads.
    floors, stair, opening, shaft = 24 * 7 + 10 * 5 + 13 * 6, 7 * 2.5, 4.8 * 2.5, 2 * 1.6 * 1.8
    assert abs(storeys.result["area"] - (floors + stair - opening - shaft)) < 8.0, storeys.result["area"]


def test_cells_are_seen_and_taken_away(storeys):
    bare, overlay, mask, none = (storeys.picture(name) for name in ("bare", "overlay", "mask", "none"))
    assert numpy.abs(none - bare).max() < 1e-4
    coloured = 1.0 - overlay.min(axis=2) / overlay.max(axis=2) > 0.5
    darker = mask.mean(axis=2) / bare.mean(axis=2) < 0.5
    # 28 people in the open own about a square metre each, of 30 x 20 m, 240 x 160 pixels.
    assert 10.0 < coloured.sum() / 64.0 < 32.0, coloured.sum() / 64.0
    assert (coloured & darker).sum() > 0.85 * coloured.sum()  # edges are smooth
    assert numpy.median((mask / bare)[coloured]) < 0.4 and numpy.median((mask / bare)[~coloured & ~darker]) > 0.99


def test_nothing_is_left_and_missing_floors_are_told(storeys):
    assert (storeys.result["left"], storeys.result["nodes"]) == ([], [])
    assert "floors are not in the scene" in storeys.result["without ground"]


@pytest.mark.slow
def test_on_a_terrain_that_is_cut_everybody_stands_on_its_own_cell_too(blender, throng, tmp_path):
    storeys = Storeys(blender, throng, tmp_path, EXAMPLES / "bridge-terrain.json", frame=456)
    owners = storeys.owners_below()
    met = sum(owner == row for owner, row in zip(owners, storeys.there))
    assert len(owners) > 60 and met >= 0.97 * len(owners), (met, owners)
    assert storeys.result["longest"] <= 2.5001
