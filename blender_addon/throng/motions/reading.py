# SPDX-License-Identifier: Apache-2.0
"""From a take to what it does: checked, its cycle found, its skeleton taken away. No Blender here.

The feet of a skeleton have no soles. Some are made: heel, ball and toes on the ground that its feet stand on at rest.
From there on a clip is read as own characters' clips are (characters/clips.py).
"""
from dataclasses import dataclass, field, replace

import numpy

from ..cast import BEATS
from ..characters import CharacterError, clips, feet, legs, motion
from ..characters.skin import Skin
from . import MotionError, cycles, matching, takes
from .motion import STANDS, TRUNK, WALKS, Motion

ANKLE = 0.045        # of the height: an ankle over the ground, where no bone is below it
HEEL, WIDE = 0.035, 0.02
FORWARDS = 55.0      # degrees from where the body looks to where it goes, at most
ROUND = 80.0 / 24.0  # s, of a standing clip's round: of a longer clip the stillest stretch is taken
STILL = 0.05         # of the height: feet that move further do not stand
UPRIGHT = 0.85       # of how high hips are at rest
STRAIGHT, BENT = 0.10, 0.35  # sines of an elbow that does not tell its axis, and of one that does


@dataclass
class Report:
    """What was found, for whoever brings the clip."""
    lines: list = field(default_factory=list)
    notes: list = field(default_factory=list)


@dataclass
class Body:
    """A take in metres that looks along x at rest, z up, and which of its bones is what."""
    take: takes.Take
    found: matching.Match
    height: float
    soles: list  # of each foot [(bone, point at rest)]
    report: Report

    @property
    def leg(self):
        return cycles.leg_of(self.take, self.found)


def body_of(take, feet_names=(), height=0.0, z_up=False):
    """The Body of a take. @param z_up whether z is known to be up; @param height m of who was recorded, where it is
    known. Raises CharacterError."""
    take = takes.checked(take)
    if not z_up:
        take = takes.upright(take, matching.feet_by_name(take.names), _as_list(matching.high_by_name(take.names)))
    tall, unit = takes.height_of(take)
    tall = height or tall
    points, _ = takes.tips_of(take)
    take = takes.scaled(take, tall / float(numpy.ptp(points[:, 2])))
    try:
        found = matching.match(take, feet_names)
    except CharacterError as error:
        raise MotionError(str(error) if take.name in str(error) else f"{take.name}: {error}") from None
    take = takes.turned(take, found.forward.T)
    found.forward = numpy.eye(3)
    report = Report(notes=list(found.notes))
    why = "as told" if height else f"its numbers are {unit}" if unit else "its unit is not known: taken as so tall"
    report.lines.append(f"{take.name}: {tall:.2f} m tall ({why}), {len(take.frames)} frames, {take.rate:.4g} a second")
    report.lines += matching.lines_of(take, found)
    return Body(take, found, tall, _soles(take, found, tall), report)


def _as_list(bone):
    return None if bone is None else [bone]


def _soles(take, found, tall):
    bones, soles = matching.Bones(take), []
    for leg in found.legs:
        ankle = take.rest[leg.foot, :3, 3]
        below = [point for point, bone in zip(bones.points, bones.main) if leg.foot in bones.chain(bone)]
        floor = min(point[2] for point in below)
        floor = floor if floor < ankle[2] - 0.015 * tall else ankle[2] - ANKLE * tall
        way = matching.toe_direction(bones, leg.foot)
        length = 0.09 * tall if way is None else float(numpy.linalg.norm(way))
        ahead = numpy.array([1.0, 0.0]) if way is None else way / length
        toe = _toe_bone(bones, leg.foot, ahead, length)
        ball = 0.7 * length if toe is None else float((bones.heads[toe] - ankle)[:2] @ ahead)
        aside = WIDE * tall * numpy.array([-ahead[1], ahead[0]])
        soles.append([(bone, numpy.array([*(ankle[:2] + along * ahead + sign * aside), floor]))
                      for bone, along in ((leg.foot, -HEEL * tall), (leg.foot, ball),
                                          (leg.foot if toe is None else toe, max(length, ball)))
                      for sign in (-1.0, 1.0)])
    return soles


def _toe_bone(bones, foot, ahead, length):
    """The bone that toes bend with, or None."""
    reach = {bone: float((bones.heads[bone] - bones.heads[foot])[:2] @ ahead) for bone in bones.children(foot)}
    fitting = [bone for bone, along in reach.items() if 0.3 * length < along < 1.01 * length]
    return max(fitting, key=reach.get, default=None)


class _Stage:
    """A body as characters' clips are read from (characters.rig.Stage)."""

    def __init__(self, body):
        self.names, self.parents, self.rest = list(body.take.names), list(body.take.parents), body.take.rest
        points, bones = takes.tips_of(body.take)
        for sole in body.soles:
            points = numpy.concatenate([points, [point for _, point in sole]])
            bones = numpy.concatenate([bones, [bone for bone, _ in sole]])
        which, much = numpy.zeros((len(points), 4), int), numpy.zeros((len(points), 4))
        which[:, 0], much[:, 0] = bones, 1.0
        self._skin = Skin(points, which, much)

    def skin(self):
        return self._skin

    def rest_pose(self):
        return self.rest


class _Reader(clips.Reader):
    """Of a body whose cycle has been found."""

    def __init__(self, body, straight):
        stage = _Stage(body)
        names = tuple(body.take.names[leg.foot] for leg in body.found.legs)
        super().__init__(stage, clips.Options(feet=names, height=float(numpy.ptp(stage.skin().rest[:, 2]))))
        self.straight = straight
        self.turn_to(0.0)

    def cycle_bones(self, clip):
        return _closed(self.straight.bones), self.straight.seconds, self.straight.notes

    def soles(self, bones):
        """As they are over the bones, but for what of them goes through the ground: these are no real soles."""
        found = super().soles(bones)
        ground = numpy.percentile(numpy.minimum(*(points[..., 2].min(axis=1) for points in found)), 20.0)
        for points in found:
            points[..., 2] = numpy.maximum(points[..., 2], ground)
        return found


def _closed(samples):
    """What is left at the seam, spread over the cycle."""
    share = numpy.linspace(0.0, 1.0, len(samples))[:, None, None, None]
    return legs.straightened(samples + share * (samples[0] - samples[-1]))[:-1]


def walk_of(body):
    """The Motion of a take that walks. Raises MotionError."""
    take = body.take
    straight = cycles.straight(take, body.found)
    if abs(straight.aside) > FORWARDS:
        raise MotionError(f"{take.name} does not walk forwards: it goes {abs(straight.aside):.0f} degrees aside of "
                          "where the body looks")
    found = _Reader(body, straight).cycle(take)
    if isinstance(found, str):
        raise MotionError(f"{take.name} does not walk: {found}")
    travels = straight.way > cycles.TRAVELS * body.leg
    stride = straight.way if travels else found.stride
    body.report.lines.append(f"walks: a stride of {stride:.2f} m in {straight.seconds:.2f} s, feet planted "
                             f"{100.0 * found.stance:.0f} % of it")
    body.report.notes += [note for note in found.notes if note not in body.report.notes]
    stance = tuple((foot.stance.down, foot.stance.length) for foot in found.feet)
    made = _motion(body, found.bones, [foot.under for foot in found.feet], WALKS)
    return replace(made, stride=float(stride), stance=stance)


def stand_of(body):
    """The Motion of a take that stands: as many moments of it as a cast has beats. Raises MotionError."""
    take = body.take
    span = min(len(take.frames) - 1.0, ROUND * take.rate)
    first = _stillest(body, int(span))
    frames = take.at(first + span * numpy.arange(BEATS) / BEATS)
    looks = float(cycles.facing(take, body.found, frames).mean())
    frames = cycles.turn(numpy.full(1, -looks)) @ frames
    ankles = motion.joints(frames, [leg.foot for leg in body.found.legs])
    frames[:, :, :2, 3] -= ankles.mean(axis=(0, 1))[:2]
    moved = float(numpy.linalg.norm(numpy.ptp(ankles, axis=0), axis=1).max())
    if moved > STILL * body.height:
        raise MotionError(f"{take.name} does not stand: its feet move by {100.0 * moved:.0f} cm")
    high = _high(frames, body.found) / _high(take.rest[None], body.found)
    if high < UPRIGHT:
        raise MotionError(f"{take.name} does not stand upright: its hips are at {100.0 * high:.0f} % of their height "
                          "at rest")
    body.report.lines.append(f"stands: from {first / take.rate:.2f} to {(first + span) / take.rate:.2f} s")
    return _motion(body, frames, [0.0, 0.0], STANDS)


def _high(frames, found):
    middle = lambda bones: motion.joints(frames, bones)[..., 2].mean()
    return float(middle([leg.thigh for leg in found.legs]) - middle([leg.foot for leg in found.legs]))


def _stillest(body, span):
    """Where feet move least over so many frames."""
    ankles = motion.joints(body.take.frames, [leg.foot for leg in body.found.legs])
    starts = range(0, max(1, len(ankles) - span), max(1, int(0.1 * body.take.rate)))
    return min(starts, key=lambda start: float(numpy.ptp(ankles[start:start + span + 1], axis=0).max()))


def _motion(body, bones, under, kind):
    """@param bones (N, B, 4, 4) in the walker's frame; @param under of each foot when it is flat on the ground"""
    rest, _ = legs.rotation_part(body.take.rest)
    now, _ = legs.rotation_part(bones)
    turns = now @ rest.swapaxes(-1, -2)
    hips = motion.joints(bones, [leg.thigh for leg in body.found.legs]).mean(axis=1)
    limb_turns = turns[:, [leg.thigh for leg in body.found.legs]]
    limbs = numpy.stack([_limb(bones, (leg.thigh, leg.shin, leg.foot), limb_turns[:, side, :, 1])
                         for side, leg in enumerate(body.found.legs)], axis=1)
    soles = numpy.stack([_foot(body, turns, leg.foot, time) for leg, time in zip(body.found.legs, under)], axis=1)
    chest = turns[:, body.found.trunk[-1]]
    arms = numpy.stack([_arm(bones, chest, arm) if arm else numpy.zeros((len(bones), 3, 3))
                        for arm in body.found.arms], axis=1)
    return Motion(body.take.name, kind, _trunk(turns, body.found), limbs, soles, arms,
                  (hips - hips.mean(axis=0)) / body.leg, leg=body.leg)


def _unit(vectors):
    return vectors / numpy.maximum(numpy.linalg.norm(vectors, axis=-1, keepdims=True), 1e-12)


def _limb(bones, chain, axis):
    """(N, 3, 3)"""
    first, second, third = (bones[:, bone, :3, 3] for bone in chain)
    return numpy.stack([_unit(second - first), _unit(third - second), axis], axis=1)


def _trunk(turns, found):
    """(N, len(TRUNK), 3, 3): the trunk's bones in even steps from pelvis to chest, neck and head."""
    def along(share):
        place = share * (len(found.trunk) - 1)
        low = min(int(place), max(0, len(found.trunk) - 2))
        high, rest = found.trunk[min(low + 1, len(found.trunk) - 1)], place - low
        return legs.rotation_part(turns[:, found.trunk[low]] * (1.0 - rest) + turns[:, high] * rest)[0]

    chest = along(1.0)
    head = chest if found.head is None else turns[:, found.head]
    neck = turns[:, found.neck[len(found.neck) // 2]] if found.neck else legs.rotation_part(chest + head)[0]
    steps = [along(number / 3.0) for number in range(4)]
    assert len(steps) + 2 == len(TRUNK)
    return numpy.stack([*steps, neck, head], axis=1)


def _foot(body, turns, foot, under):
    """(N, 3, 3): of a foot that looks along x, flat on the ground when it is `under` the body: how it is at rest tells
    less than how it stands."""
    way = matching.toe_direction(matching.Bones(body.take), foot)
    angle = 0.0 if way is None else float(numpy.arctan2(way[1], way[0]))
    foot_turns = turns[:, foot] @ cycles.turn(numpy.array([angle]))[0, :3, :3]
    stood = legs.rotation_part(feet.at(foot_turns, under))[0]
    heading = numpy.arctan2(stood[1, 0], stood[0, 0])
    return foot_turns @ stood.T @ cycles.turn(numpy.array([heading]))[0, :3, :3]


def _arm(bones, chest, arm):
    """An elbow that is bent tells its axis. That of a straight one is what it would be if the arm had been taken there
    from hanging, the short way."""
    upper, fore, _ = numpy.moveaxis(_limb(bones, (arm.upper, arm.fore, arm.hand), numpy.zeros((len(bones), 3))), 1, 0)
    across = numpy.cross(upper, fore)
    sine = numpy.linalg.norm(across, axis=1, keepdims=True)
    share = numpy.clip((sine - STRAIGHT) / (BENT - STRAIGHT), 0.0, 1.0)
    hung = numpy.stack([legs.turn_between(one @ (0.0, 0.0, -1.0), other) @ one @ (0.0, -1.0, 0.0)
                        for one, other in zip(chest, upper)])
    return numpy.stack([upper, fore, _unit(share * _unit(across) + (1.0 - share) * hung)], axis=1)
