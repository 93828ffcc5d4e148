# SPDX-License-Identifier: Apache-2.0
"""Poses of bodies: the add-on's gaits (cast/gait.py), whose feet do not slide, on the library's bones."""
import math

import numpy

from ..cast import gait
from . import holding
from .turns import cross, frame, length, turn, turned, vector

_FINGERS = (("index", 0.32), ("middle", 0.40), ("ring", 0.45), ("pinky", 0.48))
_THUMB = 0.55  # of the angle between thumb and index, by which they close
_X, _Y, _Z = numpy.eye(3)
_LEADING = ("Root", "pelvis", "spine_01", "spine_02", "spine_03", "neck_01", "head",
            *(f"{bone}_{side}" for side in "lr" for bone in ("thigh", "calf", "foot", "ball", "upperarm", "lowerarm")))
SOLE = 0.018  # m, of a shoe, below the foot
STICK_AHEAD = 0.12  # m, of the ankle, where sticks are planted
_DROOP = 0.18     # rad, by which collarbones sink as arms are let down, which are held out at rest
_LIFTS_FROM, _LIFT = 1.3, 0.55  # rad of swing, from which collarbones rise with the arm, and how far
_ROUNDS = 10      # of looking for an elbow's angle: to a millimetre of the stick's tip


class _Poses:
    """Poses of cast/gait.py as arrays of all of them."""

    def __init__(self, poses):
        of = lambda value: numpy.array([value(pose) for pose in poses], float)
        self.pelvis, self.pelvis_yaw = of(lambda pose: pose.pelvis), of(lambda pose: pose.pelvis_yaw)
        self.shoulder_yaw, self.lean = of(lambda pose: pose.shoulder_yaw), of(lambda pose: pose.lean)
        self.ankles = of(lambda pose: [foot.ankle for foot in pose.feet])    # (P, 2, 2)
        self.pitches = of(lambda pose: [foot.pitch for foot in pose.feet])   # (P, 2)
        self.planted = of(lambda pose: [bool(foot.planted) for foot in pose.feet]) > 0.5
        self.arms = of(lambda pose: pose.arms)                               # (P, 2, 2)
        self.tilt, self.runs = of(lambda pose: pose.tilt), of(lambda pose: pose.runs) > 0.5
        self.aside = of(lambda pose: pose.aside)                             # (P, 2, 2)
        self.seated = of(lambda pose: pose.seated) > 0.5


class Rig:
    """Somebody's bones at rest, and how they go with a pose."""

    def __init__(self, bodies, shape, height, sole=SOLE, stoop=0.0, stick=False, holds="", limp=0.0,
                 manner=gait.Manner()):
        """@param stoop rad, that the back bends forward; @param stick whether somebody walks with one; @param holds one
        of holding.THINGS, or nothing; @param limp how much the left leg is spared, 0 to 1"""
        self.bodies, self.sole, self.stoop, self.stick = bodies, sole, stoop, stick
        self.holds, self.limp, self.manner = holds, limp, manner
        joints = bodies.joints(shape)
        self.heads = {bone: joints[bodies.heads[number]] for bone, number in bodies.bone.items()}
        self.tails = {bone: joints[bodies.tails[number]] for bone, number in bodies.bone.items()}
        self.scale = height / 1.74
        self._curled = {}
        self.hips = 0.5 * (self.heads["thigh_l"] + self.heads["thigh_r"])
        self.build = self._build(shape)
        self.widest = self._widest(shape)

    def _build(self, shape):
        """Lengths for the gaits, of the left leg: bodies are as good as even."""
        hip, knee, ankle = (self.heads[bone] for bone in ("thigh_l", "calf_l", "foot_l"))
        ball = self.heads["ball_l"]
        foot = shape[(self.bodies.weights[:, self.bodies.bone["foot_l"]] > 0.5) & (shape[:, 2] < ankle[2])]
        return gait.Build(thigh=float(math.dist(hip, knee)), shank=float(math.dist(knee, ankle)),
                          ankle=float(ankle[2] + self.sole), heel=float(0.85 * (ankle[0] - foot[:, 0].min())),
                          ball=float(ball[0] - ankle[0]), hip_width=float(hip[1] - self.heads["thigh_r"][1]),
                          limp=self.limp, manner=self.manner)

    def _widest(self, shape):
        """Half the width of the hips, where hands pass."""
        trunk = self.bodies.weights[:, [self.bodies.bone[b] for b in ("pelvis", "thigh_l", "thigh_r")]].sum(axis=1)
        level = numpy.abs(shape[:, 2] - self.hips[2]) < 0.08 * self.scale
        return float(numpy.abs(shape[(trunk > 0.9) & level, 1]).max())

    def matrices(self, pose):
        """(B, 3, 4): where a pose takes the points that hang on each bone."""
        return self.all_matrices([pose])[0]

    def all_matrices(self, poses):
        """(P, B, 3, 4) of several poses, worked out together."""
        poses = _Poses(poses)
        turns, places = self._trunk(poses)
        for side, index in (("r", 0), ("l", 1)):
            self._leg(turns, places, poses, side, index)
            swing, elbow = numpy.moveaxis(poses.arms[:, index], -1, 0)
            if self.stoop:  # arms hang down from bent backs, and swing less
                bent = ~poses.seated
                swing, elbow = (numpy.where(bent, 0.6 * swing + 0.4 * self.stoop, swing),
                                numpy.where(bent, elbow + 0.15, elbow))
            if side == "r":
                swing, elbow = holding.hanging(self.holds, swing, elbow, poses.seated)
            self.hang_arm(turns, places, poses.shoulder_yaw, side, swing, elbow, poses.aside[:, index])
        if self.stick:
            self._plant(turns, places, poses)
        holding.hold(self, turns, places, poses)
        return self.of_all(turns, places)

    def leading(self):
        """Numbers of the bones that others go with: of everybody the same, though whoever carries something keeps an
        arm still."""
        return {self.bodies.bone[name] for name in _LEADING}

    def neutral(self):
        """Matrices of standing upright, arms down: where patterns of cloth are told from."""
        feet = tuple(gait.Foot((0.0, self.build.ankle), 0.0, "flat") for _ in range(2))
        leg = 0.999 * (self.build.thigh + self.build.shank) + self.build.ankle
        return self.matrices(gait.Pose((0.0, 0.0, leg), 0.0, 0.0, 0.0, feet, ((0.0, 0.12), (0.0, 0.12))))

    def _trunk(self, poses):
        stoop, straight = self.stoop, poses.lean
        nod, aside = holding.head(self.holds, poses.runs | poses.seated)
        nod = nod + self.manner.nod
        lean = turn(_Y, straight + 0.9 * stoop)
        shoulders = turn(_X, poses.tilt) @ turn(_Z, poses.shoulder_yaw)
        half = turn(_X, 0.6 * poses.tilt) @ turn(_Z, 0.5 * (poses.pelvis_yaw + poses.shoulder_yaw))
        pelvis = turn(_Z, poses.pelvis_yaw) @ turn(_Y, 0.4 * poses.lean)
        root = numpy.broadcast_to(numpy.eye(3), pelvis.shape)
        turns = {"Root": root, "pelvis": pelvis, "spine_01": half @ turn(_Y, 0.7 * straight + 0.4 * stoop),
                 "spine_02": half @ lean, "spine_03": shoulders @ turn(_Y, straight + 1.5 * stoop),
                 "neck_01": turn(_X, 0.6 * poses.tilt + 0.5 * aside) @ turn(_Z, 0.6 * poses.shoulder_yaw)
                 @ turn(_Y, 0.6 * straight + 1.3 * stoop + 0.45 * nod),
                 "head": turn(_X, 0.2 * poses.tilt + aside) @ turn(_Z, 0.3 * poses.shoulder_yaw)
                 @ turn(_Y, 0.35 * stoop + nod)}
        middle = poses.pelvis - (0.0, 0.0, gait.HIP_DROP * self.scale)
        places = {"Root": numpy.zeros_like(middle),
                  "pelvis": middle + turned(pelvis, self.heads["pelvis"] - self.hips)}
        for parent, bone in (("pelvis", "spine_01"), ("spine_01", "spine_02"), ("spine_02", "spine_03"),
                             ("spine_03", "neck_01"), ("neck_01", "head")):
            places[bone] = self._end(turns, places, parent, bone)
        return turns, places

    def _end(self, turns, places, parent, bone):
        """Where a bone begins, on its parent."""
        return places[parent] + turned(turns[parent], self.heads[bone] - self.heads[parent])

    def _leg(self, turns, places, poses, side, index):
        thigh, calf, ankle, ball = (f"{bone}_{side}" for bone in ("thigh", "calf", "foot", "ball"))
        hip = self._end(turns, places, "pelvis", thigh)
        aside = self.heads[thigh][1] * 0.62 + 0.25 * poses.pelvis[:, 1]
        ankles, pitch = poses.ankles[:, index], poses.pitches[:, index]
        knees = numpy.array([gait.knee_of(start, stop, self.build)
                             for start, stop in zip(hip[:, [0, 2]].tolist(), ankles.tolist())])
        end = vector(ankles[:, 0], aside, ankles[:, 1])
        knee = vector(knees[:, 0], 0.5 * (hip[:, 1] + aside), knees[:, 1])
        toes_out = turn(_Z, self.manner.toes if side == "l" else -self.manner.toes)
        hinge = toes_out @ _Y
        for bone, start, stop, rest in ((thigh, hip, knee, self.heads[calf]), (calf, knee, end, self.heads[ankle])):
            turns[bone] = frame(stop - start, hinge) @ frame(rest - self.heads[bone], _Y).T
            places[bone] = start
        rest = self.heads[ball] - self.heads[ankle]
        straight = turn(_Z, -math.atan2(rest[1], rest[0]))
        turns[ankle] = toes_out @ turn(_Y, -pitch) @ straight
        places[ankle] = end
        turns[ball] = toes_out @ turn(_Y, -numpy.maximum(pitch, 0.0)) @ straight  # toes stay on the ground
        places[ball] = end + turned(turns[ankle], rest)

    def hang_arm(self, turns, places, yaw, side, swing, elbow, aside=None):
        """Adds an arm to a trunk that is turned and placed. @param yaw of the shoulders; @param aside (P, 2) as
        gait.Pose has it"""
        sign = 1.0 if side == "l" else -1.0
        clavicle, upper, lower, hand = (f"{bone}_{side}" for bone in ("clavicle", "upperarm", "lowerarm", "hand"))
        lifted = numpy.clip((swing - _LIFTS_FROM) / (math.pi - _LIFTS_FROM), 0.0, 1.0)
        turns[clavicle] = turns["spine_03"] @ turn(_X, sign * (_LIFT * lifted - _DROOP))
        places[clavicle] = self._end(turns, places, "spine_03", clavicle)
        shoulder = self._end(turns, places, clavicle, upper)
        reach = math.dist(self.heads[upper], self.heads[lower]) + math.dist(self.heads[lower], self.heads[hand])
        held_out, roll = holding.hand(self.holds, side)
        # outwards enough for the hand to pass beside the hips
        room = (self.widest + 0.092 * self.scale + held_out - abs(self.heads[upper][1])) / reach
        out = sign * min(max(0.10, room), 0.34)
        shoulders = turn(_Z, yaw)

        further = numpy.zeros((1, 2)) if aside is None else sign * aside

        def hang(angle, part):
            return turned(shoulders, vector(numpy.sin(angle), out * (1.0 - 0.4 * numpy.abs(angle)) + further[:, part],
                                            -numpy.cos(angle)))

        down, fore = hang(swing, 0), hang(swing + elbow, 1)
        rest_upper = self.heads[lower] - self.heads[upper]
        rest_lower = self.heads[hand] - self.heads[lower]
        hinge, rest_hinge = -turned(shoulders, _Y), cross(rest_upper, rest_lower)
        turns[upper] = frame(down, hinge) @ frame(rest_upper, rest_hinge).T
        turns[lower] = frame(fore, hinge) @ frame(rest_lower, rest_hinge).T
        places[upper] = shoulder
        places[lower] = shoulder + turned(turns[upper], rest_upper)
        turns[hand] = turn(fore, -sign * roll) @ turns[lower]
        places[hand] = places[lower] + turned(turns[lower], rest_lower)
        self.bend_fingers(turns, places, side)

    def _plant(self, turns, places, poses):
        """A stick in the right hand goes with the left foot: while that stands, so does it. Its bone is the root, which
        nothing else hangs on."""
        ankle = poses.ankles[:, 1]
        lift = numpy.where(poses.planted[:, 1], 0.0, 0.35 * numpy.maximum(ankle[:, 1] - self.build.ankle, 0.0))
        tip = vector(ankle[:, 0] + STICK_AHEAD * self.scale, -self.widest - 0.13 * self.scale, lift)
        rest, top = self.stick_at_rest()
        # of the elbow: whatever holds the stick's top where it ends
        low, high = numpy.full(len(tip), 0.05), numpy.full(len(tip), 1.5)
        for _ in range(_ROUNDS):
            elbow = 0.5 * (low + high)
            self.hang_arm(turns, places, poses.shoulder_yaw, "r", 0.5 * poses.arms[:, 0, 0] + 0.05, elbow)
            along = self.grip(turns, places) - tip
            longer = length(along) > math.dist(top, rest)
            low, high = numpy.where(longer, low, elbow), numpy.where(longer, elbow, high)
        turns["Root"] = frame(along, _Y) @ frame(_Z, _Y).T
        places["Root"] = self.grip(turns, places) + turned(turns["Root"], self.heads["Root"] - top)

    def grip(self, turns, places):
        """Where the right hand holds something, m."""
        return places["hand_r"] + turned(turns["hand_r"], self.grip_at_rest() - self.heads["hand_r"])

    def grip_at_rest(self):
        return 0.5 * (self.tails["middle_01_r"] + self.heads["middle_01_r"])

    def stick_at_rest(self):
        """(tip, top) of a stick where it is made: beside the right foot, upright."""
        x, y = 0.12 * self.scale, -self.widest - 0.13 * self.scale
        return numpy.array([x, y, 0.0]), numpy.array([x, y, 0.84 * self.scale])

    def bend_fingers(self, turns, places, side):
        """Half closed and side by side, as hands hang."""
        hand = f"hand_{side}"
        if side not in self._curled:
            self._curled[side] = self._curl(side, hand, 1.0 if side == "l" else -1.0)
        for bone, parent, bent in self._curled[side]:
            places[bone] = self._end(turns, places, parent, bone)
            turns[bone] = turns[hand] @ bent

    def _curl(self, side, hand, sign):
        """[(bone, parent, how it is turned beside the hand)]: the same in all poses."""
        middle = self.tails[f"middle_01_{side}"] - self.heads[f"middle_01_{side}"]
        index, little = (self.heads[f"{finger}_01_{side}"] - self.heads[hand] for finger in ("index", "pinky"))
        back, found = cross(index, little) * sign, []
        for finger, curl in _FINGERS:
            own = self.tails[f"{finger}_01_{side}"] - self.heads[f"{finger}_01_{side}"]
            apart = math.acos(min(1.0, own @ middle / (numpy.linalg.norm(own) * numpy.linalg.norm(middle))))
            parent, bent = hand, turn(cross(own, middle), 0.75 * apart)
            for number in (1, 2, 3):
                bone = f"{finger}_0{number}_{side}"
                hinge = cross(self.tails[bone] - self.heads[bone], back)
                bent = bent @ turn(hinge, -curl * (0.7 if number == 1 else 1.0))
                found.append((bone, parent, bent))
                parent = bone
        return found + self._thumb(side, hand, index)

    def _thumb(self, side, hand, index):
        """Beside the index, not spread."""
        thumb, parent, found = f"thumb_0{{}}_{side}", hand, []
        own = self.tails[thumb.format(3)] - self.heads[thumb.format(1)]
        apart = math.acos(own @ index / (numpy.linalg.norm(own) * numpy.linalg.norm(index)))
        bent = turn(cross(own, index), _THUMB * apart)
        for number in (1, 2, 3):
            bone = thumb.format(number)
            found.append((bone, parent, bent))
            parent = bone
        return found

    def of_all(self, turns, places):
        """(..., B, 3, 4) where some bones are turned and placed: all others go with their parents."""
        found = numpy.zeros((*turns["pelvis"].shape[:-2], len(self.bodies.bones), 3, 4))
        for number, bone in enumerate(self.bodies.bones):
            if bone not in turns:
                parent = self.bodies.bones[self.bodies.parents[number]]
                turns[bone] = turns[parent]
                places[bone] = self._end(turns, places, parent, bone)
            found[..., number, :, :3] = turns[bone]
            found[..., number, :, 3] = places[bone] - turned(turns[bone], self.heads[bone])
        return found


def skinned(points, weights, matrices):
    """(P, V, 3): points in all poses. @param matrices (P, B, 3, 4)"""
    whole = numpy.concatenate([points, numpy.ones((len(points), 1))], axis=1).astype(numpy.float32)
    blended = numpy.tensordot(weights.astype(numpy.float32), matrices.astype(numpy.float32), (1, 1))  # V, P, 3, 4
    return numpy.einsum("vpij,vj->pvi", blended, whole)
