# SPDX-License-Identifier: Apache-2.0
"""Motion of one's own: .bvh files, whose bones are what, cycles, and how somebody else moves so. No Blender here."""
import math

import numpy
import pytest

import clip_walker
from clip_walker import BIOVISION, BIOVISION_SIDE, CMU, CMU_SIDE, Walker
from results import ADDON  # noqa: F401  it puts the add-on on the path
from throng.cast import POSES, Repertoire, gait, skinning
from throng.motions import MotionError, bvh, matching, reading, retarget, takes
from throng.motions.motion import Motion
from throng.people import library
from throng.people.person import Maker
from throng.people.roster import Role

UE = {"pelvis": "pelvis", "belly": "spine_01", "back": "spine_02", "chest": "spine_03", "neck": "neck_01",
      "head": "head"}
UE_SIDE = {"side": "hip_helper_{}", "thigh": "thigh_{}", "shin": "calf_{}", "foot": "foot_{}", "toe": "ball_{}",
           "collar": "clavicle_{}", "upper": "upperarm_{}", "fore": "lowerarm_{}", "hand": "hand_{}"}
VRM = {part: f"J_Bip_C_{name}" for part, name in CMU.items()}
VRM_SIDE = {"side": "J_Aux_{0[0]}_Side", "thigh": "J_Bip_{0[0]}_UpperLeg", "shin": "J_Bip_{0[0]}_LowerLeg",
            "foot": "J_Bip_{0[0]}_Foot", "toe": "J_Bip_{0[0]}_ToeBase", "collar": "J_Bip_{0[0]}_Shoulder",
            "upper": "J_Bip_{0[0]}_UpperArm", "fore": "J_Bip_{0[0]}_LowerArm", "hand": "J_Bip_{0[0]}_Hand"}
NAMELESS = {part: f"bone{number}" for number, part in enumerate(CMU)}
NAMELESS_SIDE = {part: "{}" + f"{number}" for number, part in enumerate(CMU_SIDE)}


def ue(joint):
    return joint.replace("Right", "r").replace("Left", "l")


def nameless(joint):
    return joint.replace("Right", "a").replace("Left", "b")


def take_of(folder, walker, name="walk", **options):
    path = folder / f"{name}.bvh"
    path.write_text(clip_walker.bvh(walker, **options))
    return bvh.read(path)


def walk_of(folder, walker, **options):
    return reading.walk_of(reading.body_of(take_of(folder, walker, **options)))


TEXT = """HIERARCHY
ROOT Hips
{
  OFFSET 0.0 1.0 0.0
  CHANNELS 6 Xposition Yposition Zposition Yrotation Xrotation Zrotation
  JOINT An arm
  {
    OFFSET 1.0 0.0 0.0
    CHANNELS 3 Zrotation Yrotation Xrotation
    End Site
    {
      OFFSET 1.0 0.0 0.0
    }
  }
}
MOTION
Frames: 2
Frame Time: 0.04
0 2 0 0 0 0 0 0 0
5 2 1 90 0 0 90 0 0
"""


def test_a_bvh_file_is_read(tmp_path):
    (tmp_path / "a.bvh").write_text(TEXT)
    take = bvh.read(tmp_path / "a.bvh")
    assert (take.name, take.names, take.parents, take.rate) == ("a", ("Hips", "An arm"), (-1, 0), pytest.approx(25.0))
    assert numpy.allclose(take.rest[:, :3, 3], [[0, 1, 0], [1, 1, 0]]) and numpy.allclose(take.ends[1], [2, 1, 0])
    assert numpy.allclose(take.frames[0, 1, :3, 3], [1, 2, 0])
    # half a right turn about y takes the arm from x to -z; its own about z then points it up
    assert numpy.allclose(take.frames[1, 1, :3, 3], [5, 2, 0]) and numpy.allclose(take.frames[1, 1, :3, 0], [0, 1, 0])


@pytest.mark.parametrize("change, said", [
    (lambda text: "", "line 1: the file does not begin with HIERARCHY"),
    (lambda text: text.replace("HIERARCHY", "solid cube"), "line 1: the file does not begin with HIERARCHY"),
    (lambda text: text[:150], "truncated"),
    (lambda text: text[:text.index("MOTION")], "ends without the line MOTION"),
    (lambda text: text[:text.rindex("5 2 1")], "says 2 frames and holds 1: it is truncated"),
    (lambda text: text[:-8], "line 20: a frame of 6 numbers where the joints have 9 channels: it is truncated"),
    (lambda text: text.replace("5 2 1", "5 nan 1"), "line 20: a frame with something that is no number"),
    (lambda text: text.replace("5 2 1", "5 1e999 1"), "line 20: a frame with something that is no number"),
    (lambda text: text.replace("5 2 1", "5 two 1"), "line 20: a frame with something that is no number"),
    (lambda text: text.replace("Frames: 2", "Frames: 0"), "line 17: 0 frames: expected 1 to"),
    (lambda text: text.replace("Frames: 2", "Frames: 2000000000"), "line 17: 2e+09 frames: expected 1 to"),
    (lambda text: text.replace("Frames: 2", "Frames: many"), "line 17: Frames: 'many' is no number"),
    (lambda text: text.replace("Frame Time: 0.04", "Frame Time: 0"), "line 18: a frame time of 0 s"),
    (lambda text: text.replace("Frame Time", "Time"), "line 18: `Frame Time:` should come"),
    (lambda text: text.replace("Yrotation X", "Wrotation X"), "line 5: 'wrotation' is no channel"),
    (lambda text: text.replace("CHANNELS 6", "CHANNELS 7"), "line 5: the joint Hips has 7 channels"),
    (lambda text: text.replace("OFFSET 1.0 0.0 0.0", "OFFSET 1.0 nan 0.0", 1), "line 8: OFFSET: 'nan' is no number"),
    (lambda text: text.replace("  OFFSET 0.0 1.0 0.0\n", ""), "the joint Hips has no OFFSET"),
    (lambda text: text.replace("MOTION", "ROOT Other\nMOTION"), "one skeleton a file is read"),
    (lambda text: text.replace("JOINT", "BONE"), "line 6: found 'bone' where"),
    (lambda text: "HIERARCHY\nROOT a\n{" + "JOINT b\n{ OFFSET 0 0 0\n" * 1100, "more than 1000 joints")])
def test_what_is_wrong_with_a_bvh_file_is_said_with_its_line(tmp_path, change, said):
    (tmp_path / "bad.bvh").write_text(change(TEXT))
    with pytest.raises(MotionError, match="^bad.bvh, line ") as error:
        bvh.read(tmp_path / "bad.bvh")
    assert said in str(error.value) and len(str(error.value)) < 200


def test_files_that_are_huge_or_not_there_are_refused(tmp_path, monkeypatch):
    with pytest.raises(MotionError, match="none.bvh cannot be read: No such file"):
        bvh.read(tmp_path / "none.bvh")
    (tmp_path / "a.bvh").write_text(TEXT)
    monkeypatch.setattr(bvh, "MOST_BYTES", 100)
    with pytest.raises(MotionError, match="clips of up to"):
        bvh.read(tmp_path / "a.bvh")


@pytest.mark.parametrize("name, part", [
    ("LeftUpLeg", ("L", "upleg")), ("mixamorig:RightForeArm", ("R", "forearm")), ("Head", ("", "head")),
    ("J_Bip_L_UpperArm", ("L", "upperarm")), ("upper_arm.R", ("R", "upperarm")), ("calf_l", ("L", "calf")),
    ("lhumerus", ("L", "humerus")), ("L_Wrist", ("L", "wrist")), ("DEF-foot.L", ("L", "foot")),
    ("Bip01 R Hand", ("R", "hand")),
    ("upperarm_twist_01_l", None), ("foot_ik.L", None), ("leg", ("", "leg")), ("radius", ("", "radius"))])
def test_names_of_bones_are_understood(name, part):
    assert matching.part_of(name) == part


@pytest.mark.parametrize("names, named", [
    ((CMU, CMU_SIDE), str), ((BIOVISION, BIOVISION_SIDE), str), ((CMU, CMU_SIDE), lambda name: f"mixamorig:{name}"),
    ((UE, UE_SIDE), ue), ((VRM, VRM_SIDE), lambda name: name), ((NAMELESS, NAMELESS_SIDE), nameless)],
    ids=["cmu", "biovision", "mixamo", "ue", "vrm", "nameless"])
def test_bones_are_matched_however_they_are_named(tmp_path, names, named):
    names = tuple({part: name.replace("{0[0]}", "{}") for part, name in each.items()} for each in names)
    if names[1]["thigh"].startswith("J_"):
        named = lambda name: name.replace("_Right_", "_R_").replace("_Left_", "_L_")
    take = takes.turned(take_of(tmp_path, Walker(rest="A"), names=names, named=named), takes.Y_UP)
    found = matching.match(take)
    name = lambda part, side="": named((names[1][part].format(side) if side else names[0][part]))
    for side, leg, arm in zip(("Right", "Left"), found.legs, found.arms):
        assert [take.names[each] for each in (leg.thigh, leg.shin, leg.foot)] == \
            [name(part, side) for part in ("thigh", "shin", "foot")]
        assert [take.names[each] for each in (arm.upper, arm.fore, arm.hand)] == \
            [name(part, side) for part in ("upper", "fore", "hand")]
    assert [take.names[each] for each in found.trunk] == [name(part) for part in ("pelvis", "belly", "back", "chest")]
    assert found.head is None if "bone" in name("head") else take.names[found.head] == name("head")
    assert numpy.allclose(found.forward, [[0, 1, 0], [-1, 0, 0], [0, 0, 1]], atol=1e-9)  # looks along -y


def swing_of(motion, side=0):
    """(least, most) degrees that an upper arm swings forward."""
    way = motion.arms[:, side, 0]
    angles = numpy.degrees(numpy.arctan2(way[:, 0], -way[:, 2]))
    return angles.min(), angles.max()


@pytest.mark.parametrize("walker, options", [
    ({"stride": 1.3}, {}), ({"stride": 0.8, "frames": 40}, {"scale": 1.0}),
    ({"stride": 2.0, "frames": 24}, {"z_up": True}),
    ({"stride": 1.3, "frames": 128, "rate": 120.0, "cycles": 5, "heading": 0.7}, {"scale": 0.45 / 0.0254}),
    ({"stride": 1.3, "closed": False}, {"scale": 1.0 / 0.0254}),
    ({"stride": 1.3, "travels": False, "cycles": 2}, {}), ({"stride": 0.8, "frames": 40, "dips": True}, {})],
    ids=["cm", "m", "z up", "long, askew, the CMU library's unit", "not closed, inches", "on the spot", "toes dip"])
def test_strides_and_swing_are_found(tmp_path, walker, options):
    motion = walk_of(tmp_path, Walker(**walker), **options)
    assert motion.stride == pytest.approx(walker["stride"], rel=0.02)
    for side in range(2):
        assert swing_of(motion, side) == pytest.approx((-24.0, 24.0), abs=1.0)
    nods = numpy.degrees(numpy.arcsin(motion.trunk[:, 5, 0, 2]))
    assert nods.max() == pytest.approx(clip_walker.NOD, abs=0.3)
    assert numpy.abs(motion.trunk[:, :4] - numpy.eye(3)).max() < 1e-3
    for (down, length), later in zip(motion.stance, (0.0, 0.5)):
        assert length == pytest.approx(clip_walker.STANCE, abs=0.06 if walker["stride"] < 2.0 else 0.13)
    assert abs((motion.stance[1][0] - motion.stance[0][0]) % 1.0 - 0.5) < 0.03


def test_rest_poses_do_not_matter(tmp_path):
    one, other, third = (walk_of(tmp_path, Walker(rest=rest)) for rest in ("T", "down", "A"))
    for name in ("trunk", "legs", "feet", "arms", "hips"):
        assert numpy.allclose(getattr(one, name), getattr(other, name), atol=1e-5), name
        assert numpy.allclose(getattr(one, name), getattr(third, name), atol=1e-5), name


@pytest.mark.parametrize("walker, said", [
    ({"backwards": True}, "does not walk forwards: it goes 180 degrees aside"),
    ({"backwards": True, "travels": False}, "does not walk: "),
    ({"stands": True, "swing": 0.0}, "does not walk"),
    ({"frames": 4, "closed": False}, "a clip needs one whole cycle")])
def test_what_does_not_walk_is_refused(tmp_path, walker, said):
    with pytest.raises(MotionError) as error:
        walk_of(tmp_path, Walker(**walker), name="clip")
    assert said in str(error.value) and "clip" in str(error.value)


def test_skeletons_without_legs_or_knees_are_refused(tmp_path):
    text = clip_walker.bvh(Walker())
    (tmp_path / "arm.bvh").write_text(TEXT)
    with pytest.raises(MotionError, match="^arm has a skeleton of no height at rest"):
        reading.body_of(bvh.read(tmp_path / "arm.bvh"))
    (tmp_path / "tail.bvh").write_text(TEXT.replace("OFFSET 1.0 0.0", "OFFSET 0.0 -1.0"))
    with pytest.raises(MotionError, match="^tail: no two feet were found"):
        reading.body_of(bvh.read(tmp_path / "tail.bvh"))
    (tmp_path / "odd.bvh").write_text(text)
    with pytest.raises(MotionError, match="odd: the feet should be the names of two bones"):
        reading.body_of(bvh.read(tmp_path / "odd.bvh"), ("Paw", "Hoof"))


def test_a_clip_that_stands_gives_beats(tmp_path):
    body = reading.body_of(take_of(tmp_path, Walker(stands=True, swing=10.0, travels=False, cycles=4)))
    motion = reading.stand_of(body)
    assert motion.kind == "stands" and len(motion.arms) == 4
    with pytest.raises(MotionError, match="does not stand: its feet move"):
        reading.stand_of(reading.body_of(take_of(tmp_path, Walker(travels=False))))


def test_motions_come_back_from_text(tmp_path):
    motion = walk_of(tmp_path, Walker())
    again = Motion.of(motion.text())
    for name in ("trunk", "legs", "feet", "arms", "hips"):
        assert numpy.allclose(getattr(again, name), getattr(motion, name), atol=1e-6)
    assert (again.name, again.stride, again.stance) == (motion.name, motion.stride, motion.stance)


def test_a_motion_is_taken_for_strides_near_its_own():
    strides = Repertoire((0.69, 0.88, 1.13, 1.45, 1.85, 2.37))
    of = lambda stride: Motion("a", "walks", *[numpy.zeros(1)] * 5, stride=stride)
    assert retarget.fits(of(1.3), strides) == [2, 3] and retarget.fits(of(5.0), strides) == [5]
    assert retarget.fits(of(1.3), strides, every=True) == [0, 1, 2, 3, 4]
    assert retarget.fits(of(2.5), strides, every=True) == [5] == retarget.fits(of(2.9), strides)


def test_turns_of_half_a_round_are_a_little_less():
    for axis in numpy.eye(3):
        turn = skinning.matrices_of(math.pi * axis, numpy.zeros(3))[None, :, :3]
        near = skinning.within_half_a_round(turn)
        again = skinning.matrices_of(skinning.turns_of(near), numpy.zeros((1, 3)))[..., :3]
        assert numpy.abs(again - turn).max() < 0.08


@pytest.fixture(scope="module")
def wearers(bodies):
    """A man, a woman, a girl, somebody old."""
    shapes = library.load(bodies)
    return [retarget.Wearer.of(Maker(shapes, Role(number).person())) for number in (0, 1, 9, 6)]


def places(wearer, poses, bone):
    return poses[:, retarget.BONES.index(bone), :3, 3]


def test_feet_are_planted_whoever_walks_so(tmp_path, wearers):
    motion = walk_of(tmp_path, Walker(stride=1.3))
    for wearer in wearers:
        walk = retarget.walk(motion, wearer)
        assert walk.cycle.stride == pytest.approx(1.3 * wearer.leg / motion.leg)
        for stride in (0.88, 1.45):
            plan = walk.plan(stride)
            poses = walk.poses(plan)
            assert plan.short == 0.0 and plan.share > 0.38
            assert retarget.slide(wearer, poses, stride) < 0.01
            for side, later in (("r", 0.0), ("l", 0.5)):
                thigh, calf, foot = (places(wearer, poses, f"{bone}_{side}") for bone in ("thigh", "calf", "foot"))
                assert numpy.allclose(numpy.linalg.norm(calf - thigh, axis=1), wearer.rig.build.thigh, atol=2e-3)
                under = (gait.UNDER_BODY + later) % 1.0 * POSES
                place = foot[int(under)] + under % 1.0 * (foot[int(under) + 1] - foot[int(under)])
                assert abs(place[0]) < 0.02, "the foot is under the body where the bake changes strides"
                assert (foot[:, 1] < 0.0).all() == (side == "r")
                heel, toes = (poses[:, retarget.BONES.index(f"{bone}_{side}"), 2, 0] for bone in ("foot", "ball"))
                assert heel.min() < -0.3 and toes.min() > -0.12, "heels rise, toes stay on the ground"


def test_arms_swing_as_the_clip_does(tmp_path, wearers):
    motion = walk_of(tmp_path, Walker(stride=1.3, swing=30.0))
    for wearer in wearers:
        walk = retarget.walk(motion, wearer)
        poses = walk.poses(walk.plan(1.3 * wearer.leg / motion.leg))
        for side in "rl":
            upper = places(wearer, poses, f"lowerarm_{side}") - places(wearer, poses, f"upperarm_{side}")
            fore = places(wearer, poses, f"hand_{side}") - places(wearer, poses, f"lowerarm_{side}")
            angle = lambda way: numpy.degrees(numpy.arctan2(way[:, 0], -way[:, 2]))
            assert numpy.ptp(angle(upper)) == pytest.approx(60.0, abs=3.0)
            assert numpy.abs(angle(fore) - angle(upper) - clip_walker.ELBOW).max() < 3.0
            assert (numpy.abs(places(wearer, poses, f"hand_{side}")[:, 1]) > wearer.rig.widest).all(), "beside the hips"


def test_arms_that_a_clip_does_not_have_are_the_casts(tmp_path, wearers):
    motion, wearer = walk_of(tmp_path, Walker()), next(each for each in wearers if not each.rig.holds)
    motion.arms[:, 0] = 0.0
    walk = retarget.walk(motion, wearer)
    poses = walk.poses(walk.plan(1.45))
    own = [wearer.rig.matrices(gait.walk_pose(number / POSES, wearer.rig.build, gait.gait_of(1.45)))
           for number in range(POSES)]
    bone = wearer.rig.bodies.bone["lowerarm_r"]
    upper = places(wearer, poses, "lowerarm_r") - places(wearer, poses, "upperarm_r")
    ends = [wearer.rig.heads[name] for name in ("upperarm_r", "lowerarm_r")]
    at = lambda matrices, point: matrices[wearer.rig.bodies.bone["upperarm_r"]] @ [*point, 1.0]
    expected = [at(matrices, ends[1]) - at(matrices, ends[0]) for matrices in own]
    ahead = lambda ways: numpy.degrees(numpy.arctan2(numpy.array(ways)[:, 0], -numpy.array(ways)[:, 2]))
    assert numpy.abs(ahead(upper) - ahead(expected)).max() < 8.0 and bone >= 0


def test_who_stands_so_stays_on_the_ground(tmp_path, wearers):
    take = take_of(tmp_path, Walker(stands=True, swing=10.0, travels=False, cycles=4))
    motion = reading.stand_of(reading.body_of(take))
    for wearer in wearers:
        poses = retarget.stand(motion, wearer, "idle")
        assert len(poses) == 4
        for side in "rl":
            foot = places(wearer, poses, f"foot_{side}")
            assert numpy.ptp(foot, axis=0).max() < 1e-6
            assert foot[0, 2] == pytest.approx(wearer.rig.build.ankle, abs=1e-3)
