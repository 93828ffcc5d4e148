# SPDX-License-Identifier: Apache-2.0
"""Puts a motion onto the bones of somebody who is shaped from a body: limbs point where the clip's do, the trunk turns
as the clip's does, feet are planted as own characters' are. No Blender here.
"""
from dataclasses import dataclass

import numpy

from ..cast import BEATS, POSES, gait
from ..characters import anatomy, feet, legs, motion
from ..people import holding, turns as bends
from .motion import TRUNK

_SIDES = ("r", "l")
_LIMBS = [f"{bone}_{side}" for side in _SIDES for bone in ("thigh", "calf", "foot", "ball", "clavicle", "upperarm",
                                                          "lowerarm", "hand")]
BONES = (*TRUNK, *_LIMBS)
_ABOVE = {"spine_01": "pelvis", "spine_02": "spine_01", "spine_03": "spine_02", "neck_01": "spine_03",
          "head": "neck_01", "thigh": "pelvis", "calf": "thigh", "foot": "calf", "ball": "foot", "clavicle": "spine_03",
          "upperarm": "clavicle", "lowerarm": "upperarm", "hand": "lowerarm"}
_AT = {name: number for number, name in enumerate(BONES)}
WIDEST = 0.40   # rad: so far arms are held aside at most for hands to pass the hips
BEHIND = 0.03   # m, of the ball: from there on a sole goes with the foot alone
BESIDE = 0.055  # m, from the hips to the middle of a hand
NEAR = 1.28     # a bake's strides are so many times the one before
_Y, _Z = numpy.array([0.0, 1.0, 0.0]), numpy.array([0.0, 0.0, 1.0])


def _parents():
    found = []
    for name in BONES:
        above = _ABOVE.get(name) or _ABOVE.get(name[:-2], "")
        above = above if above in _AT or not above else f"{above}{name[-2:]}"
        found.append(_AT[above] if above else -1)
    return found


PARENTS = _parents()


@dataclass
class Wearer:
    """Somebody as motions are put onto."""
    maker: object  # people.person.Maker
    soles: list    # of each foot (points from the ankle at rest, whether they go with the toes)

    @classmethod
    def of(cls, maker):
        return cls(maker, [_sole(maker, side) for side in _SIDES])

    @property
    def rig(self):
        return self.maker.rig

    @property
    def leg(self):
        return self.rig.build.thigh + self.rig.build.shank

    def rest(self, bone):
        return self.rig.heads[bone]


def _sole(maker, side):
    """The corners of a shoe's sole: flat below the outline of the foot."""
    bodies, rig = maker.bodies, maker.rig
    ankle, points, toes = rig.heads[f"foot_{side}"], [], []
    for bone, toe in ((f"foot_{side}", False), (f"ball_{side}", True)):
        body = bodies.vertices_of("body")
        mine = maker.shape[body[bodies.weights[body, bodies.bone[bone]] > 0.5]]
        mine = mine[mine[:, 2] < ankle[2]]
        if not toe:  # what is below the ball turns with both
            mine = mine[mine[:, 0] < rig.heads[f"ball_{side}"][0] - BEHIND * rig.scale]
        corners = mine[anatomy.corners_of(mine)]
        corners[:, 2] = -rig.sole
        points.append(corners - ankle)
        toes += [toe] * len(corners)
    return numpy.concatenate(points), numpy.array(toes)


def _frames(along, hinge):
    """(N, 3, 3): axes along a bone, about its hinge, and across both."""
    along = along / numpy.linalg.norm(along, axis=-1, keepdims=True)
    hinge = hinge - along * (hinge * along).sum(axis=-1, keepdims=True)
    hinge = hinge / numpy.maximum(numpy.linalg.norm(hinge, axis=-1, keepdims=True), 1e-9)
    return numpy.stack([along, hinge, numpy.cross(along, hinge)], axis=-1)


def _turns(wearer, what):
    """{bone: (N, 3, 3)}: how everything is turned from rest. Legs are not yet placed."""
    rig, turns = wearer.rig, {}
    for number, bone in enumerate(TRUNK):
        stoop = {"spine_01": 0.4, "spine_02": 0.9, "spine_03": 1.5, "neck_01": 1.3, "head": 0.35}.get(bone, 0.0)
        turns[bone] = what.trunk[:, number] @ bends.turn(_Y, stoop * rig.stoop)
    for index, side in enumerate(_SIDES):
        thigh, calf, foot, ball = (f"{bone}_{side}" for bone in ("thigh", "calf", "foot", "ball"))
        axis = what.legs[:, index, 2]
        for row, (bone, end) in enumerate(((thigh, calf), (calf, foot))):
            at_rest = bends.frame(rig.heads[end] - rig.heads[bone], _Y)
            turns[bone] = _frames(what.legs[:, index, row], axis) @ at_rest.T
        way = rig.heads[ball] - rig.heads[foot]
        straight = bends.turn(_Z, -float(numpy.arctan2(way[1], way[0])))
        turns[foot] = what.feet[:, index] @ straight
        turns[ball] = _toes(what.feet[:, index]) @ straight
        turns[f"clavicle_{side}"] = turns["spine_03"] @ bends.turn(numpy.array([1.0, 0.0, 0.0]),
                                                                   -_sign(side) * 0.03)
        if what.has_arm(index):
            _turn_arm(wearer, what, turns, side, index)
    return turns


def _sign(side):
    return 1.0 if side == "l" else -1.0


def _toes(foot):
    """Toes stay on the ground while the heel is up: without what of a foot's turn points them down."""
    ahead = foot[:, :, 0]
    down = numpy.arctan2(-ahead[:, 2], numpy.linalg.norm(ahead[:, :2], axis=1)).clip(0.0)
    c, s, found = numpy.cos(down), numpy.sin(down), numpy.tile(numpy.eye(3), (len(foot), 1, 1))
    found[:, 0, 0], found[:, 2, 2], found[:, 0, 2], found[:, 2, 0] = c, c, -s, s
    return foot @ found


def _turn_arm(wearer, what, turns, side, index):
    rig = wearer.rig
    upper, lower, hand = (f"{bone}_{side}" for bone in ("upperarm", "lowerarm", "hand"))
    first, second = rig.heads[lower] - rig.heads[upper], rig.heads[hand] - rig.heads[lower]
    hinge, aside = bends.cross(first, second), _aside(wearer, what, turns, side, index)
    for bone, row, at_rest in ((upper, 0, first), (lower, 1, second)):
        turns[bone] = aside @ _frames(what.arms[:, index, row], what.arms[:, index, 2]) @ bends.frame(at_rest, hinge).T
    turns[hand] = turns[lower] @ bends.turn(second, _sign(side) * 0.22)  # palms to the thighs


def _aside(wearer, what, turns, side, index):
    """(N, 3, 3): what holds an arm further out, for its hand to pass beside the hips: as much in all poses as the
    nearest one needs."""
    rig, chest = wearer.rig, turns["spine_03"]
    bones = [f"{bone}_{side}" for bone in ("upperarm", "lowerarm", "hand")]
    lengths = [float(numpy.linalg.norm(rig.heads[b] - rig.heads[a])) for a, b in zip(bones, bones[1:])]
    reach = what.arms[:, index, 0] * lengths[0] + what.arms[:, index, 1] * lengths[1]
    reach = (chest.swapaxes(1, 2) @ reach[..., None])[..., 0]
    low = rig.heads[bones[0]][2] + reach[:, 2] < rig.heads["thigh_l"][2] + 0.12 * rig.scale
    out = abs(rig.heads[bones[0]][1]) + _sign(side) * reach[:, 1]
    needs = (rig.widest + BESIDE * rig.scale - out) / sum(lengths)
    angle = float(numpy.clip(numpy.max(needs[low], initial=0.0), 0.0, WIDEST))
    return chest @ bends.turn(numpy.array([1.0, 0.0, 0.0]), _sign(side) * angle) @ chest.swapaxes(1, 2)


def _placed(wearer, turns, hips):
    """(N, B, 4, 4) of BONES, from the middle between the hip joints."""
    rig, count = wearer.rig, len(hips)
    found = numpy.tile(numpy.eye(4), (count, len(BONES), 1, 1))
    for number, (bone, parent) in enumerate(zip(BONES, PARENTS)):
        found[:, number, :3, :3] = turns.get(bone, turns["spine_03"])
        base, start = (hips, rig.hips) if parent < 0 else (found[:, parent, :3, 3], rig.heads[BONES[parent]])
        turned = turns["pelvis"] if parent < 0 else found[:, parent, :3, :3]
        found[:, number, :3, 3] = base + turned @ (rig.heads[bone] - start)
    return found


def _soles(wearer, bones):
    """Of each foot (N, V, 3)."""
    found = []
    for side, (points, toes) in zip(_SIDES, wearer.soles):
        foot, ball = (bones[:, _AT[f"{bone}_{side}"]] for bone in ("foot", "ball"))
        joint = wearer.rest(f"ball_{side}") - wearer.rest(f"foot_{side}")
        on_foot = points @ foot[:, :3, :3].swapaxes(1, 2) + foot[:, None, :3, 3]
        on_toes = (points - joint) @ ball[:, :3, :3].swapaxes(1, 2) + ball[:, None, :3, 3]
        found.append(numpy.where(toes[None, :, None], on_toes, on_foot))
    return found


def _body(wearer):
    found, offspring = [], []
    for side, (points, _) in zip(_SIDES, wearer.soles):
        at = [_AT[f"{bone}_{side}"] for bone in ("thigh", "calf", "foot", "ball")]
        found.append(anatomy.Leg(*at[:3], numpy.arange(len(points))))
        offspring.append(([at[0]], [at[1]], at[2:]))
    return motion.Body(PARENTS, found, offspring, 0.004 * wearer.rig.scale * 1.74)


def _on_ground(bones, soles, moments):
    """Bones and soles with the ground at 0: where the feet are on average at those moments."""
    low = numpy.mean([feet.at(sole[..., 2], moment).min() for sole, moment in zip(soles, moments)])
    bones[..., 2, 3] -= low
    for sole in soles:
        sole[..., 2] -= low


@dataclass
class Walk:
    """A motion on somebody, ready for any stride."""
    cycle: motion.Cycle
    body: motion.Body
    wearer: Wearer
    what: object

    def plan(self, stride):
        return motion.plan(self.cycle, self.body, stride)

    def poses(self, plan):
        """(POSES, B, 4, 4)"""
        found = numpy.stack([motion.pose_of(plan, self.body, number / POSES) for number in range(POSES)])
        build = self.wearer.rig.build
        swung = [gait.walk_pose(number / POSES, build, gait.gait_of(plan.stride)).arms for number in range(POSES)]
        return _with_arms(self.wearer, self.what, found, swung)


def walk(what, wearer):
    """The Walk of a motion that walks."""
    turns = _turns(wearer, what)
    bones = _placed(wearer, turns, what.hips * wearer.leg)
    soles, body = _soles(wearer, bones), _body(wearer)
    stride = what.stride * wearer.leg / what.leg
    stances = [feet.Stance(down, length, stride) for down, length in what.stance]
    found = [feet.foot_of(bones[:, leg.foot, :3, 3], sole, stance, bones[:, leg.hip, :3, 3])
             for leg, sole, stance in zip(body.legs, soles, stances)]
    _on_ground(bones, soles, [foot.under for foot in found])
    found = [feet.foot_of(bones[:, leg.foot, :3, 3], sole, stance, bones[:, leg.hip, :3, 3])
             for leg, sole, stance in zip(body.legs, soles, stances)]
    return Walk(motion.Cycle(what.name, bones, found, 1.0), body, wearer, what)


def stand(what, wearer, clip):
    """(BEATS, B, 4, 4): the beats of a motion that stands; feet stay where they are on average."""
    turns, body = _turns(wearer, what), _body(wearer)
    bones = _placed(wearer, turns, what.hips * wearer.leg)
    _on_ground(bones, _soles(wearer, bones), [0.0, 0.0])
    shown, soles = bones[0].copy(), _soles(wearer, bones)
    for side, (leg, sole) in enumerate(zip(body.legs, soles)):
        target = bones[:, leg.foot, :3, 3].mean(axis=0)
        target[2] = shown[leg.foot, 2, 3] - sole[0, :, 2].min()
        for beat in bones:
            motion.place(beat, body, side, target, shown, numpy.eye(3))
    arms = [gait.standing_pose(clip, number / BEATS, wearer.rig.build).arms for number in range(BEATS)]
    return _with_arms(wearer, what, bones, arms)


def _with_arms(wearer, what, bones, arms):
    """Arms that the clip does not have go as the cast's own do."""
    rig = wearer.rig
    for index, side in enumerate(_SIDES):
        if what.has_arm(index):
            continue
        for pose, both in zip(bones, arms):
            turns = {name: pose[number, :3, :3] for name, number in _AT.items()}
            places = {name: pose[number, :3, 3] for name, number in _AT.items()}
            rig.hang_arm(turns, places, _yaw(turns["spine_03"]), side, *both[index])
            for bone in ("clavicle", "upperarm", "lowerarm", "hand"):
                number = _AT[f"{bone}_{side}"]
                pose[number, :3, :3], pose[number, :3, 3] = turns[BONES[number]], places[BONES[number]]
    return bones


def _yaw(turned):
    return float(numpy.arctan2(turned[1, 0], turned[0, 0]))


def matrices(wearer, pose):
    """(all bones of the library, 3, 4) of a pose (B, 4, 4)."""
    turns = {name: pose[number, :3, :3] for name, number in _AT.items()}
    places = {name: pose[number, :3, 3] for name, number in _AT.items()}
    turns["Root"], places["Root"] = numpy.eye(3), numpy.zeros(3)
    for side in _SIDES:
        wearer.rig.bend_fingers(turns, places, side)
    if wearer.rig.holds in holding.BAGS:
        holding.hang(wearer.rig, turns, places, 0.0)
    return wearer.rig.of_all(turns, places)


def slide(wearer, poses, stride):
    """m that the worse foot slides in a step of these poses of a cycle."""
    return max(feet.slide(sole, stride, 0.004) for sole in _soles(wearer, poses))


def fits(what, repertoire, every=False):
    """Numbers, in the repertoire, of the gaits that a motion is taken for: those that its stride is nearer to than the
    next but one is, one at least; or all that are walked, or run, as it is."""
    ratios = [abs(numpy.log(stride / what.stride)) for stride in repertoire.strides]
    runs = what.stride >= gait.RUNNING_STRIDE
    if every:
        found = [number for number, stride in enumerate(repertoire.strides) if (stride >= gait.RUNNING_STRIDE) == runs]
    else:
        found = [number for number, ratio in enumerate(ratios) if ratio < numpy.log(NEAR)]
    return found or [int(numpy.argmin(ratios))]
