# SPDX-License-Identifier: Apache-2.0
"""What the feet of a clip tell, and where they have to be instead. Pure maths on numpy arrays: no Blender here.

A clip is sampled at N moments, evenly over its length. Where "points" are asked for, they are the points of
one foot's sole, (N, V, 3): x forward, y left, z up. All times are shares of the cycle, and the cycle comes
round: sample N is sample 0.
"""
from dataclasses import dataclass

import numpy

from ..cast.gait import UNDER_BODY


def contact_steps(points, tolerance):
    """(N, 2): how far what touches the ground moves from each sample to the next. The lowest points count most."""
    after = numpy.roll(points, -1, axis=0)
    low = numpy.maximum(points[..., 2], after[..., 2])
    weights = numpy.exp((low.min(axis=1, keepdims=True) - low) / tolerance)
    steps = (after - points)[..., :2]
    return (weights[..., None] * steps).sum(axis=1) / weights.sum(axis=1)[:, None]


def smooth(values, width):
    """A circular moving average over so many samples."""
    return sum(numpy.roll(values, shift, axis=0)
               for shift in range(-(width // 2), width // 2 + 1)) / (width // 2 * 2 + 1)


def cycles_in(motion, limit=0.2):
    """How many times a clip does the same: `motion` (N, D) is where things are, root motion taken out. N should
    divide by 2, 3 and 4."""
    still = numpy.sqrt(((motion - motion.mean(axis=0)) ** 2).mean())
    if still < 1e-9:
        return 1
    for count in (4, 3, 2):
        if len(motion) % count == 0:
            away = numpy.sqrt(((motion - numpy.roll(motion, len(motion) // count, axis=0)) ** 2).mean())
            if away < limit * still:
                return count
    return 1


def heading_of(pair, tolerance):
    """The direction (x, y) that two feet walk: against the way of what is on the ground; its length says how
    sure that is, 0 to 1."""
    pushed, way = numpy.zeros(2), 0.0
    for points in pair:
        low = points[..., 2].min(axis=1)
        down = low < low.min() + 0.25 * (low.max() - low.min()) + tolerance
        steps = contact_steps(points, tolerance)[down]
        pushed -= steps.sum(axis=0)
        way += numpy.linalg.norm(steps, axis=1).sum()
    return pushed / way if way > 1e-6 else pushed * 0.0


@dataclass(frozen=True)
class Stance:
    """When a foot is planted, and how fast it goes backwards then."""
    down: float    # share of the cycle when it comes down
    length: float  # share of the cycle that it stays
    stride: float  # m per cycle

    @property
    def off(self):
        return self.down + self.length


def stance_of(points, tolerance):
    """The longest time that a foot is low and goes backwards, or None where it never does."""
    count = len(points)
    low = points[..., 2].min(axis=1)
    steps = smooth(contact_steps(points, tolerance)[:, 0], 3)
    near = low.min() + 0.22 * (low.max() - low.min()) + tolerance
    planted = (steps < 0.0) & (numpy.minimum(low, numpy.roll(low, -1)) < near)
    if planted.all() or not planted.any():
        return None
    first, best = 0, 0
    for start in numpy.nonzero(planted & ~numpy.roll(planted, 1))[0]:
        run = 1
        while planted[(start + run) % count]:
            run += 1
        if run > best:
            first, best = int(start), run
    inner = [(first + k) % count for k in range(best // 6, best - best // 6)]  # at both ends the foot also rolls
    return Stance(first / count, best / count, float(-numpy.median(steps[inner]) * count))


def at(samples, time):
    """Samples at a share of the cycle, or at many, between them linearly."""
    place = (numpy.asarray(time) % 1.0) * len(samples)
    low = place.astype(int) % len(samples)
    blend = (place - numpy.floor(place)).reshape(place.shape + (1,) * (samples.ndim - 1))
    return samples[low] * (1.0 - blend) + samples[(low + 1) % len(samples)] * blend


@dataclass
class Foot:
    """One foot of a clip: where its ankle is, and its sole's points from there."""
    ankle: numpy.ndarray   # (N, 3)
    sole: numpy.ndarray    # (N, V, 3), relative to the ankle
    stance: Stance
    under: float           # when the ankle is under the hip, planted


@dataclass
class Path:
    """Where an ankle has to be over the cycle of a gait, so that nothing on the ground slides."""
    ankle: numpy.ndarray    # (P, 3); sample i is at phase i / P of the foot's own cycle
    time: numpy.ndarray     # (P,) the clip's time that shows the foot there
    planted: numpy.ndarray  # (P,) bool


def foot_of(ankle, points, stance, hip):
    """@param hip (N, 3), the joint above"""
    times = stance.down + stance.length * numpy.arange(7, 42) / 48.0
    ahead = numpy.abs(at(ankle, times)[:, 0] - at(hip, times)[:, 0])
    return Foot(ankle, points - ankle[:, None], stance, float(times[ahead.argmin()]))


def _warp(foot, phase, down, share):
    """The clip's time at a phase of the foot's cycle (counted from `down`) when it is planted for that share of it."""
    since = phase - down
    if since < share:
        return foot.stance.down + since * foot.stance.length / share
    return foot.stance.off + (since - share) * (1.0 - foot.stance.length) / (1.0 - share)


def fit(foot, stride, share, turned=None, lift=1.0, clearance=0.02, samples=240):
    """The path of a foot for a stride: planted for `share` of the cycle, under the body at UNDER_BODY.

    While it is planted it rolls: each moment, what touches the ground stays where it is. In the air it follows the
    clip, from where it leaves the ground to where it comes down.
    @param turned extra rotations (T, 3, 3) of the foot about its ankle, a function of times of the clip, or None
    @param lift how much of the clip's height in the air remains
    @param clearance metres that the sole is above the ground in the air at least, but for its first and last tenth
    """
    before = (foot.under - foot.stance.down) / foot.stance.length * share
    down = UNDER_BODY - before
    phases = down + numpy.arange(samples) / samples
    times = numpy.array([_warp(foot, phase, down, share) for phase in phases])
    soles = at(foot.sole, times) if turned is None else at(foot.sole, times) @ turned(times).swapaxes(1, 2)
    last = int(share * samples)

    ankles = numpy.zeros((samples, 3))
    size = max(1e-3, 0.01 * float(numpy.ptp(foot.sole[0][:, 0]) + numpy.ptp(foot.sole[0][:, 1])))
    for index in range(last):  # in the world, and back into the walker's frame by the way that the body has gone
        rolled = _rolled(soles[index], soles[index + 1], size)
        ankles[index + 1, :2] = ankles[index, :2] - rolled
    ankles[:last + 1, 2] = -soles[:last + 1, :, 2].min(axis=1)
    ankles[:last + 1, 0] -= stride * (phases[:last + 1] - phases[0])
    middle = min(last, int(round(before * samples)))
    aside = at(foot.ankle, foot.under)[1]
    ankles[:last + 1, :2] -= ankles[middle, :2] - numpy.array([0.0, aside])
    ankles[:last + 1, 0] += (UNDER_BODY - phases[middle]) * stride  # between two samples

    _swing(foot, ankles, soles, times, last, lift, clearance)
    roll = int(round(down * samples))  # sample 0 shall be phase 0
    order = (numpy.arange(samples) - roll) % samples
    planted = numpy.arange(samples) <= last
    return Path(ankles[order], times[order], planted[order])


def _rolled(sole, after, size):
    """How far the lowest points of a turning sole move (x, y), its ankle held."""
    low = numpy.maximum(sole[:, 2] - sole[:, 2].min(), after[:, 2] - after[:, 2].min())
    weights = numpy.exp((low.min() - low) / size)
    return (weights[:, None] * (after - sole)[:, :2]).sum(axis=0) / weights.sum()


def _swing(foot, ankles, soles, times, last, lift, clearance):
    count = len(ankles)
    start, end = ankles[last].copy(), ankles[0].copy()
    clip_start, clip_end = at(foot.ankle, times[last]), at(foot.ankle, foot.stance.down + 1.0)
    way = clip_end[0] - clip_start[0]
    clips = at(foot.ankle, times)
    for index in range(last + 1, count):
        share, clip = (index - last) / (count - last), clips[index]
        progress = (clip[0] - clip_start[0]) / way if abs(way) > 1e-6 else share
        ankles[index, 0] = start[0] + progress * (end[0] - start[0])
        line, wanted = clip_start + (clip_end - clip_start) * share, start + (end - start) * share
        ankles[index, 1] = wanted[1] + clip[1] - line[1]
        clear = clearance * min(1.0, 10.0 * share, 10.0 * (1.0 - share))  # never through the ground, nor dragging on it
        ankles[index, 2] = max(wanted[2] + lift * (clip[2] - line[2]), clear - soles[index][:, 2].min())


def lowering(path, hip, leg):
    """(P,) how much lower the hip has to be for the leg to reach the planted foot; infinite where no height would do.

    @param hip (P, 3), at the phases of the path
    """
    away = ((path.ankle - hip)[:, :2] ** 2).sum(axis=1)
    reach = numpy.sqrt(numpy.maximum(0.0, leg ** 2 - away))
    need = numpy.where(away < (0.97 * leg) ** 2, hip[:, 2] - path.ankle[:, 2] - reach, numpy.inf)
    return numpy.where(path.planted, numpy.maximum(0.0, need), 0.0)


def slide(points, stride, near=0.006):
    """What slides in one step, in metres: all of the way that what touches the ground goes there, from pose to pose.

    @param points (K, V, 3), a foot's sole in the poses of one cycle, evenly over it, in the walker's frame
    """
    count = len(points)
    world = points + numpy.arange(count)[:, None, None] * numpy.array([stride / count, 0.0, 0.0])
    after = numpy.roll(world, -1, axis=0)
    after[-1, :, 0] += stride
    low = numpy.maximum(world[..., 2], after[..., 2])
    slid = 0.0
    for index in range(count):
        if low[index].min() < near:
            slid += float(numpy.linalg.norm((after - world)[index, low[index].argmin(), :2]))
    return slid
