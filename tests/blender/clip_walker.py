# SPDX-License-Identifier: Apache-2.0
"""Writes motion capture of somebody who never was: proportions, stride, swing of the arms are known, whatever the rest
pose. Runs without Blender, too."""
import math

import numpy

THIGH, SHIN, ANKLE, WIDE = 0.40, 0.42, 0.09, 0.10  # m
TOE, BALL, LIFT = 0.16, 0.02, 0.08
STANCE, ROLLS = 0.6, 0.38  # of the cycle: how long feet are planted, and when heels rise
DROP = 0.05              # m that hips are below straight legs
NOD = 8.0                # degrees of the head, once a cycle
ELBOW = 30.0             # degrees
HIP = ANKLE + THIGH + SHIN
CMU = {"pelvis": "Hips", "belly": "LowerBack", "back": "Spine", "chest": "Spine1", "neck": "Neck", "head": "Head"}
CMU_SIDE = {"side": "{}HipJoint", "thigh": "{}UpLeg", "shin": "{}Leg", "foot": "{}Foot", "toe": "{}ToeBase",
            "collar": "{}Shoulder", "upper": "{}Arm", "fore": "{}ForeArm", "hand": "{}Hand"}
BIOVISION = {"pelvis": "Hips", "belly": "Abdomen", "back": "Chest", "chest": "Chest2", "neck": "Neck", "head": "Head"}
BIOVISION_SIDE = {"side": "{}Buttock", "thigh": "{}Hip", "shin": "{}Knee", "foot": "{}Ankle", "toe": "{}Toe",
                  "collar": "{}Collar", "upper": "{}Shoulder", "fore": "{}Elbow", "hand": "{}Wrist"}
RESTS = {"T": (0.0, 1.0, 0.0), "down": (0.0, 0.0, -1.0), "A": (0.0, math.sin(0.8), -math.cos(0.8))}


def about_y(angle):
    c, s = math.cos(angle), math.sin(angle)
    return numpy.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])


def about_z(angle):
    c, s = math.cos(angle), math.sin(angle)
    return numpy.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def between(one, other):
    """The smallest turn from one direction to another."""
    cross, cosine = numpy.cross(one, other), float(one @ other)
    k = numpy.array([[0.0, -cross[2], cross[1]], [cross[2], 0.0, -cross[0]], [-cross[1], cross[0], 0.0]])
    return numpy.eye(3) + k + k @ k / (1.0 + cosine)


class Walker:
    """x forward, y left, z up, m."""

    def __init__(self, stride=1.3, swing=24.0, rest="T", frames=32, rate=30.0, cycles=1, travels=True, heading=0.0,
                 backwards=False, closed=True, stands=False, roll=35.0, dips=False):
        self.stride, self.swing, self.frames, self.rate, self.cycles = stride, swing, frames, rate, cycles
        self.travels, self.heading, self.backwards, self.closed = travels, heading, backwards, closed
        self.stands, self.roll = stands, math.radians(roll)
        self.dips = dips  # toes go through the ground when they leave it
        self.joints = self._joints(numpy.array(RESTS[rest]))  # name: (parent, place, end)

    def _joints(self, arm):
        found = {"pelvis": (None, (0, 0, HIP), None)}
        for name, parent, z in (("belly", "pelvis", 0.08), ("back", "belly", 0.20), ("chest", "back", 0.34),
                                ("neck", "chest", 0.50)):
            found[name] = (parent, (0, 0, HIP + z), None)
        found["head"] = ("neck", (0.02, 0, HIP + 0.58), (0.04, 0, HIP + 0.80))
        for side, sign in (("Right", -1.0), ("Left", 1.0)):
            y = sign * WIDE
            toe = ((0.6 * TOE, y, BALL), (TOE, y, 0.0))
            out = arm * (1.0, sign, 1.0)
            shoulder = numpy.array([0.0, sign * 0.18, HIP + 0.45])
            for name, parent, place, end in (
                    ("side", "pelvis", (0, 0, HIP), None), ("thigh", "side", (0, y, HIP), None),
                    ("shin", "thigh", (0, y, ANKLE + SHIN), None), ("foot", "shin", (0, y, ANKLE), None),
                    ("toe", "foot", *toe), ("collar", "chest", (0, sign * 0.03, HIP + 0.45), None),
                    ("upper", "collar", shoulder, None), ("fore", "upper", shoulder + 0.30 * out, None),
                    ("hand", "fore", shoulder + 0.55 * out, shoulder + 0.65 * out)):
                found[f"{side} {name}"] = (parent if parent in found else f"{side} {parent}", place, end)
        return {name: (parent, numpy.array(place, float), None if end is None else numpy.array(end, float))
                for name, (parent, place, end) in found.items()}

    def _foot(self, phase):
        """(x, z) of an ankle beside the hips, how far the foot points down, and whether it is planted: from 0 on, at
        last on its toes."""
        if self.stands:
            return 0.0, ANKLE, 0.0, True
        reach = 0.5 * STANCE * self.stride
        if phase < STANCE:
            down = self.roll * max(0.0, (phase - ROLLS) / (STANCE - ROLLS))
            return *self._rolled(reach - phase * self.stride, down), down, True
        t = (phase - STANCE) / (1.0 - STANCE)
        s = t * t * (3.0 - 2.0 * t)
        x, z = self._rolled(-reach, self.roll)
        return x + (reach - x) * s, z + (ANKLE - z) * s + LIFT * math.sin(math.pi * t), self.roll * (1.0 - s), False

    def _rolled(self, x, down):
        """The ankle of a foot that stood flat there, and now on its toes."""
        ahead, up = 0.6 * TOE, ANKLE - BALL
        c, s = math.cos(down), math.sin(down)
        return x + ahead - ahead * c + up * s, BALL + ahead * s + up * c

    def _leg(self, ankle, hip):
        """(thigh, shin) as turns about y: a leg that hangs goes forward by a negative one."""
        x, z = ankle[0], hip - ankle[1]
        far = min(math.hypot(x, z), 0.9999 * (THIGH + SHIN))
        knee = math.acos((THIGH ** 2 + far ** 2 - SHIN ** 2) / (2.0 * THIGH * far))
        thigh = math.atan2(x, z) + knee
        shin = math.atan2(x - THIGH * math.sin(thigh), z - THIGH * math.cos(thigh))
        return -thigh, -shin

    def pose(self, frame):
        """({joint: turn from rest}, place of the pelvis) of a frame."""
        share = frame / self.frames
        phase = -share if self.backwards else share
        drop = DROP + (0.0 if self.stands else 0.03 * self.stride)
        turns = {name: numpy.eye(3) for name in ("pelvis", "belly", "back", "chest", "neck")}
        turns["head"] = about_y(math.radians(NOD) * math.sin(2.0 * math.pi * share))
        for side, later in (("Right", 0.0), ("Left", 0.5)):
            own = (phase - later) % 1.0
            x, z, down, planted = self._foot(own)
            thigh, shin = self._leg((x, z), HIP - drop)
            turns[f"{side} side"] = turns[f"{side} collar"] = numpy.eye(3)
            turns[f"{side} thigh"], turns[f"{side} shin"] = about_y(thigh), about_y(shin)
            turns[f"{side} foot"] = about_y(down)
            turns[f"{side} toe"] = about_y(down) if self.dips and not planted else numpy.eye(3)
            swing = math.radians(self.swing) * -math.cos(2.0 * math.pi * own)
            elbow = math.radians(ELBOW)
            for part, angle in (("upper", swing), ("fore", swing + elbow)):
                hangs = numpy.array([math.sin(angle), 0.0, -math.cos(angle)])
                turns[f"{side} {part}"] = between(self._along(side, part), hangs)
            turns[f"{side} hand"] = turns[f"{side} fore"]
        way = about_z(self.heading) @ (self.stride * phase if self.travels else 0.0, 0.0, 0.0)
        place = way + (0.0, 0.0, HIP - drop)
        return {name: about_z(self.heading) @ turn for name, turn in turns.items()}, place

    def _along(self, side, part):
        child = {"upper": "fore", "fore": "hand"}[part]
        way = self.joints[f"{side} {child}"][1] - self.joints[f"{side} {part}"][1]
        return way / numpy.linalg.norm(way)

    def count(self):
        return self.frames * self.cycles + (1 if self.closed else 0)


def _angles(turn):
    """Degrees (z, x, y) of a turn Rz Rx Ry."""
    x = math.asin(max(-1.0, min(1.0, turn[2, 1])))
    return [math.degrees(a) for a in (math.atan2(-turn[0, 1], turn[1, 1]), x, math.atan2(-turn[2, 0], turn[2, 2]))]


def bvh(walker, scale=100.0, names=(CMU, CMU_SIDE), z_up=False, named=lambda name: name):
    """The text of a .bvh file, y up and looking along z unless z is up."""
    axes = numpy.eye(3) if z_up else numpy.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]])
    order = list(walker.joints)
    children = {name: [each for each in order if walker.joints[each][0] == name] for name in order}
    numbers = lambda way: " ".join(f"{value:.6f}" for value in axes @ way * scale)
    lines, listed = ["HIERARCHY"], []

    def name_of(joint):
        side, _, part = joint.rpartition(" ")
        return named(names[1][part].format(side) if side else names[0][part])

    def write(joint, depth):
        parent, place, end = walker.joints[joint]
        listed.append(joint)
        pad = "\t" * depth
        lines.append(f"{pad}{'JOINT' if parent else 'ROOT'} {name_of(joint)}")
        lines.append(f"{pad}{{")
        lines.append(f"{pad}\tOFFSET {numbers(place - walker.joints[parent][1] if parent else 0.0 * place)}")
        lines.append(f"{pad}\tCHANNELS " + ("3 " if parent else "6 Xposition Yposition Zposition ")
                     + "Zrotation Xrotation Yrotation")
        for child in children[joint]:
            write(child, depth + 1)
        if end is not None:
            lines.extend([f"{pad}\tEnd Site", f"{pad}\t{{", f"{pad}\t\tOFFSET {numbers(end - place)}", f"{pad}\t}}"])
        lines.append(f"{pad}}}")

    write("pelvis", 0)
    lines += ["MOTION", f"Frames: {walker.count()}", f"Frame Time: {1.0 / walker.rate:.7f}"]
    lines += [_row(walker, frame, listed, axes, numbers) for frame in range(walker.count())]
    return "\n".join(lines) + "\n"


def _row(walker, frame, joints, axes, numbers):
    turns, place = walker.pose(frame)
    row = [numbers(place)]
    for joint in joints:
        parent = walker.joints[joint][0]
        local = turns[parent].T @ turns[joint] if parent else turns[joint]
        row += [f"{angle:.6f}" for angle in _angles(axes @ local @ axes.T)]
    return " ".join(row)
