# SPDX-License-Identifier: Apache-2.0
"""Storeys are taken off, to look into those below, in a real Blender: people, floors, and what stands on them."""
import json

import pytest

from conftest import blender_module, blender_program
from results import ADDON, HERE, result_of

pytestmark = pytest.mark.parametrize("blender", [blender_program, blender_module], indirect=True,
                                     ids=["blender", "bpy"])
UPPER = 4.0


def floor(size):
    return [[-size, -size], [size, -size], [size, size], [-size, size]]


LAYOUT = {
    "throng": 1, "simulation": {"duration": 2},
    "levels": [{"id": "ground", "floor": floor(12)}, {"id": "deck", "height": UPPER, "floor": floor(6)}],
    "links": [{"id": "stairs", "from": "ground", "to": "deck", "path": [[-11, 0], [-5, 0]], "width": 2}],
    "areas": [{"id": "below", "polygon": [[8, -9], [11, -9], [11, -6], [8, -6]]},
              {"id": "above", "level": "deck", "polygon": [[2, 2], [5, 2], [5, 5], [2, 5]]}],
    "formations": [{"id": "low", "type": "grid", "origin": [-4, -10], "rows": 2, "columns": 3, "goal": "below"},
                   {"id": "high", "level": "deck", "type": "grid", "origin": [-3, -4], "rows": 2, "columns": 2,
                    "goal": "above"}],
}


@pytest.fixture(scope="module")
def seen(blender, throng, tmp_path_factory):
    folder = tmp_path_factory.mktemp("cutaway")
    (folder / "layout.json").write_text(json.dumps(LAYOUT))
    throng("bake", folder / "layout.json", "-o", folder / "bake", "-q", "--no-gltf")
    return result_of(blender(HERE / "check_cutaway.py", ADDON, folder / "bake", folder,
                             environment={"THRONG_BODIES": ""}))


def test_everything_is_there_at_first_and_again_in_the_end(seen):
    people, highest, _ = seen["all"]
    assert people == pytest.approx([0.0] * 6 + [UPPER] * 4, abs=0.01) and highest > UPPER - 1e-3
    assert seen["none"] == [["FINISHED"], seen["all"]] and seen["height"] == [["FINISHED"], seen["all"]]


def test_a_level_goes_with_all_above_its_floor(seen):
    said, (people, highest, walls) = seen["level"]
    assert said == ["FINISHED"]
    assert people == pytest.approx([0.0] * 6, abs=0.01) and 3.0 < highest < UPPER - 0.25, "stairs stay"
    assert walls != seen["all"][2], "railings of the deck go, too"


def test_it_holds_beside_other_things_that_leave_people_out(seen):
    assert seen["culled, too"] == seen["level"][1]


def test_saved_scenes_have_it_without_the_add_on(seen):
    assert seen["saved"] == seen["level"][1]


def test_levels_that_are_not_there_are_told(seen):
    said, left = seen["unknown"]
    assert "no level `roof`: it has `ground`, `deck`" in said and left == seen["all"]
