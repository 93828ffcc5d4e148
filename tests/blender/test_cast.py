# SPDX-License-Identifier: Apache-2.0
"""The walkers, without Blender: planted feet, sane bodies, different people."""
import math
import pathlib
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "blender_addon"))
from throng import cast  # noqa: E402
from throng.cast import gait, people  # noqa: E402

STRIDES = tuple(1.446 * 1.28 ** k for k in range(-3, 3))  # shaders/gait.glsl
GAITS = [gait.gait_of(stride) for stride in STRIDES]


def contact_point(foot, build):
    """Where the planted part of a foot touches the ground, in the walker's frame."""
    offset = {"heel": -build.heel, "ball": build.ball, "flat": 0.0}[foot.planted]
    c, s = math.cos(foot.pitch), math.sin(foot.pitch)
    return foot.ankle[0] + offset * c + build.ankle * s, foot.ankle[1] + offset * s - build.ankle * c


@pytest.mark.parametrize("walked", GAITS, ids=lambda g: f"{g.stride:.2f}m")
@pytest.mark.parametrize("person", people.CAST, ids=range(len(people.CAST)))
def test_planted_feet_do_not_slide(person, walked):
    build = people.build_of(person)
    anchors = {}
    for index in range(1000):
        phase = walked.down + index / 1000.0
        foot = gait.foot_at(phase, build, walked)
        if not foot.planted:
            continue
        x, z = contact_point(foot, build)
        assert abs(z) < 1e-6, "on the ground"
        anchors.setdefault(foot.planted, []).append(x + phase * walked.stride)  # where it is in the world while the body walks on
    assert set(anchors) == {"heel", "flat", "ball"}
    for part, places in anchors.items():
        assert max(places) - min(places) < 0.02, f"{part} slides"


def test_a_change_of_stride_leaves_the_foot_under_the_body_where_it_is():
    build = gait.Build()
    for phase in (gait.UNDER_BODY, gait.UNDER_BODY + 0.5):
        places = [gait.foot_at(phase if phase < 0.5 else phase - 0.5, build, each).ankle for each in GAITS]
        assert all(math.dist(place, (0.0, build.ankle)) < 1e-6 for place in places)


@pytest.mark.parametrize("walked", GAITS, ids=lambda g: f"{g.stride:.2f}m")
def test_the_foot_path_has_no_jumps(walked):
    build = gait.Build()
    before = gait.foot_at(0.0, build, walked)
    for index in range(1, 2001):
        foot = gait.foot_at(index / 2000.0, build, walked)
        assert math.hypot(foot.ankle[0] - before.ankle[0], foot.ankle[1] - before.ankle[1]) < 0.01
        before = foot


@pytest.mark.parametrize("walked", GAITS, ids=lambda g: f"{g.stride:.2f}m")
def test_walkers_always_have_a_foot_on_the_ground_and_runners_fly(walked):
    build = gait.Build()
    flying = 0
    for index in range(200):
        pair = gait.foot_at(index / 200.0, build, walked), gait.foot_at(index / 200.0 + 0.5, build, walked)
        flying += not (pair[0].planted or pair[1].planted)
        assert all(foot.ankle[1] > 0.05 for foot in pair)
    assert (flying > 20) == walked.runs and (flying == 0) != walked.runs


@pytest.mark.parametrize("walked", GAITS, ids=lambda g: f"{g.stride:.2f}m")
@pytest.mark.parametrize("person", people.CAST, ids=range(len(people.CAST)))
def test_knees_bend_forwards_and_legs_keep_their_length(person, walked):
    build = people.build_of(person)
    for index in range(48):
        pose = gait.walk_pose(index / 48.0, build, walked)
        for foot in (foot for foot in pose.feet if foot.planted):
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
    counts = {len(people.build_figure(people.CAST[1], gait.walk_pose(index / 24.0, build, GAITS[3])).vertices) for index in range(24)}
    assert len(counts) == 1


@pytest.mark.parametrize("walked", GAITS, ids=lambda g: f"{g.stride:.2f}m")
def test_the_pelvis_goes_up_and_down_as_peoples_does(walked):
    build = gait.Build()
    heights = [gait.walk_pose(index / 96.0, build, walked).pelvis[2] for index in range(96)]
    # Murray 1964: 5 cm at comfortable speed, less when slower; runners up to 11 cm (Novacheck 1998).
    assert 0.005 < max(heights) - min(heights) < (0.11 if walked.runs else 0.075)
    steps = [abs(b - a) for a, b in zip(heights, heights[1:] + heights[:1])]
    assert max(steps) < 0.015, "no jumps"


def test_standing_clips_differ_and_come_round():
    build = gait.Build()
    for clip in gait.STANDING_CLIPS:
        beats = [gait.standing_pose(clip, beat / 4.0, build) for beat in range(4)]
        assert len({str(pose) for pose in beats}) >= 3
    assert len({str(gait.standing_pose(clip, 0.0, build).arms) for clip in gait.STANDING_CLIPS}) == len(gait.STANDING_CLIPS)


def test_a_repertoire_numbers_gaits_first_and_standing_clips_after():
    repertoire = cast.Repertoire(STRIDES)
    assert repertoire.walking_pose(0, 0.0) == 0 and repertoire.walking_pose(2, 7.999) == 3 * cast.POSES - 1
    assert repertoire.standing_pose("phone", 3) == repertoire.count - 1
    poses = cast.poses_of(people.CAST[0], repertoire)
    assert len(poses) == repertoire.count
