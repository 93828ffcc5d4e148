# SPDX-License-Identifier: Apache-2.0
"""Crowds of people who are shaped from a library of bodies, in a real Blender: Debian's and the newest."""
import csv

import pytest

from conftest import ROOT, blender_module, blender_program
from results import ADDON, HERE, result_of
from sample_bake import write_bake

pytestmark = pytest.mark.parametrize("blender", [blender_program, blender_module], indirect=True,
                                     ids=["blender", "bpy"])
MAN, WOMAN, CHILD, OLD = range(4)
RADII = (0.16, 0.19, 0.23, 0.25, 0.27)
CLUB = "#2040a0 #f0f0f0"


def is_old(row):
    return row % 10 == 9


def said(row):
    """Profile, look and colours as a bake tells them; of some small ones it says nothing."""
    return ("elderly", "fans", CLUB) if is_old(row) else ("child" if row % 5 == 1 else "", "casual", "")


@pytest.fixture(scope="module")
def seen(blender, bodies, tmp_path_factory):
    folder = tmp_path_factory.mktemp("bodies")
    write_bake(folder / "bake", agents=40, variations=12, gaits=(1,))
    with open(folder / "bake" / "agents.csv", "w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["id", "group", "radius", "variation", "spawn_frame", "profile", "look", "colours"])
        table.writerows([row, "walkers", RADII[row % 5], row % 12, 0, *said(row)] for row in range(40))
    return result_of(blender(HERE / "check_bodies.py", ADDON, folder / "bake", folder,
                             environment={"THRONG_BODIES": str(bodies)}))


def test_children_are_children_and_others_are_not(seen):
    shown = {int(row): member for row, member in seen["shown"].items()}
    assert len(shown) > 30 and all((member == CHILD) == (RADII[row % 5] < 0.2) for row, member in shown.items())
    assert {MAN, WOMAN} <= set(shown.values())


def test_people_are_dressed_and_as_old_as_the_bake_says(seen):
    assert seen["roles"] == [["casual", ""], ["casual", ""], ["casual", "child"], [f"fans {CLUB}", "elderly"]]
    assert all((member == OLD) == is_old(int(row)) for row, member in seen["shown"].items())
    years, stoop = seen["old"]
    assert years > 65 and stoop > 0.02
    assert any(name.startswith("throng top") and name.endswith(f"fans {CLUB}") for name in seen["materials"])


def test_the_broad_have_a_larger_radius(seen):
    shown = {int(row): member for row, member in seen["shown"].items()}
    shown = {row: member for row, member in shown.items() if not is_old(row)}
    broad = lambda radius: [member == MAN for row, member in shown.items() if RADII[row % 5] == radius]
    assert sum(broad(0.27)) / len(broad(0.27)) > sum(broad(0.23)) / len(broad(0.23)) + 0.3


def test_figures_have_all_poses_and_levels(seen):
    assert seen["figures"] == [4, 4] and seen["after"] == 4
    assert seen["poses"] == seen["expected poses"]
    for near, middle, far in seen["triangles"]:
        assert 3000 < near < 6000 and 900 < middle < 2300 and 300 < far < 760
    assert seen["between levels"] < 0.06


def test_what_is_kept_of_people_is_what_they_are(seen):
    shaped, (kept, anew) = seen["kept"]
    assert shaped == [1, 0, 1] and kept == 0.0 and anew < 1e-12, "vectors are summed in another order now and then"


def test_few_bones_pose_people_as_all_bones_do(seen):
    upright, bent = seen["off bones"][:OLD], seen["off bones"][OLD]
    assert all(nearly < 2.5e-3 and most < 5e-3 for nearly, most in upright), "where collarbones meet arms"
    assert bent[0] < 2e-3 and bent[1] < 8e-3, "necks of bent backs hang on more than four"
    count, bones = seen["sheets"]
    assert count == 4 and bones <= 20, "one a person, for all levels, of the bones that move"


def test_people_stand_on_the_ground_and_are_as_tall_as_they_should_be(seen):
    for low, high, height in seen["heights"]:
        assert abs(low) < 0.004 and -0.02 < high - height < 0.09, "with shoes and hair"
    assert seen["heights"][CHILD][2] < 1.45 < 1.6 < seen["heights"][MAN][2]


def test_limbs_blur_by_the_poses_before_and_after(seen):
    blurring, worst, stored = seen["velocities"]
    assert blurring == 24 and worst < 2e-3 and not stored


def test_overrides_and_heroes_work(seen):
    assert seen["swapped"] == [CHILD, True] and seen["back"]
    hero = seen["hero"]
    assert hero["off"] < 0.08 and hero["hidden"] and hero["materials"] and hero["pattern"] and hero["tint"] == 3
    assert hero["triangles"] > 30000, "in full detail"


def test_heroes_have_keys_for_their_faces(seen):
    assert set(seen["keys"]) == {"Blink", "Mouth", "Smile"}
    assert all(0.005 < most < 0.05 and lowest > 0.8 for most, lowest in seen["keys"].values()), seen["keys"]
    assert seen["keys"]["Blink"][1] > 0.88 > seen["keys"]["Mouth"][1]


def test_people_are_culled_and_tinted_as_any_are(seen):
    same, left = seen["culled"]
    assert same and 5 < left < len(seen["shown"]) - 5
    club, other, own = seen["chests"]
    assert club[2] > 1.5 * club[0], "the club is blue"
    assert min(other) > 0.6 * max(other), "its other colour is white"
    assert own[0] > 3.0 * max(own[1:]), "somebody's own colour is red"


def test_heroes_go_as_their_people_do(seen):
    median, most, weights = seen["puppet"]
    assert median < 0.012 and most < 0.05 and weights < 0.01, seen["puppet"]


def test_materials_are_those_of_the_cast(seen):
    kinds = {name.split()[1] for name in seen["materials"]}
    assert {"skin", "hair", "top", "bottom", "shoes", "eyes"} <= kinds


def test_without_the_library_nothing_is_changed(seen):
    assert "none.npz cannot be read" in seen["missing"] and "body_library.py" in seen["missing"] and seen["left"] == 0
    said, figures = seen["no levels"]
    assert "none.npz cannot be read" in said and figures == 4


@pytest.mark.parametrize("has_library", [True, False], ids=["library", "no library"])
def test_the_cast_is_rendered_by_one_command(blender, bodies, tmp_path, has_library):
    environment = {"THRONG_BODIES": str(bodies) if has_library else ""}
    told = blender(ROOT / "scripts" / "render_cast.py", tmp_path / "cast.png", "--shot", "close", "--level", "2",
                   "--width", "96", "--height", "54", "--samples", "1", environment=environment)
    assert ("4 meshes" in told) == has_library and ("so these are the simple figures" in told) != has_library
    assert (tmp_path / "cast.png").read_bytes()[16:24] == b"\0\0\0\x60\0\0\0\x36", "its width and height"
