# SPDX-License-Identifier: Apache-2.0
"""Feet of people with skeletons: they stay where they came down, and on the ground of slopes and stairs. Joints are
those that USD's own library finds; when a foot is down, the gait tells."""
import numpy
import pytest
import shapely

import throng_io
from conftest import EXAMPLES
from throng_io import cli
from throng_io.bakes.surroundings import terrain_of
from throng_io.cast import gait
from throng_io.skinned import legs, members, motions
from throng_io.skinned.ground import Ground
from usd_people import Usd, joints_of, people_of

MOST = 6


@pytest.fixture(scope="module")
def made(throng, once, bodies):
    """(the bake, its stage) of an example."""
    def of(name, *more):
        def make(folder):
            throng_io.bake(EXAMPLES / f"{name}.json", folder / "bake", program=throng.binary,
                           settings={"simulation.duration": 5}, options=["--feet", "--no-gltf"])
            with pytest.MonkeyPatch.context() as patch:
                patch.setenv("THRONG_BODIES", str(bodies))
                assert cli.main(["export-usd", str(folder / "bake"), "-o", str(folder / "crowd.usdc"), "--bare",
                                 "--skeletons", "--most", str(MOST), *more]) == 0

        folder = once(f"python-feet-{name}", make)
        return throng_io.Bake(folder / "bake"), Usd.Stage.Open(str(folder / "crowd.usdc"))
    return of


def steps_of(bake, stage):
    """Of each step of somebody who walks: where ankle and ball are, in the frames in which the sole is flat."""
    strides = members.repertoire_of(bake).strides
    for row, prim in people_of(stage).items():
        frames = numpy.nonzero(bake.there()[:, row])[0]
        joints, state = joints_of(prim, frames + 1), numpy.array(bake.state[frames, row], float)
        gaits = [gait.gait_of(strides[number]) for number in
                 motions.walks_of(members.repertoire_of(bake), state).gait]
        walks = bake.stream("carriage")[frames, row, 0] > 0.95
        for side, half in (("l", 0.5), ("r", 0.0)):
            since = numpy.array([(phase + half - each.down) % 1.0 for phase, each in zip(state[:, 2], gaits)])
            flat = walks & [each.flat_from <= share < each.flat_until for share, each in zip(since, gaits)]
            edges = numpy.nonzero(numpy.diff(flat.astype(int), prepend=0, append=0))[0]
            for first, last in zip(edges[::2], edges[1::2]):
                if last - first >= 4:
                    yield tuple(joints[f"{name}_{side}"][first:last] for name in ("foot", "ball"))


def lifted(steps):
    """Those in which the foot leaves the ground although the gait has it flat: somebody pushed puts it elsewhere."""
    return numpy.array([numpy.ptp(ankle[:, 2]) > 0.02 for ankle, _ in steps])


def slid(steps):
    return numpy.array([numpy.linalg.norm(ankle[:, :2] - ankle[0, :2], axis=1).max() for ankle, _ in steps])


def test_planted_feet_stay_where_they_came_down(made):
    found = slid(steps_of(*made("intersection")))
    assert len(found) > 40 and numpy.median(found) < 0.005 and numpy.quantile(found, 0.98) < 0.01, found


def test_feet_stand_on_slopes_and_stairs(made):
    bake, stage = made("hill")
    steps = list(steps_of(bake, stage))
    elsewhere = lifted(steps)
    assert len(steps) > 40 and elsewhere.mean() < 0.05
    assert numpy.quantile(slid(steps)[~elsewhere], 0.98) < 0.01
    triangles = terrain_of(bake).points[numpy.array(terrain_of(bake).faces)]
    tree = shapely.STRtree(shapely.polygons(triangles[:, :, :2]))

    def over(point):
        """How high over the highest ground there."""
        heights = []
        for a, b, c in triangles[tree.query(shapely.Point(point[:2]), predicate="intersects")]:
            normal = numpy.cross(b - a, c - a)
            if abs(normal[2]) > 1e-9:
                heights.append(a[2] - (normal[:2] @ (point[:2] - a[:2])) / normal[2])
        return point[2] - max(heights)

    ankles, balls = (numpy.array([over(each[number][len(each[number]) // 2]) for each in steps]) for number in (0, 1))
    off = numpy.abs(ankles - numpy.median(ankles))
    assert numpy.median(off) < 0.006 and numpy.quantile(off, 0.95) < 0.02, off  # shoes differ
    assert 0.07 < numpy.median(ankles) < 0.11
    treads = numpy.abs(balls - numpy.median(balls)) < 0.02  # others stick out over the edge of a tread
    assert treads.mean() > 0.85


def test_on_a_slope_ground_is_told_and_the_nearest_floor_counts():
    def square(height, slope):
        a, b, c, d = ([x, y, height + slope * x] for x, y in ((0, 0), (4, 0), (4, 4), (0, 4)))
        return [[a, b, c], [a, c, d]]

    riser = [[[2, 0, 0], [2, 4, 0], [2, 4, 3]]]
    ground = Ground(numpy.array(square(0.0, 0.5) + square(3.0, 0.0) + riser, float))
    heights, slopes = ground.under(numpy.array([[1.0, 1.0, 0.4], [2.0, 3.0, 2.9], [9.0, 9.0, 0.0], [1.0, 1.0, 1.8]]))
    assert heights[:2] == pytest.approx([0.5, 3.0]) and numpy.isnan(heights[2:]).all()
    assert slopes[:2] == pytest.approx(numpy.array([[0.5, 0.0], [0.0, 0.0]]))


def leg_of_sticks(count):
    """Names, places, and poses of a pelvis and two legs that stand straight up."""
    names, places = ["pelvis"], [[0, 0, 1.0]]
    for side, y in (("l", 0.1), ("r", -0.1)):
        names += [f"{name}_{side}" for name in ("thigh", "calf", "foot", "ball")]
        places += [[0, y, 0.95], [0.02, y, 0.5], [0, y, 0.08], [0.15, y, 0.02]]
    matrices = numpy.tile(numpy.concatenate([numpy.eye(3), numpy.zeros((3, 1))], axis=1), (count, len(names), 1, 1))
    return names, numpy.array(places), matrices


def ends(matrices, places):
    return numpy.einsum("fjab,jb->fja", matrices[..., :3], places) + matrices[..., 3]


def test_legs_reach_what_they_can_and_bodies_sink():
    names, places, matrices = leg_of_sticks(3)
    feet = numpy.zeros((3, 3))
    feet[1] = [0.2, 0.05, numpy.floor(0.3 * 512) + 0.04]   # forward, left, turned by 0.3 rad, lifted by 4 cm
    feet[2] = [0.48, 0.0, 0.0]                              # further than the leg reaches
    streams = {"state": numpy.zeros((3, 3)), "left_foot": feet, "right_foot": numpy.zeros((3, 3)),
               "pos": numpy.zeros((3, 3)), "dir": numpy.tile([1.0, 0, 0], (3, 1))}
    flat = legs.Stances(numpy.ones((3, 2), bool), numpy.ones((3, 2), bool))
    found = legs.held(matrices, places, names, legs.footing_of(streams), flat)
    joints = ends(found, places)
    assert numpy.abs(joints[0] - places).max() < 2e-3       # as it was
    foot, ball, thigh, calf = (names.index(f"{name}_l") for name in ("foot", "ball", "thigh", "calf"))
    assert joints[1, foot] == pytest.approx([0.2, 0.15, 0.12], abs=1e-6)
    ahead = joints[1, ball] - joints[1, foot]
    assert numpy.arctan2(ahead[1], ahead[0]) == pytest.approx(numpy.floor(0.3 * 512) / 512)
    for frame in (1, 2):
        for one, other in ((thigh, calf), (calf, foot)):
            assert numpy.linalg.norm(joints[frame, one] - joints[frame, other]) == pytest.approx(
                numpy.linalg.norm(places[one] - places[other]), abs=1e-9)
        assert joints[frame, calf, 0] > 0.5 * (joints[frame, thigh, 0] + joints[frame, foot, 0])  # knees bend ahead
    assert 0.05 < 1.0 - joints[2, 0, 2] <= legs.SINKS        # the pelvis
    assert joints[2, foot] == pytest.approx([0.48, 0.1, 0.08], abs=2e-3)
    assert joints[2, names.index("foot_r")] == pytest.approx([0.0, -0.1, 0.08], abs=1e-6)  # the other one stays


def test_soles_are_turned_to_the_slope():
    names, places, matrices = leg_of_sticks(1)
    streams = {"state": numpy.zeros((1, 3)), "ground": numpy.array([[0.4, 0.2, 0.0]]), "pos": numpy.zeros((1, 3)),
               "dir": numpy.array([[1.0, 0, 0]])}
    flat = legs.Stances(numpy.ones((1, 2), bool), numpy.ones((1, 2), bool))
    found = legs.held(matrices, places, names, legs.footing_of(streams), flat)
    for side, y in (("l", 0.1), ("r", -0.1)):
        joint = names.index(f"foot_{side}")
        for x in (-0.05, 0.0, 0.18):                        # of the sole
            point = found[0, joint, :, :3] @ [x, y, 0.0] + found[0, joint, :, 3]
            assert point[2] == pytest.approx(0.4 * point[0] + 0.2 * point[1], abs=1e-6)


def test_ground_below_a_step_is_not_what_one_stands_on():
    names, places, matrices = leg_of_sticks(2)
    corners = [[-9, -9], [9, -9], [9, 9], [-9, 9]]
    flat = legs.Stances(numpy.ones((2, 2), bool), numpy.ones((2, 2), bool))
    for below, goes in ((0.1, 0.1), (0.4, 0.0)):
        a, b, c, d = ([x, y, -below] for x, y in corners)
        streams = {"state": numpy.zeros((2, 3)), "ground": numpy.zeros((2, 3)), "pos": numpy.zeros((2, 3)),
                   "dir": numpy.tile([1.0, 0, 0], (2, 1))}
        footing = legs.footing_of(streams, 1.0, Ground(numpy.array([[a, b, c], [a, c, d]], float)))
        joints = ends(legs.held(matrices, places, names, footing, flat), places)
        assert joints[0, names.index("foot_l"), 2] == pytest.approx(0.08 - goes, abs=2e-3)


def test_without_feet_and_terrain_nothing_changes():
    assert legs.footing_of({"state": numpy.zeros((2, 3))}) is None
