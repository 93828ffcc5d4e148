# SPDX-License-Identifier: Apache-2.0
"""A simple skeleton of the cast's people: where its bones are in a pose, and how a person's mesh
hangs on them. Pure Python.

Bones are frames (head, axes) in the walker's own frame; each bone's y axis points along it, x to the left. Weights are
found rather than painted: a vertex hangs on the one or two bones that best explain where it goes over a set of poses.
"""
from dataclasses import dataclass
from functools import lru_cache

from ..cast import gait, people
from ..cast.figure import Figure
from ..cast.mesh_builder import Plan, add, cross, scale, sub, turn_y, turn_z, unit

PARENTS = {"hips": None, "spine": "hips", "head": "spine",
           **{f"{part}.{side}": parent.format(side) for side in "RL"
              for part, parent in (("upper_arm", "spine"), ("forearm", "upper_arm.{}"), ("thigh", "hips"),
                                   ("shank", "thigh.{}"), ("foot", "shank.{}"))}}
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
        return add(self.head,
                   add(scale(self.left, local[0]), add(scale(self.along, local[1]), scale(self.ahead, local[2]))))

    def local(self, point):
        away = sub(point, self.head)
        return tuple(sum(a * b for a, b in zip(away, axis)) for axis in (self.left, self.along, self.ahead))


def bone_between(head, tail, beside):
    """From head to tail, its x axis as much `beside` as that allows."""
    along = unit(sub(tail, head))
    left = unit(sub(beside, scale(along, sum(a * b for a, b in zip(beside, along)))))
    return Bone(head, tail, left, along, cross(left, along))


def _posed(person, pose):
    return Figure(person, pose, people.build_of(person))


def bones_of(person, pose):
    """All bones of a person in a pose of cast/gait.py, {name: Bone}."""
    figure = _posed(person, pose)
    across = lambda share: turn_z((0.0, 1.0, 0.0), figure.yaw(share))
    spine = [figure.along(height) for height in (0.0, 0.17, 0.515, 0.80)]
    bones = {"hips": bone_between(spine[0], spine[1], across(0.0)),
             "spine": bone_between(spine[1], spine[2], across(1.0)),
             "head": bone_between(spine[2], spine[3], turn_z((0.0, 1.0, 0.0), 0.4 * figure.yaw(1.0)))}
    for side, (shoulder, elbow, wrist), (hip, knee, ankle), foot in zip("RL", figure.arms, figure.legs, pose.feet):
        bones[f"upper_arm.{side}"] = bone_between(shoulder, elbow, across(1.0))
        bones[f"forearm.{side}"] = bone_between(elbow, wrist, across(1.0))
        bones[f"thigh.{side}"] = bone_between(hip, knee, (0.0, 1.0, 0.0))
        bones[f"shank.{side}"] = bone_between(knee, ankle, (0.0, 1.0, 0.0))
        bones[f"foot.{side}"] = bone_between(ankle, add(ankle, turn_y((0.16 * figure.s, 0.0, 0.0), -foot.pitch)),
                                      (0.0, 1.0, 0.0))
    return bones


@lru_cache(maxsize=16)
def plan_of(person):
    """How the person's mesh is made up, at full detail, whatever the pose."""
    build = people.build_of(person)
    walks = [gait.walk_pose(index / 4.0, build, gait.gait_of(gait.NORMAL_STRIDE)) for index in range(4)]
    meshes = [_posed(person, pose).mesh for pose in (rest_pose(person), *walks)]
    return Plan(meshes[0].parts, [mesh.rings for mesh in meshes], 0)


def vertices_of(person, pose):
    return [tuple(point) for point in plan_of(person).vertices(_posed(person, pose).mesh.rings).tolist()]


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
    """For each vertex of the person's mesh [(bone, weight)], one or two; weights add up to one. `strides`: a tuple."""
    rest = bones_of(person, rest_pose(person))
    poses = _training_poses(person, strides)
    skeletons = [bones_of(person, pose) for pose in poses]
    figures = [vertices_of(person, pose) for pose in poses]
    result = []
    for index, vertex in enumerate(vertices_of(person, rest_pose(person))):
        taken = {}  # where each bone would take it
        for name in BONES:
            local = rest[name].local(vertex)
            taken[name] = [bones[name].place(local) for bones in skeletons]
        result.append(_blend([figure[index] for figure in figures], taken))
    return result


def _blend(goes, taken):
    """The bone that takes a vertex nearest to where it goes, and another where that helps: [(bone, weight)]."""
    best = min(BONES, key=lambda name: _error(taken[name], goes))
    least, blend = _error(taken[best], goes), [(best, 1.0)]
    for other in BONES:
        share = _share(goes, taken[best], taken[other]) if other != best else 0.0
        if share <= 0.02:
            continue
        mixed = [tuple(b + (o - b) * share for b, o in zip(bs, os)) for bs, os in zip(taken[best], taken[other])]
        error = _error(mixed, goes)
        if error < 0.8 * least:
            least, blend = error, [(best, 1.0 - share), (other, share)]
    return blend


def _share(goes, best, other):
    """Of another bone, beside the best: the one with which both together come nearest."""
    apart = _error(other, best)
    if apart < 1e-12:
        return 0.0
    share = sum((g - b) * (o - b) for gs, bs, os in zip(goes, best, other) for g, b, o in zip(gs, bs, os)) / apart
    return min(1.0, max(0.0, share))
