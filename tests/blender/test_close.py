# SPDX-License-Identifier: Apache-2.0
"""People close to the camera have more detail in final pictures, in a real Blender: Debian's and the newest."""
import pytest

from conftest import blender_module, blender_program
from results import ADDON, HERE, result_of
from sample_bake import write_bake

pytestmark = pytest.mark.parametrize("blender", [blender_program, blender_module], indirect=True,
                                     ids=["blender", "bpy"])


@pytest.fixture(scope="module")
def seen(blender, bodies, tmp_path_factory):
    folder = tmp_path_factory.mktemp("close")
    write_bake(folder / "bake", agents=40, variations=12, gaits=(1, 2))
    return result_of(blender(HERE / "check_close.py", ADDON, folder / "bake", folder,
                             environment={"THRONG_BODIES": str(bodies)}))


def test_only_the_meshes_of_those_who_come_close_are_made(seen):
    made, wanted = seen["members"]
    assert made == wanted and made


def test_who_is_close_has_more_detail(seen):
    finer, close = seen["finer"]
    assert finer == close and len(close) > 3
    assert seen["same people"] < 0.06, "as large, where they were, in the same pose"
    assert all(12_000 < count <= 41_000 for count in seen["triangles"]), seen["triangles"]
    assert seen["attributes"] == ["throng_row"]


def test_the_screen_keeps_the_coarser_meshes(seen):
    assert seen["on screen"]


def test_people_blink_look_about_and_open_their_mouths_when_they_talk(seen):
    assert all(1 <= count <= 3 for count in seen["blinks"]) and len(seen["blinks"]) > 3, "in five seconds"
    assert all(0.0004 < moved < 0.006 for moved in seen["eyes"]), "m, of pupils"
    assert any(seen["gather"]) and all((opened > 0.001) == talks for opened, talks in
                                       zip(seen["mouths"], seen["gather"]))
    assert seen["any frame first"] < 1e-6, "what faces do follows from the time alone"


def test_where_there_are_too_many_the_nearest_have_it(seen):
    count, furthest, nearest_other = seen["few"]
    assert 1 <= count <= 4 and furthest < nearest_other


def test_saved_scenes_have_it_without_the_add_on(seen):
    assert seen["saved"] is not False and seen["saved"] < 1e-5


def test_whoever_comes_close_in_the_shot_is_found(seen):
    member, made, stays = seen["shot"]
    assert member in made and stays, "and the scene's frame is what it was"


def test_it_goes_away_again(seen):
    assert seen["none"] == [0, True]
    assert seen["near off"] == [0, False, 1]


def test_scenes_without_a_camera_are_told(seen):
    assert "has no camera" in seen["no camera"]
