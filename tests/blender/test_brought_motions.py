# SPDX-License-Identifier: Apache-2.0
"""Clips that are brought along move a crowd's people, in a real Blender: Debian's and the newest."""
import csv

import pytest

from conftest import blender_module, blender_program
from results import ADDON, HERE, result_of
from sample_bake import write_bake

pytestmark = pytest.mark.parametrize("blender", [blender_program, blender_module], indirect=True,
                                     ids=["blender", "bpy"])
RADII = (0.16, 0.20, 0.25, 0.28)
REFUSED = {"cut": "cut.bvh, line ", "nan": "nan.bvh, line ", "still": "still does not walk: ",
           "backwards": "backwards does not walk forwards", "no stand": "walk does not stand: its feet move",
           "words": "words.txt is no file of motion", "words in glb": "words.glb is not a glTF file",
           "absent": "absent.bvh cannot be read", "no clip": "has no clip Dance: there are",
           "no member": "the cast has members 0 to 2: there is no 7", "no number": "'everybody' is no number",
           "stick": "walk with a stick", "no armature": "no armature", "nothing to remove": "the crowd has no motions"}


@pytest.fixture(scope="module")
def seen(blender, bodies, tmp_path_factory):
    folder = tmp_path_factory.mktemp("motions")
    write_bake(folder / "bake", agents=24, variations=3, gaits=(1, 2))
    write_bake(folder / "wider", agents=24, variations=3)
    for bake in ("bake", "wider"):
        with open(folder / bake / "agents.csv", "w", newline="") as file:
            table = csv.writer(file)
            table.writerow(["id", "group", "radius", "variation", "spawn_frame"])
            table.writerows([row, "walkers", RADII[row // 2 % 4], row % 3, 0] for row in range(24))
    return result_of(blender(HERE / "check_motions.py", ADDON, folder / "bake", folder / "wider", folder,
                             environment={"THRONG_BODIES": str(bodies)}))


def test_what_cannot_be_used_is_refused_in_one_line(seen):
    assert set(seen["errors"]) == set(REFUSED)
    for label, expected in REFUSED.items():
        said = seen["errors"][label]
        assert expected in said and "Traceback" not in said and said.strip().count("\n") == 0, said
    assert "nobody in this crowd can be given motions" in seen["lofted"]


def test_a_clip_is_told_of(seen):
    report = "\n".join(seen["report"])
    assert "walk: 1.71 m tall (its numbers are cm), 33 frames, 30 a second" in report
    assert "right leg: RightUpLeg > RightLeg > RightFoot" in report and "a stride of 1.30 m in 1.07 s" in report
    assert seen["left"], "nothing comes into the file but the motion"


def test_poses_of_the_strides_near_it_are_made_anew(seen):
    assert seen["changed"] == [[1], [1], []], "of both gaits the second; not of who walks with a stick"
    for slid, lowest in seen["slides"]:
        assert slid < 0.01 and lowest > -0.004
    for least, most in seen["swings"]:
        assert (least, most) == pytest.approx((-24.0, 24.0), abs=3.0)


def test_the_rest_pose_of_a_clip_does_not_matter(seen):
    motions, apart = seen["rests"]
    assert motions == 1 and apart < 1e-3, "the same name takes the place of the first"


def test_those_near_and_those_far_show_it(seen):
    for told, others in (seen["near"], seen["far"]):
        assert told and min(told) > 0.01
        assert others and max(others) < 1e-6


def test_it_lasts(seen):
    wide, narrow, apart = seen["widened"]
    assert (wide, narrow) == (4, 2) and apart < 1e-3
    assert max(seen["saved"]) < 1e-5


def test_heroes_go_so_too(seen):
    assert seen["hero"] < 0.06


def test_gltf_files_and_armatures_move_people(seen):
    names, lines = seen["gltf"]
    report = "\n".join(lines)
    assert names == ["walk", "walk_cycle", "Running_A", "Idle"] or sorted(names) == ["Idle", "Running_A", "walk",
                                                                                   "walk_cycle"]
    assert "a stride of 1.20 m" in report, report
    assert "stands: from" in report and "no right and no left arm" in report
    same, (slid, _) = seen["hers"]
    assert same and slid < 0.01 and seen["stands"] == 1
    report = "\n".join(seen["armature"])
    assert "Actor" in report and seen["armature stays"] and seen["every"] == [0, 1, 2, 3]


def test_they_are_taken_away_again(seen):
    assert seen["one removed"] < 1e-6 and seen["hers removed"] == ["walk"]
    assert seen["removed"] == [[], False] and seen["as before"] < 1e-6
