# SPDX-License-Identifier: Apache-2.0
"""Levels of detail in a real Blender: everybody's by their distance to the camera, and none again."""
import math

import pytest

import expected_poses
from results import ADDON, HERE, result_of
from sample_bake import write_bake
from throng import cast


GAITS = (1, 3)
REPERTOIRE = cast.Repertoire.of(expected_poses.REPERTOIRE.strides, GAITS)
EDGES = (9.5, 18.5)  # m: where check_levels.py begins the coarser levels


@pytest.fixture(scope="module")
def seen(blender, tmp_path_factory):
    """(what check_levels.py has seen, the bake's pos, dir, state)."""
    folder = tmp_path_factory.mktemp("levels")
    streams = write_bake(folder / "bake", agents=400, variations=cast.VARIATIONS, gaits=GAITS)
    return result_of(blender(HERE / "check_levels.py", ADDON, folder / "bake", folder)), *streams


def test_coarser_figures_come_and_go(seen):
    found = seen[0]
    assert found["lists"] in (1, cast.VARIATIONS // 4), "of all poses, or of those of four people each"
    # of everybody the figure and its sheet of poses, and these lists, as objects and as meshes
    once = 2 * cast.VARIATIONS + found["lists"]
    all_ = cast.LEVELS * once - (found["lists"] - 1)  # the coarsest level's is one list everywhere
    assert found["sizes"] == [[once] * 2, [once] * 2, [all_] * 2] and found["after"] == [once] * 2
    assert found["off"] == found["before"] and not any("_l" in name for name in found["off"].values())
    assert len([name for name in found["trees"] if name.startswith("Throng instancer")]) == 1
    assert found["farm"] == found["shots"][1][3]


def test_distances_are_by_the_size_in_the_picture_unless_told(seen):
    """A person of 1.75 m is 120 and 40 pixels tall there: the sensor is 36 mm wide, the picture 1920 x 1080."""
    found = seen[0]
    pixels = [1.75 / distance * found["lens"] / 36.0 * 1920.0 for distance in found["defaults"]]
    assert pixels == pytest.approx([120.0, 40.0], rel=1e-3)
    assert "perspective" in found["ortho"] and "nearer" in found["order"]


def test_levels_follow_the_camera(seen):
    found, pos, direction, state = seen
    levels = set()
    for frame, sub, camera, people in found["shots"]:
        assert len(people) > 300
        t = frame + sub - 1.0
        low, near = math.floor(t), int(math.floor(t + 0.5))
        for row, name in ((int(row), name) for row, name in people.items()):
            at = pos[low, row] * (1.0 - (t - low)) + pos[min(low + 1, 39), row] * (t - low)
            distance = math.dist(at, camera)
            if min(abs(distance - edge) for edge in EDGES) < 1e-3:
                continue
            level = sum(distance > edge for edge in EDGES)
            levels.add(level)
            assert expected_poses.is_expected(name, state[near], direction[low], row, near + 1, level,
                                              REPERTOIRE), (frame, sub, row, distance)
    assert levels == {0, 1, 2}


def test_while_the_shutter_is_open_the_level_changes_only_for_who_crosses_a_distance(seen):
    found, pos, _, _ = seen
    times = ((25, 0.0), (24, 0.76), (25, 0.24))
    middle, opened, closed = (people for frame, sub, _, people in found["shots"] if (frame, sub) in times)
    cameras = [camera for frame, _, camera, _ in found["shots"] if frame in (24, 25)]  # it goes 2.5 m a frame here
    changed = [row for row in middle if {opened[row], closed[row]} != {middle[row]}]
    for row in changed:
        distances = [math.dist(pos[24, int(row)], camera) for camera in cameras]
        assert any(min(distances) - 0.1 < edge < max(distances) + 0.1 for edge in EDGES)
    assert 0 < len(changed) < 0.2 * len(middle)
