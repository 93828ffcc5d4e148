# SPDX-License-Identifier: Apache-2.0
"""The walkers, without Blender: planted feet, sane bodies, different people."""
import math
import pathlib
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "blender_addon"))
from throng.cast import gait, people  # noqa: E402

STRIDE = 1.4


def contact_point(foot, build):
    """Where the planted part of a foot touches the ground, in the walker's frame."""
    offset = {"heel": -build.heel, "ball": build.ball, "flat": 0.0}[foot.planted]
    c, s = math.cos(foot.pitch), math.sin(foot.pitch)
    return foot.ankle[0] + offset * c + build.ankle * s, foot.ankle[1] + offset * s - build.ankle * c


@pytest.mark.parametrize("person", people.CAST, ids=range(len(people.CAST)))
def test_planted_feet_do_not_slide(person):
    build = people.build_of(person)
    anchors = {}
    for index in range(1000):
        phase = index / 1000.0
        foot = gait.foot_at(phase, build, STRIDE)
        if not foot.planted:
            continue
        x, z = contact_point(foot, build)
        assert abs(z) < 1e-6, "on the ground"
        anchors.setdefault(foot.planted, []).append(x + phase * STRIDE)  # where it is in the world while the body walks on
    assert set(anchors) == {"heel", "flat", "ball"}
    for part, places in anchors.items():
        assert max(places) - min(places) < 0.02, f"{part} slides"


def test_the_foot_path_has_no_jumps():
    build = gait.Build()
    before = gait.foot_at(0.0, build, STRIDE)
    for index in range(1, 2001):
        foot = gait.foot_at(index / 2000.0, build, STRIDE)
        assert math.hypot(foot.ankle[0] - before.ankle[0], foot.ankle[1] - before.ankle[1]) < 0.01
        before = foot


def test_a_foot_is_on_the_ground_for_most_of_the_cycle_and_one_always_is():
    build = gait.Build()
    for index in range(200):
        phase = index / 200.0
        pair = gait.foot_at(phase, build, STRIDE), gait.foot_at(phase + 0.5, build, STRIDE)
        assert pair[0].planted or pair[1].planted
        assert all(foot.ankle[1] > 0.05 for foot in pair)


@pytest.mark.parametrize("person", people.CAST, ids=range(len(people.CAST)))
def test_knees_bend_forwards_and_legs_keep_their_length(person):
    build = people.build_of(person)
    for index in range(48):
        pose = gait.walk_pose(index / 48.0, build, STRIDE)
        for foot in pose.feet:
            hip = (pose.pelvis[0], pose.pelvis[2])
            knee = gait.knee_of(hip, foot.ankle, build)
            assert abs(math.dist(hip, knee) - build.thigh) < 1e-6
            assert abs(math.dist(knee, foot.ankle) - build.shank) < 0.02
            along = (foot.ankle[0] - hip[0], foot.ankle[1] - hip[1])
            assert along[0] * (knee[1] - hip[1]) - along[1] * (knee[0] - hip[0]) >= -1e-6


def test_figures_stand_on_the_ground_and_are_as_tall_as_they_should_be():
    sizes = set()
    for person in people.CAST:
        build = people.build_of(person)
        mesh = people.build_figure(person, gait.idle_pose(build))
        heights = [v[2] for v in mesh.vertices]
        assert -0.02 < min(heights) < 0.03
        assert abs(max(heights) - person.height) < 0.10
        assert len(mesh.faces) == len(mesh.materials) < 2500
        assert max(mesh.materials) < len(people.MATERIALS)
        sizes.add((len(mesh.vertices), round(max(heights), 2)))
    assert len(sizes) == len(people.CAST), "eight different people"


def test_all_poses_of_a_person_have_the_same_vertices():
    build = people.build_of(people.CAST[1])
    counts = {len(people.build_figure(people.CAST[1], gait.walk_pose(index / 24.0, build, STRIDE)).vertices) for index in range(24)}
    assert len(counts) == 1
