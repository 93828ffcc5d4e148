# SPDX-License-Identifier: Apache-2.0
"""Simple figures that walk, stand and sit: a mesh for each pose. They look along +x, and stand on z = 0."""
from __future__ import annotations

import dataclasses
import math

import numpy

from ..cast import gait, sitting

HEIGHT = 1.75
HIP, KNEE, SHOULDER = 0.92, 0.46, 1.42            # heights, m
THIGH, SHIN, UPPER_ARM, FOREARM, FOOT = HIP - KNEE, KNEE - 0.07, 0.29, 0.27, 0.17
HIP_HALF, SHOULDER_HALF = 0.09, 0.19              # half breadths, m
SIDES, RINGS = 8, 3
PHASES = 12                                       # poses of a cycle of two steps
# In the course of a cycle, from the moment that the foot is ahead: the foot is planted for six tenths of it.
PLANTED = 0.6
KNEE_WALK, KNEE_MOST = math.radians(8), math.radians(55)
ARM_SHARE, ELBOW = 0.75, math.radians(18)         # arms swing less than legs

SKIN, TROUSERS, TOP, SHOES = range(4)

Vector = numpy.ndarray


@dataclasses.dataclass(frozen=True)
class Mesh:
    points: numpy.ndarray   # n x 3
    normals: numpy.ndarray  # n x 3
    faces: numpy.ndarray    # m x 3
    parts: numpy.ndarray    # of each face: SKIN, TROUSERS, TOP or SHOES


def _limb(part: int, start: Vector, end: Vector, thick: float, thin: float) -> Mesh:
    """A round bar between two points, with round ends."""
    axis = end - start
    length = float(numpy.linalg.norm(axis)) or 1e-6
    axis = axis / length
    side = numpy.cross(axis, [0.0, 1.0, 0.0] if abs(axis[1]) < 0.9 else [1.0, 0.0, 0.0])
    side /= numpy.linalg.norm(side)
    other = numpy.cross(axis, side)
    angles = numpy.linspace(0, 2 * math.pi, SIDES, endpoint=False)
    circle = numpy.cos(angles)[:, None] * side + numpy.sin(angles)[:, None] * other
    bends = numpy.linspace(-0.5 * math.pi, 0.5 * math.pi, 2 * RINGS)
    points, normals = [], []
    for number, bend in enumerate(bends):
        centre, radius = (start, thick) if number < RINGS else (end, thin)
        normal = math.cos(bend) * circle + math.sin(bend) * axis
        points.append(centre + radius * normal)
        normals.append(normal)
    faces = []
    for ring in range(2 * RINGS - 1):
        for here in range(SIDES):
            low, next_low = ring * SIDES + here, ring * SIDES + (here + 1) % SIDES
            faces += [(low, next_low, next_low + SIDES), (low, next_low + SIDES, low + SIDES)]
    return Mesh(numpy.concatenate(points), numpy.concatenate(normals), numpy.array(faces), numpy.full(len(faces), part))


def _scaled(mesh: Mesh, centre: Vector, scale: Vector) -> Mesh:
    normals = mesh.normals / scale
    return Mesh(centre + (mesh.points - centre) * scale,
                normals / numpy.linalg.norm(normals, axis=1)[:, None], mesh.faces,
                mesh.parts)


def _joined(parts: list[Mesh]) -> Mesh:
    before = numpy.cumsum([0] + [len(part.points) for part in parts])
    return Mesh(numpy.concatenate([part.points for part in parts]), numpy.concatenate([part.normals for part in parts]),
                numpy.concatenate([part.faces + offset for part, offset in zip(parts, before)]),
                numpy.concatenate([part.parts for part in parts]))


def _along(angle: float, length: float) -> Vector:
    """Down, turned forwards by an angle."""
    return numpy.array([math.sin(angle), 0.0, -math.cos(angle)]) * length


def _leg_angles(phase: float, swing: float) -> tuple[float, float]:
    """Of the thigh (forwards) and of the knee, in a cycle that begins with the foot ahead."""
    phase %= 1.0
    if phase < PLANTED:
        along = phase / PLANTED
        # The foot stays where it is while the body goes on: it goes back evenly.
        return math.asin(math.sin(swing) * (1 - 2 * along)), KNEE_WALK * math.sin(math.pi * along)
    along = (phase - PLANTED) / (1 - PLANTED)
    return -swing * math.cos(math.pi * along), KNEE_WALK + (KNEE_MOST - KNEE_WALK) * math.sin(math.pi * along)


@dataclasses.dataclass(frozen=True)
class _Side:
    """Joints of a leg and an arm."""
    hip: Vector
    knee: Vector
    ankle: Vector
    toe: Vector
    shoulder: Vector
    elbow: Vector
    hand: Vector


def _body(sides: list[_Side], waist: Vector, chest: Vector, neck: Vector, head: Vector) -> Mesh:
    parts = []
    for side in sides:
        parts += [_limb(TROUSERS, side.hip, side.knee, 0.095, 0.065),
                  _limb(TROUSERS, side.knee, side.ankle, 0.062, 0.042),
                  _limb(SHOES, side.ankle, side.toe, 0.045, 0.035),
                  _limb(TOP, side.shoulder, side.elbow, 0.057, 0.045), _limb(SKIN, side.elbow, side.hand, 0.042, 0.038)]
    parts.append(_scaled(_limb(TOP, waist, chest, 0.115, 0.13), 0.5 * (chest + waist),
                         numpy.array([0.88, 1.45, 1.0])))
    parts += [_limb(SKIN, neck, head, 0.05, 0.05),
              _scaled(_limb(SKIN, head - [0, 0, 0.02], head + [0, 0, 0.02], 0.095, 0.095), head,
                      numpy.array([1, 0.85, 1]))]
    mesh = _joined(parts)
    # The lower foot is on the ground.
    return Mesh(mesh.points - [0.0, 0.0, mesh.points[:, 2].min()], mesh.normals, mesh.faces, mesh.parts)


def figure(phase: float | None, stride: float = 1.4) -> Mesh:
    """A pose of the walk with so many metres a cycle, or somebody who stands."""
    reach = 0.0 if phase is None else min(stride * PLANTED / (2 * (HIP - 0.02)), 0.8)
    swing = math.asin(reach)
    sides = []
    for sign, offset in ((1, 0.0), (-1, 0.5)):
        thigh, knee = (0.0, 0.0) if phase is None else _leg_angles(phase + offset, swing)
        arm = 0.0 if phase is None else -ARM_SHARE * thigh
        hip = numpy.array([0.0, sign * HIP_HALF, HIP])
        joint = hip + _along(thigh, THIGH)
        ankle = joint + _along(thigh - knee, SHIN)
        toe = ankle + numpy.array([FOOT * math.cos(0.5 * knee), 0.0, -0.02 - FOOT * math.sin(0.5 * knee)])
        shoulder = numpy.array([0.0, sign * SHOULDER_HALF, SHOULDER])
        elbow = shoulder + _along(arm, UPPER_ARM) + [0.0, sign * 0.03, 0.0]
        sides.append(_Side(hip, joint, ankle, toe, shoulder, elbow, elbow + _along(arm + ELBOW, FOREARM)))
    return _body(sides, numpy.array([0.0, 0.0, HIP + 0.04]), numpy.array([0.0, 0.0, SHOULDER - 0.07]),
                 numpy.array([0.0, 0.0, SHOULDER + 0.04]), numpy.array([0.01, 0.0, HEIGHT - 0.115]))


def seated_figure(clip: int, share: float) -> Mesh:
    """A pose of somebody who has a seat, whose middle is over (0, 0). @param clip by number, share as in
    cast.sitting"""
    build = gait.Build(thigh=THIGH, shank=SHIN, ankle=0.07)
    pose = sitting.seated_pose(clip, share, build)
    middle = numpy.array(pose.pelvis) - [0.0, 0.0, gait.HIP_DROP]
    trunk = numpy.array([math.sin(pose.lean), -math.sin(pose.tilt), math.cos(pose.lean) * math.cos(pose.tilt)])
    up = lambda height: middle + trunk * (height - HIP)
    sides = []
    for number, sign in ((1, 1), (0, -1)):  # left, right
        aside = numpy.array([0.0, sign, 0.0])
        (x, z), hip, shoulder = pose.feet[number].ankle, middle + HIP_HALF * aside, up(SHOULDER) + SHOULDER_HALF * aside
        knee_x, knee_z = gait.knee_of((hip[0], hip[2]), (x, z), build)
        (swing, bend), (upper, fore) = pose.arms[number], pose.aside[number]
        elbow = shoulder + _outwards(swing, upper * aside, UPPER_ARM)
        ankle = numpy.array([x, hip[1], z])
        sides.append(_Side(hip, numpy.array([knee_x, hip[1], knee_z]), ankle, ankle + [FOOT, 0.0, -0.02], shoulder,
                           elbow, elbow + _outwards(swing + bend, fore * aside, FOREARM)))
    return _body(sides, up(HIP + 0.04), up(SHOULDER - 0.07), up(SHOULDER + 0.04), up(HEIGHT - 0.115) + [0.01, 0.0, 0.0])


def _outwards(angle: float, aside: Vector, length: float) -> Vector:
    way = _along(angle, 1.0) + aside
    return way * (length / numpy.linalg.norm(way))


def seated_poses(clips: int) -> list[tuple[str, Mesh]]:
    """All of the first so many clips, in the order of cast.sitting.poses_of()."""
    return [(f"{clip.name}{index}", seated_figure(number, index / (clip.poses - clip.there_and_back)))
            for number, clip in enumerate(sitting.CLIPS[:clips]) for index in range(clip.poses)]
