# SPDX-License-Identifier: Apache-2.0
"""The walkers, without Blender: planted feet, sane bodies, different people."""
import math

import pytest

import results  # noqa: F401  it puts the add-on on the path
from throng import cast
from throng.cast import gait, people
from throng.cast.figure import Figure, build_figure
from throng.cast.mesh_builder import MeshBuilder, Plan, add, cross, mix, ring, scale, sub, unit

STRIDES = tuple(1.446 * 1.28 ** k for k in range(-3, 3))  # as of `throng bake`
GAITS = [gait.gait_of(stride) for stride in STRIDES]
REPERTOIRE = cast.Repertoire(STRIDES)
LEVELS = range(cast.LEVELS)


@pytest.fixture(scope="module")
def figures():
    """All poses of everybody."""
    return [[build_figure(person, pose) for pose in cast.poses_of(person, REPERTOIRE)] for person in people.CAST]


@pytest.fixture(scope="module")
def plans(figures):
    return [[cast.plan_of(poses, REPERTOIRE, level) for level in LEVELS] for poses in figures]


def points_of(plan, figure):
    return [tuple(point) for point in plan.vertices(figure.rings).tolist()]


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
        # where it is in the world while the body walks on
        anchors.setdefault(foot.planted, []).append(x + phase * walked.stride)
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


def test_all_poses_at_all_levels_stand_on_the_ground(figures, plans):
    for person, poses, levels in zip(people.CAST, figures, plans):
        for level, plan in enumerate(levels):
            for index in REPERTOIRE.sources(level):
                lowest = plan.vertices(poses[index].rings)[:, 2].min()
                flies = index < REPERTOIRE.walking() and GAITS[index // cast.POSES].runs
                assert -0.006 < lowest < (0.20 if flies else 0.012), (person, level, index)


def test_people_are_as_tall_as_they_should_be_and_look_forward(figures, plans):
    for person, poses, levels in zip(people.CAST, figures, plans):
        stands = points_of(levels[0], poses[REPERTOIRE.walking()])
        assert abs(max(z for _, _, z in stands) - person.height * math.cos(person.stoop) ** 0.5) < 0.09, person
        assert len(levels[0].faces) == len(levels[0].materials) and max(levels[0].materials) < len(people.MATERIALS)
        toes = max(x for x, _, z in stands if z < 0.05)
        assert 0.12 < toes < 0.30


def outline_of(points):
    """Where the silhouettes from the side and from the front begin and end in each tenth of the height."""
    top = max(z for _, _, z in points)
    found = []
    for axis in (0, 1):
        for tenth in range(10):
            slice_ = [p[axis] for p in points if tenth - 1.0 <= 10.0 * p[2] / top <= tenth + 2.0]
            found += [min(slice_), max(slice_)]
    return [top, *found]


def test_no_two_people_have_the_same_silhouette(figures, plans):
    outlines = [outline_of(points_of(levels[0], poses[REPERTOIRE.walking()])) for poses, levels in zip(figures, plans)]
    assert len(outlines) >= 10
    for i, one in enumerate(outlines):
        for other in outlines[:i]:
            assert max(abs(a - b) for a, b in zip(one, other)) > 0.025, "somebody is there twice"


def test_coarser_levels_have_a_third_and_an_eighth_of_the_triangles(plans):
    for full, middle, far in plans:
        assert 1300 < full.triangles < 2300
        assert 0.25 * full.triangles < middle.triangles < 0.46 * full.triangles
        assert 0.08 * full.triangles < far.triangles < 0.18 * full.triangles


@pytest.mark.parametrize("level, most", [(1, 0.03), (2, 0.06)])
def test_silhouettes_hardly_change_between_levels(figures, plans, level, most):
    """How far the finest skin's points lie outside of the bounds of a coarser one, and the other way round,
    part by part of the body."""
    for poses, levels in zip(figures, plans):
        for index in (1, 2 * cast.POSES + 7, 3 * cast.POSES + 13, REPERTOIRE.walking()):
            fine, coarse = points_of(levels[0], poses[index]), points_of(levels[level], poses[index])
            for axis in range(3):
                for end in (min, max):
                    assert abs(end(p[axis] for p in fine) - end(p[axis] for p in coarse)) < most


def beyond(point, a, b):
    """How far a point is to the right of a line, m."""
    away = (point[0] - a[0]) * (b[1] - a[1]) - (point[1] - a[1]) * (b[0] - a[0])
    return away / (math.dist(a[:2], b[:2]) or 1.0)


def outside(cloth, point):
    """How far a point sticks out of rings of points, m; none where it is above or below them."""
    for upper, lower in zip(cloth, cloth[1:]):
        high, low = (sum(p[2] for p in points) / len(points) for points in (upper, lower))
        if low + 0.01 < point[2] <= high:
            polygon = [mix(a, b, (point[2] - low) / (high - low)) for a, b in zip(lower, upper)]
            edges = zip(polygon, polygon[1:] + polygon[:1])
            return max(beyond(point, a, b) for a, b in edges)
    return None


def skin_of(upper, lower, radii):
    """Points all round a limb."""
    axis = unit(sub(lower, upper))
    across = unit(cross((0.0, 1.0, 0.0), axis))
    other = cross(axis, across)
    for share, radius in radii:
        for step in range(12):
            angle = step * math.pi / 6.0
            yield add(mix(upper, lower, share),
                      add(scale(across, radius * math.cos(angle)), scale(other, radius * math.sin(angle))))


def along(profile, step=0.04):
    """A limb's radius every so often along it, and at its ends."""
    for (share, radius), (later, wider) in zip(profile, profile[1:]):
        count = max(1, round((later - share) / step))
        yield from ((share + (later - share) * k / count, radius + (wider - radius) * k / count) for k in range(count))
    yield profile[-1]


DRAPED = [index for index, person in enumerate(people.CAST) if person.top != "shirt" or person.bottom == "skirt"]


def gaps(cloth, points):
    """How far those of some points stick out of a cloth that are beside it, m."""
    return [gap for gap in (outside(cloth, point) for point in points) if gap is not None]


@pytest.mark.parametrize("index", DRAPED)
def test_legs_stay_inside_of_skirts_coats_and_hems_and_hands_outside(index):
    person = people.CAST[index]
    legs, hands = {False: -1.0, True: -1.0}, 1.0
    for number, pose in enumerate(cast.poses_of(person, REPERTOIRE)):
        figure = Figure(person, pose, people.build_of(person))
        assert figure.skirts
        runs = 4 * cast.POSES <= number < REPERTOIRE.walking()
        palms = [add(wrist, scale(unit(sub(wrist, elbow)), 0.09 * figure.s)) for _, elbow, wrist in figure.arms]
        for cloth in figure.skirts:
            for upper, lower, profile in figure.leg_limbs:
                legs[runs] = max([legs[runs], *gaps(cloth, skin_of(upper, lower, list(along(profile))))])
            if not runs:
                hands = min([hands, *gaps(cloth, palms)])
    assert legs[False] < 0.006 and legs[True] < 0.025, legs
    assert hands > 0.008, hands  # half as thick as they are


def test_a_levels_rings_keep_to_the_tolerance(figures):
    """Known answer: a straight tube needs its ends only, a bent one its bend."""
    builder = MeshBuilder()
    builder.loft([ring((0.0, 0.0, z), (1, 0, 0), (0, 1, 0), 0.1, 0.1) for z in (0.0, 0.3, 0.6, 1.0)], 0, 8,
                 caps=(False, False))
    builder.loft([ring((x, 0.0, z), (1, 0, 0), (0, 1, 0), 0.1, 0.1) for x, z in ((0.0, 0.0), (0.2, 0.5), (0.0, 1.0))],
                 0, 8, caps=(False, False))
    plan = Plan(builder.parts, [builder.rings], 1)
    assert plan.count == 2 * 5 + 3 * 5 and plan.triangles == 2 * 5 * 3


@pytest.mark.parametrize("level", LEVELS)
def test_soles_do_not_slide_within_a_gait_at_any_level(figures, plans, level):
    """From the meshes: while a foot is flat, its sole's lowest points stay where they are on the ground
    while the body walks on."""
    for person, poses, levels in zip(people.CAST, figures, plans):
        build = people.build_of(person)
        for which, walked in enumerate(GAITS):
            places = []
            first = which * cast.LEVEL_POSES[level]
            for position, index in enumerate(REPERTOIRE.sources(level)[first:first + cast.LEVEL_POSES[level]]):
                phase = (index % cast.POSES) / cast.POSES
                if gait.foot_at(phase, build, walked).planted != "flat":
                    continue
                assert REPERTOIRE.walking_pose(which, phase, level) == first + position
                sole = [p for p in points_of(levels[level], poses[index])
                        if p[2] < 0.012 and p[1] < 0.0 and abs(p[1]) < 0.16]
                places.append(max(x for x, _, _ in sole) + phase * walked.stride)
            assert places or level == 2
            assert not places or max(places) - min(places) < 0.012, (person, walked.stride)


def test_runners_are_not_crouched():
    """At the middle of stance a runner's knee is bent by some 40 to 55 degrees, walkers' less."""
    build = gait.Build()
    for walked in GAITS[2:]:
        pose = gait.walk_pose(gait.UNDER_BODY, build, walked)
        hip, ankle = (pose.pelvis[0], pose.pelvis[2] - gait.HIP_DROP), pose.feet[0].ankle
        reach = math.dist(hip, ankle) / (build.thigh + build.shank)
        bent = math.degrees(2.0 * math.acos(min(1.0, reach)))
        assert bent < 56.0, walked.stride
        if not walked.runs and walked.stride < 1.5:
            assert bent < 40.0


def test_all_poses_of_a_person_have_the_same_parts(figures):
    for poses in figures:
        assert all(figure.parts == poses[0].parts for figure in poses[1:])


def test_limbs_move_as_fast_as_the_next_pose_says():
    before, after = [0.0, 0.0, 0.0, 1.0, 1.0, 1.0], [0.1, 0.0, 0.0, 1.0, 1.2, 0.7]
    assert cast.limb_velocities(before, after, 0.1) == pytest.approx([1.0, 0.0, 0.0, 0.0, 2.0, -3.0])


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
    arms = {str(gait.standing_pose(clip, 0.0, build).arms) for clip in gait.STANDING_CLIPS}
    assert len(arms) == len(gait.STANDING_CLIPS)


def test_a_repertoire_numbers_gaits_first_and_standing_clips_after():
    assert REPERTOIRE.walking_pose(0, 0.0) == 0 and REPERTOIRE.walking_pose(2, 7.999) == 3 * cast.POSES - 1
    for level in LEVELS:
        assert REPERTOIRE.standing_pose("phone", 3, level) == REPERTOIRE.poses(level) - 1
        sources = REPERTOIRE.sources(level)
        assert len(sources) == REPERTOIRE.poses(level)
        for index in range(REPERTOIRE.walking()):  # whoever is at a pose shows the coarser one that it belongs to
            which, phase = divmod(index, cast.POSES)
            coarse = sources[REPERTOIRE.walking_pose(which, phase / cast.POSES, level)]
            assert abs(coarse - index) <= cast.POSES // cast.LEVEL_POSES[level] // 2 and coarse // cast.POSES == which
    assert len(cast.poses_of(people.CAST[0], REPERTOIRE)) == REPERTOIRE.count
