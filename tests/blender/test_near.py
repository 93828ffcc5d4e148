# SPDX-License-Identifier: Apache-2.0
"""People near the camera are bent into the pose of the moment, in a real Blender: Debian's and the newest."""
import csv
import struct

import numpy
import pytest

from conftest import blender_module, blender_program
from results import ADDON, HERE, result_of
from sample_bake import write_bake

pytestmark = pytest.mark.parametrize("blender", [blender_program, blender_module], indirect=True,
                                     ids=["blender", "bpy"])
BLENDS, SHUFFLES = 0, 1  # rows: one whose gait has just changed, one who is slower than anybody walks


@pytest.fixture(scope="module")
def seen(blender, bodies, tmp_path_factory):
    folder = tmp_path_factory.mktemp("near")
    pos, way, state = write_bake(folder / "bake", agents=40, variations=12, gaits=(1, 2))
    pos[:, [BLENDS, SHUFFLES], :2] = (-2.0, -6.0), (1.0, -5.0)
    state[:, BLENDS, 0] = 1.0 + (1.0 + (2.0 + 9.0 / 16.0) / 32.0) / 16.0  # 9/16 of gait 2 are left
    way[:, SHUFFLES, 2] = 0.15
    for name, stream in (("pos", pos), ("dir", way), ("state", state)):
        numpy.save(folder / "bake" / "streams" / f"{name}.npy", stream)
        with open(folder / "bake" / "streams" / f"{name}.pc2", "wb") as file:
            file.write(struct.pack("<12siiffi", b"POINTCACHE2\0", 1, 40, 1.0, 1.0, 40) + stream.tobytes())
    with open(folder / "bake" / "agents.csv", "w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["id", "group", "radius", "variation", "spawn_frame"])
        table.writerows([row, "walkers", 0.16 if row % 6 == 0 else 0.24, row % 12, 0] for row in range(40))
    return result_of(blender(HERE / "check_near.py", ADDON, folder / "bake", folder,
                             environment={"THRONG_BODIES": str(bodies)}))


def test_imports_bend_who_is_near(seen):
    assert seen["by default"] == [True, 3]
    assert len(seen["bent"]) > 10 and len(seen["instanced"]) > 5, "some are near, some are not"
    assert not set(seen["bent"]) & set(seen["instanced"]), "nobody is there twice"
    assert {BLENDS, SHUFFLES} <= set(seen["bent"])


def test_bent_people_have_the_pose_of_the_moment(seen):
    off = {int(row): value for row, value in seen["off"].items()}
    shuffles = off.pop(SHUFFLES)
    assert max(off.values()) < 4e-3, off
    assert shuffles < 0.05, "half a stand and half a walk: bones turn where vertices, blended, would go straight"


def test_bent_people_follow_the_ground(seen):
    assert seen["leaning"] < 4e-3


def test_bent_people_keep_their_tint_and_materials(seen):
    assert seen["tints"] < 1e-6 and seen["materials"] > 5


def test_velocities_are_what_vertices_do(seen):
    walking, median, most = seen["velocities"]
    assert walking > 8 and median < 0.08 and most < 0.6, seen["velocities"]
    assert not seen["blurs on screen"], "it would take time for nothing"


def test_where_there_are_too_many_the_nearest_are_bent(seen):
    count, furthest, nearest_other = seen["few"]
    assert 1 <= count <= 5 and furthest < nearest_other and seen["all are there"]


def test_on_the_screen_who_is_far_away_takes_the_coarsest_poses(seen):
    on_screen = seen["picked on screen"]
    assert {distance > 30.0 for distance, _ in on_screen} == {False, True}
    assert all(level == (2 if distance > 30.0 else 1) for distance, level in on_screen)
    for name in ("picked as rendered", "picked whole"):
        assert len(seen[name]) == len(on_screen) and {level for _, level in seen[name]} == {1}, name


def test_on_the_screen_meshes_are_coarser_further_away(seen):
    levels = []
    for distance, count, by_level in seen["on screen"]:
        level = (distance > 4.5) + (distance > 9.0)
        assert count == by_level[level] and by_level[0] > by_level[1] > by_level[2], (distance, count, by_level)
        levels.append(level)
    assert len(levels) == len(seen["bent"]) and len(set(levels)) > 1, "the scene has some of two levels"


def test_overrides_hold_for_them(seen):
    assert abs(seen["scaled"] - 1.25) < 0.01


def test_saved_scenes_bend_without_the_add_on(seen):
    assert seen["saved"] is not False and seen["saved"] < 1e-5


def test_bending_goes_away_again(seen):
    assert seen["levels stay"] == 3, "all others take the coarser meshes"
    bent, instanced, levels = seen["none"]
    assert bent == 0 and instanced == len(seen["bent"]) + len(seen["instanced"]) and levels == 1
    assert seen["nothing is left"]


def test_members_without_bones_are_not_bent_among_those_who_have(seen):
    before, bent, instanced = seen["without bones"]
    assert 2 in before and bent == [each for each in before if each < 2] and 2 in instanced


def test_people_without_bones_are_not_bent(seen):
    assert seen["plain"][0] is False and "Nobody here has bones" in seen["plain"][1]
    assert "has no camera" in seen["no camera"]
