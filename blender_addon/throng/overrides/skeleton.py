# SPDX-License-Identifier: Apache-2.0
"""A simple skeleton of the cast's people: where its bones are in a pose, and how a person's mesh hangs on them. Pure Python.

Bones are frames (head, axes) in the walker's own frame; each bone's y axis points along it, x to the left. Weights are found rather than
painted: a vertex hangs on the one or two bones that best explain where it goes over a set of poses.
"""
from dataclasses import dataclass
from functools import lru_cache

from ..cast import gait, people
from ..cast.mesh_builder import add, cross, scale, sub, turn_y, turn_z, unit

PARENTS = {"hips": None, "spine": "hips", "head": "spine",
           **{f"{part}.{side}": parent.format(side) for side in "RL" for part, parent in
              (("upper_arm", "spine"), ("forearm", "upper_arm.{}"), ("thigh", "hips"), ("shank", "thigh.{}"), ("foot", "shank.{}"))}}
BONES = tuple(PARENTS)


@dataclass(frozen=True)
class Bone:
    head: tuple
    tail: tuple
    left: tuple   # x axis
    along: tuple  # y axis
    ahead: tuple  # z axis

    def place(self, local):
        """A point of the bone's own frame."""
        return add(self.head, add(scale(self.left, local[0]), add(scale(self.along, local[1]), scale(self.ahead, local[2]))))

    def local(self, point):
        away = sub(point, self.head)
        return tuple(sum(a * b for a, b in zip(away, axis)) for axis in (self.left, self.along, self.ahead))


def _bone(head, tail, beside):
    along = unit(sub(tail, head))
    left = unit(sub(beside, scale(along, sum(a * b for a, b in zip(beside, along)))))
    return Bone(head, tail, left, along, cross(left, along))


def _arm(person, pose, side, index, along, shoulder_yaw, size):
    """Shoulder, elbow and wrist, as cast/people.py hangs arms."""
    swing, elbow = pose.arms[index]
    out = 0.11 * side + 0.05 * side * (person.girth - 1.0)

    def hang(angle):
        down = turn_y((0.0, 0.0, -1.0), -angle)
        return turn_z(unit((down[0], down[1] + out * (1.0 - 0.4 * abs(angle)), down[2])), shoulder_yaw)

    shoulder = add(along(0.435), turn_z((-0.005 * size, side * person.shoulders * 0.465 * size, 0.0), shoulder_yaw))
    elbow_at = add(shoulder, scale(hang(swing), 0.285 * size))
    wrist = add(elbow_at, scale(unit(add(hang(swing + elbow), (0.0, -0.09 * side, 0.0))), 0.245 * size))
    return shoulder, elbow_at, wrist


def bones_of(person, pose):
    """All bones of a person in a pose of cast/gait.py, {name: Bone}."""
    build = people.build_of(person)
    size = build.thigh / gait.Build().thigh
    up = turn_y((0.0, 0.0, 1.0), pose.lean)
    along = lambda height: add(pose.pelvis, scale(up, height * size))
    across = lambda yaw: turn_z((0.0, 1.0, 0.0), yaw)
    bones = {"hips": _bone(along(0.0), along(0.17), across(pose.pelvis_yaw)), "spine": _bone(along(0.17), along(0.515), across(pose.shoulder_yaw)),
             "head": _bone(along(0.515), along(0.80), across(0.4 * pose.shoulder_yaw))}
    for index, (side, letter) in enumerate(((-1, "R"), (1, "L"))):
        shoulder, elbow, wrist = _arm(person, pose, side, index, along, pose.shoulder_yaw, size)
        bones[f"upper_arm.{letter}"] = _bone(shoulder, elbow, across(pose.shoulder_yaw))
        bones[f"forearm.{letter}"] = _bone(elbow, wrist, across(pose.shoulder_yaw))
        foot, spread = pose.feet[index], side * 0.5 * build.hip_width
        hip = add(pose.pelvis, turn_z((0.0, spread * person.hips, -0.02 * size), pose.pelvis_yaw))
        ankle = (foot.ankle[0], spread * 0.72 + 0.25 * pose.pelvis[1], foot.ankle[1])
        knee_x, knee_z = gait.knee_of((hip[0], hip[2]), (ankle[0], ankle[2]), build)
        knee = (knee_x, 0.5 * (hip[1] + ankle[1]), knee_z)
        bones[f"thigh.{letter}"] = _bone(hip, knee, across(0.0))
        bones[f"shank.{letter}"] = _bone(knee, ankle, across(0.0))
        bones[f"foot.{letter}"] = _bone(ankle, add(ankle, turn_y((0.16 * size, 0.0, 0.0), -foot.pitch)), across(0.0))
    return bones


def figure_of(person, pose):
    """The person's mesh in a pose: `vertices`, `faces`, and a material for each face. Whatever the pose, vertices are the same in number and order."""
    return people.build_figure(person, pose)


def rest_pose(person):
    return gait.idle_pose(people.build_of(person))


def _training_poses(person, strides):
    build = people.build_of(person)
    middle = gait.gait_of(sorted(strides)[len(strides) // 2])
    return [gait.walk_pose(index / 8.0, build, middle) for index in range(8)] + \
        [gait.standing_pose("phone", 0.25, build), gait.standing_pose("shift", 0.5, build)]


def _error(a, b):
    return sum((x - y) ** 2 for p, q in zip(a, b) for x, y in zip(p, q))


@lru_cache(maxsize=8)
def weights_of(person, strides):
    """The person's mesh at rest, and for each of its vertices [(bone, weight)], one or two; weights add up to one. `strides` is a tuple."""
    rest = bones_of(person, rest_pose(person))
    mesh = figure_of(person, rest_pose(person))
    poses = _training_poses(person, strides)
    skeletons = [bones_of(person, pose) for pose in poses]
    figures = [figure_of(person, pose).vertices for pose in poses]
    result = []
    for index, vertex in enumerate(mesh.vertices):
        goes = [figure[index] for figure in figures]
        taken = {}
        for name in BONES:
            local = rest[name].local(vertex)
            taken[name] = [bones[name].place(local) for bones in skeletons]
        best = min(BONES, key=lambda name: _error(taken[name], goes))
        least, blend = _error(taken[best], goes), [(best, 1.0)]
        for other in BONES:
            apart = _error(taken[other], taken[best])
            if other == best or apart < 1e-12:
                continue
            share = sum((g - b) * (o - b) for gs, bs, os in zip(goes, taken[best], taken[other]) for g, b, o in zip(gs, bs, os)) / apart
            share = min(1.0, max(0.0, share))
            mixed = [tuple(b + (o - b) * share for b, o in zip(bs, os)) for bs, os in zip(taken[best], taken[other])]
            error = _error(mixed, goes)
            if error < 0.8 * least and share > 0.02:
                least, blend = error, [(best, 1.0 - share), (other, share)]
        result.append(blend)
    return mesh, result
