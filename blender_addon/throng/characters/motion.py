# SPDX-License-Identifier: Apache-2.0
"""From a clip's bones to the poses of a gait. Pure maths on numpy arrays: no Blender here.

Bones are 4 x 4 matrices (N, B, 4, 4) in the walker's frame: metres, x forward, y left, z up, the ground at 0.
"""
from dataclasses import dataclass, field

import numpy

from ..cast.gait import UNDER_BODY
from . import feet, legs

SAMPLES = 96       # of a cycle
FINE = 240         # of a foot's path; a multiple of the poses of a cycle
SHORTEST_STANCE = 0.2
LOWERING = 0.08    # of the leg: how far hips may sink for feet to stay where they are


@dataclass
class Body:
    """What does not change from clip to clip."""
    parents: list
    legs: list          # anatomy.Leg, right and left
    offspring: list     # of each leg: bones of (thigh without what follows, shin without the foot, foot)
    tolerance: float    # m: what is so near the ground touches it


@dataclass
class Cycle:
    """One cycle of a walk or a run, right and left step."""
    name: str
    bones: numpy.ndarray
    feet: list  # feet.Foot, right and left
    seconds: float
    notes: list = field(default_factory=list)
    mean: object = None  # of the bones relative to their parents, when it was asked for

    @property
    def stride(self):
        return 0.5 * (self.feet[0].stance.stride + self.feet[1].stance.stride)

    @property
    def stance(self):
        return 0.5 * (self.feet[0].stance.length + self.feet[1].stance.length)


@dataclass
class Plan:
    """How a clip is walked with a gait's stride."""
    stride: float
    cycle: Cycle
    share: float        # of the cycle that each foot is planted
    amplitude: float    # of all that is not legs, 1 as in the clip
    paths: list
    lowering: numpy.ndarray
    short: float        # m by which a leg is too short for its path at worst


def joints(bones, which):
    """(..., len(which), 3): where those bones begin."""
    return bones[..., :3, 3][..., which, :]


def locals_of(bones, parents):
    """Each bone relative to its parent."""
    result = bones.copy()
    for bone, parent in enumerate(parents):
        if parent >= 0:
            result[..., bone, :, :] = numpy.linalg.inv(bones[..., parent, :, :]) @ bones[..., bone, :, :]
    return result


def globals_of(relative, parents):
    """The inverse of locals_of; parents come first."""
    result = relative.copy()
    for bone, parent in enumerate(parents):
        if parent >= 0:
            result[..., bone, :, :] = result[..., parent, :, :] @ relative[..., bone, :, :]
    return result


def without_drift(bones, hips):
    """Root motion taken out of bones (N + 1, B, 4, 4), the last sample closing the cycle.

    @return (bones, metres (x, y) that the hips went)
    """
    way = (joints(bones[-1], hips) - joints(bones[0], hips)).mean(axis=0)[:2]
    still = bones.copy()
    still[:, :, :2, 3] -= (numpy.linspace(0.0, 1.0, len(bones))[:, None] * way)[:, None, :]
    return still, way


def amplitude_of(stride, natural):
    """Short steps swing less, and not all the way less; long ones swing as the clip does."""
    return min(1.0, 0.3 + 0.7 * stride / natural)


def _turner(cycle, side, leg, amplitude):
    """Extra rotation of a foot at a time of the clip: feet of short steps also roll less."""
    if amplitude > 0.999:
        return None
    flat, _ = legs.rotation_part(feet.at(cycle.bones[:, leg.foot], cycle.feet[side].under))

    def turned(time):
        now, _ = legs.rotation_part(feet.at(cycle.bones[:, leg.foot], time))
        blended, _ = legs.rotation_part(amplitude * now + (1.0 - amplitude) * flat)
        return blended @ now.swapaxes(-1, -2)

    return turned



def body_at(cycle, body, phase, amplitude):
    """The bones at a phase of the gait, or at many, legs not yet placed."""
    bones = legs.straightened(feet.at(cycle.bones, cycle.feet[0].under + phase - UNDER_BODY))
    if amplitude > 0.999:
        return bones
    if cycle.mean is None:
        all_ = locals_of(cycle.bones, body.parents)
        cycle.mean = legs.rescaled(all_.mean(axis=0), legs.rotation_part(all_)[1].mean(axis=0))
    relative = locals_of(bones, body.parents)
    relative = legs.rescaled(amplitude * relative + (1.0 - amplitude) * cycle.mean, legs.rotation_part(relative)[1])
    return globals_of(relative, body.parents)


def plan(cycle, body, stride):
    """How feet and hips go for a stride. A foot is planted as long as the clip says, or for less where
    the leg could not reach."""
    amplitude = amplitude_of(stride, cycle.stride)
    poses = body_at(cycle, body, numpy.arange(48) / 48.0, amplitude)
    reach = [_reach(poses[0], leg) for leg in body.legs]
    turners = [_turner(cycle, side, leg, amplitude) for side, leg in enumerate(body.legs)]
    share = min(cycle.stance, 0.75)
    while True:
        paths = [feet.fit(foot, stride, share, turned, min(1.0, 0.4 + 0.6 * amplitude), 3.0 * body.tolerance, FINE)
                 for foot, turned in zip(cycle.feet, turners)]
        needs = []
        for side, (path, leg, length) in enumerate(zip(paths, body.legs, reach)):
            wide = feet.at(poses[:, leg.hip, :3, 3], numpy.arange(FINE) / FINE + 0.5 * side)
            need = feet.lowering(path, wide, 0.995 * length) if length else numpy.zeros(FINE)
            needs.append(numpy.roll(need, side * (FINE // 2)))
        need = numpy.maximum(*needs)
        most = max(reach) * LOWERING
        best = Plan(stride, cycle, share, amplitude, paths, _eased(numpy.minimum(need, most)),
                    float(max(0.0, need.max() - most)))
        if best.short == 0.0 or share <= SHORTEST_STANCE:
            return best
        share = max(SHORTEST_STANCE, share - 0.02)


def _reach(pose, leg):
    """How long a leg is, stretched; 0 for legs without a knee, whose feet go where they like."""
    if leg.knee is None:
        return 0.0
    hip, knee, ankle = (pose[bone, :3, 3] for bone in (leg.hip, leg.knee, leg.foot))
    return float(numpy.linalg.norm(knee - hip) + numpy.linalg.norm(ankle - knee))


def _eased(need):
    """A smooth curve that is nowhere below the need: hips do not jerk."""
    width = FINE // 20
    top = numpy.max([numpy.roll(need, shift) for shift in range(-width, width + 1)], axis=0)
    return feet.smooth(feet.smooth(top, width), width)


def pose_of(the_plan, body, phase):
    """(B, 4, 4): the bones at a phase of the gait in [0, 1)."""
    bones = body_at(the_plan.cycle, body, phase, the_plan.amplitude)
    bones[:, 2, 3] -= the_plan.lowering[int(round(phase * FINE)) % FINE]
    for side, leg in enumerate(body.legs):
        path = the_plan.paths[side]
        index = int(round((phase - 0.5 * side) * FINE)) % FINE
        shown = legs.straightened(feet.at(the_plan.cycle.bones, path.time[index]))
        turned = _turner(the_plan.cycle, side, leg, the_plan.amplitude)
        place(bones, body, side, path.ankle[index], shown, numpy.eye(3) if turned is None else turned(path.time[index]))
    return bones


def place(bones, body, side, target, shown, turn):
    """Puts an ankle where it has to be, and the foot as it is `shown`, turned about the ankle. Changes `bones`."""
    leg, (thigh, shin, foot) = body.legs[side], body.offspring[side]
    hip, ankle = bones[leg.hip, :3, 3], bones[leg.foot, :3, 3]
    if leg.knee is None:
        reached = target
        bones[thigh] = legs.about(numpy.eye(3), ankle, target) @ bones[thigh]
    else:
        upper, lower, reached = legs.bend(hip.copy(), bones[leg.knee, :3, 3].copy(), ankle.copy(), target)
        bones[thigh] = upper @ bones[thigh]
        bones[shin] = lower @ bones[shin]
    bones[foot] = legs.about(turn, shown[leg.foot, :3, 3], reached) @ shown[foot]


def standing_from_walk(cycle, body):
    """Somebody who has no clip to stand with: the mean of the walk, both feet down."""
    still = body_at(cycle, body, 0.0, 0.0)
    for side, leg in enumerate(body.legs):
        foot = cycle.feet[side]
        shown = legs.straightened(feet.at(cycle.bones, foot.under))
        height = -feet.at(foot.sole, foot.under)[:, 2].min()
        place(still, body, side, numpy.array([0.0, feet.at(foot.ankle, foot.under)[1], height]), shown, numpy.eye(3))
    return still
