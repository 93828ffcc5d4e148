# SPDX-License-Identifier: Apache-2.0
"""What hands hold, and who limps, without Blender."""
import pathlib
import sys

import numpy
import pytest

from conftest import ROOT

sys.path.insert(0, str(ROOT / "blender_addon"))
from throng import cast  # noqa: E402
from throng.cast import gait, skinning  # noqa: E402
from throng.people import holding, library, person, roster  # noqa: E402
from throng.people.parts import normals_of  # noqa: E402

WALK = gait.gait_of(1.4)


@pytest.fixture(scope="module")
def loaded(bodies):
    return library.load(pathlib.Path(bodies))


@pytest.fixture(scope="module")
def holders(loaded):
    """{thing: (maker, model)} of the first who holds it, at the finest level that crowds have."""
    found = {}
    for look in roster.LOOKS:
        for number in range(64):
            who = roster.draw_person(look, number)
            if who.holds and who.holds not in found:
                maker = person.Maker(loaded, who)
                found[who.holds] = maker, maker.model(0)
    return found


def walking(rig):
    return [gait.walk_pose(index / 12.0, rig.build, WALK) for index in range(12)]


def of_material(model, name):
    faces = model.faces[model.material_of == model.materials.index(name)]
    return numpy.unique(faces)


def test_hands_hold_things_that_suit_a_look():
    for look in roster.LOOKS:
        people = [roster.draw_person(look, number) for number in range(64)]
        held = [who.holds for who in people]
        assert all(not (who.holds and (who.stick or who.child)) for who in people)
        assert all(not (who.holds in holding.BAGS and who.bag in ("satchel", "shopper")) for who in people)
        assert (held.count("") == 64) == (look == "sport"), look
        assert ("case" in held) == (look == "business"), look
    assert all(not roster.Role(number, "casual", "runner").person().holds for number in range(32))
    limps = [roster.Role(number, "casual", "elderly").person().limp for number in range(64)]
    assert 1 <= sum(limp > 0.0 for limp in limps) <= 16 and max(limps) <= 1.0


def test_a_phone_is_before_the_eyes_or_at_the_ear(holders):
    for thing, (near, far) in {"phone": (0.24, 0.50), "call": (0.04, 0.16)}.items():
        maker, model = holders[thing]
        rig = maker.rig
        poses = walking(rig) + [gait.standing_pose("idle", 0.3, rig.build)]
        points, matrices = model.posed(poses), rig.all_matrices(poses)
        phone = points[:, of_material(model, "extra phone")].mean(axis=1)
        skull = 0.5 * (rig.heads["head"] + rig.tails["head"])
        head = matrices[:, rig.bodies.bone["head"]] @ numpy.append(skull, 1.0)
        away = numpy.linalg.norm(phone - head, axis=1) / rig.scale
        assert near < away.min() and away.max() < far, (thing, away)
        ahead = (phone - head)[:, 0]
        assert (ahead > 0.15).all() if thing == "phone" else (numpy.abs(ahead) < 0.12).all()


def test_the_screen_faces_the_eyes(holders):
    maker, model = holders["phone"]
    rig = maker.rig
    points = model.posed(walking(rig))
    phone = of_material(model, "extra phone")
    flat = points[:, phone] - points[:, phone].mean(axis=1, keepdims=True)
    across = numpy.linalg.svd(flat)[2][:, 2]  # the thinnest way
    eyes = points[:, of_material(model, "eyes")].mean(axis=1)
    way = eyes - points[:, phone].mean(axis=1)
    way /= numpy.linalg.norm(way, axis=1, keepdims=True)
    assert numpy.abs((across * way).sum(axis=1)).min() > 0.6, "within 53 degrees"


def test_who_runs_lets_the_arm_swing(holders):
    maker, _ = holders["phone"]
    rig, runs = maker.rig, gait.gait_of(2.4)
    wrists = [rig.matrices(gait.walk_pose(index / 8.0, rig.build, runs))[rig.bodies.bone["hand_r"]]
              @ numpy.append(rig.heads["hand_r"], 1.0) for index in range(8)]
    assert numpy.ptp(wrists, axis=0)[0] > 0.25


def inside_of(points, others, normals):
    """The share of points that are inside of others."""
    away = points[:, None] - others[None]
    near = (away ** 2).sum(axis=2).argmin(axis=1)
    away = away[numpy.arange(len(near)), near]
    return (((away * normals[near]).sum(axis=1) < -0.002) & ((away ** 2).sum(axis=1) < 0.06 ** 2)).mean()


@pytest.mark.parametrize("thing, material", [("case", "extra leather"), ("carrier", "extra paper")])
def test_bags_hang_upright_beside_the_legs(holders, loaded, thing, material):
    maker, model = holders[thing]
    rig, bones = maker.rig, numpy.array(loaded.bones)
    hangs = of_material(model, material)
    hangs = hangs[model.weights[hangs, loaded.bone["Root"]] > 0.99]
    legs = model.weights[:, numpy.char.startswith(bones, "thigh") | numpy.char.startswith(bones, "calf")].sum(axis=1)
    legs = legs > 0.5
    shares, poses = [], walking(rig) + [gait.standing_pose("shift", 0.0, rig.build)]
    assert (rig.all_matrices(poses)[:, loaded.bone["Root"], 2, 2] > 0.99).all(), "upright"
    for points in model.posed(poses):
        bag = points[hangs]
        assert bag[:, 2].min() > 0.05 and bag[:, 2].max() < 1.0
        shares.append(inside_of(bag, points[legs], normals_of(points, model.faces)[legs]))
    assert numpy.mean(shares) < 0.005


def test_who_limps_spares_a_leg_and_does_not_slide():
    build, lame = gait.Build(), gait.Build(limp=1.0)
    stance = lambda feet: sum(bool(foot.planted) for foot in feet) / len(feet)
    phases = [index / 100.0 for index in range(100)]
    right, left = zip(*(gait.walk_pose(phase, lame, WALK).feet for phase in phases))
    even = [gait.walk_pose(phase, build, WALK).feet[1] for phase in phases]
    assert stance(left) < stance(even) - 0.05 and stance(right) == pytest.approx(stance(even), abs=0.011)
    flat = [(phase, foot) for phase, foot in zip(phases, left) if foot.planted == "flat"]
    places = [foot.ankle[0] + (phase - (1.0 if phase > 0.5 else 0.0)) * WALK.stride for phase, foot in flat]
    assert numpy.ptp(places) < 1e-9, "what is planted stays where it is in the world"
    poses = [gait.walk_pose(phase, lame, WALK) for phase in phases]
    assert min(pose.tilt for pose in poses) < -0.09 and max(pose.tilt for pose in poses) == 0.0
    jumps = numpy.abs(numpy.diff([(*pose.pelvis, pose.tilt) for pose in (*poses, poses[0])], axis=0)).max()
    assert jumps < 0.012, "smooth round the cycle"
    assert gait.walk_pose(0.3, lame, gait.gait_of(2.4)) == gait.walk_pose(0.3, build, gait.gait_of(2.4))
    assert lame.scaled(0.5).limp == 1.0 and lame.scaled(0.5).thigh == 0.5 * build.thigh


def test_the_trunk_leans_over_the_leg_that_is_spared(loaded):
    who = next(who for who in (roster.Role(number, "casual", "elderly").person() for number in range(64)) if who.limp)
    rig = person.Maker(loaded, who).rig
    heads = numpy.array([rig.matrices(pose)[rig.bodies.bone["head"]] @ numpy.append(rig.heads["head"], 1.0)
                         for pose in walking(rig)])
    left = heads[[7, 8, 9], 1].mean()   # the left foot stands from 0.5 of the cycle on
    right = heads[[1, 2, 3], 1].mean()
    assert left > 0.02 and left > 1.5 * abs(right)


def test_all_are_bent_by_the_same_bones(holders, loaded):
    repertoire = cast.Repertoire.of((0.9, 1.4, 2.4), (0, 2))
    plain = person.Maker(loaded, roster.draw_person("casual", 1))
    for maker in (plain, *(maker for maker, _ in holders.values())):
        rig = maker.rig
        poses = cast.poses_of_build(rig.build, repertoire)
        leaders, _ = skinning.leaders_of(loaded.parents, rig.all_matrices(poses)[::5], rig.leading())
        assert set(leaders) == rig.leading() and len(rig.leading()) == 19, maker.person.holds
