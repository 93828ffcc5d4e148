# SPDX-License-Identifier: Apache-2.0
"""Finds the cycle of a clip that walks, however long it is and wherever it goes, and makes it straight. No Blender
here.

A clip may be one cycle, with its first frame again at the end or not, or a take of a minute with turns and a start: the
stretch is taken that comes round best while it moves as much as the clip does at its most.
"""
from dataclasses import dataclass, replace

import numpy

from ..characters import legs, motion
from . import MotionError

RATE = 30.0               # frames a second that are enough to look for cycles
SHORTEST, LONGEST = 0.45, 2.6  # s, of a cycle
LIVELY = 0.7              # of the most that ankles part in the clip: less is no cycle of its walk
AS_GOOD = 1.3             # times the least difference at the seam: of those the shortest is taken
SEAM = 0.3                # of how much everything swings: what differs by more has not come round
TRAVELS = 0.15            # of a leg's length: a clip that goes less far in a cycle walks on the spot
TURNS = 50.0              # degrees in a cycle: whoever turns more does not walk straight on
SAMPLES = motion.SAMPLES


@dataclass
class Straight:
    """One cycle, along x, on the spot."""
    bones: numpy.ndarray  # (SAMPLES + 1, B, 4, 4)
    seconds: float
    way: float            # m that it went
    aside: float          # degrees from where the body looks to where it goes
    notes: list


def facing(take, found, frames):
    """(N,) rad: where the pelvis looks."""
    right, left = (frames[:, leg.thigh, :3, 3] for leg in found.legs)
    aside = (left - right)[:, :2]
    return numpy.unwrap(numpy.arctan2(-aside[:, 0], aside[:, 1]))


def turn(angle):
    """(N, 4, 4) about z."""
    found = numpy.tile(numpy.eye(4), (len(angle), 1, 1))
    c, s = numpy.cos(angle), numpy.sin(angle)
    found[:, 0, 0], found[:, 0, 1], found[:, 1, 0], found[:, 1, 1] = c, -s, s, c
    return found


def _hips(frames, found):
    return motion.joints(frames, [leg.thigh for leg in found.legs]).mean(axis=1)


def _shape(take, found, frames):
    """(N, J, 3): where joints of limbs are beside the hips, as the body sees it."""
    which = [bone for leg in found.legs for bone in (leg.shin, leg.foot)]
    which += [bone for arm in found.arms if arm for bone in (arm.fore, arm.hand)]
    ways = motion.joints(frames, which) - _hips(frames, found)[:, None]
    return ways @ turn(-facing(take, found, frames))[:, :3, :3].swapaxes(1, 2)


def _parts(shape):
    """(N,) how far the one ankle is before the other."""
    return shape[:, 1, 0] - shape[:, 3, 0]


def _windows(shape, lengths):
    """{length: (N - length,) how much the shape differs at both ends, and the pace}, m."""
    pace, found = numpy.diff(shape, axis=0), {}
    pace = numpy.concatenate([pace, pace[-1:]])
    for length in lengths:
        found[length] = _rms(shape[length:] - shape[:-length]) + _rms(pace[length:] - pace[:-length])
    return found


def _rms(apart):
    """(N,) of (N, J, 3)"""
    return numpy.sqrt((apart ** 2).mean(axis=(1, 2)))


def _seam(shape, first, length):
    """How far the ends of a stretch are from each other, as a share of what it swings."""
    apart = float(_rms(shape[first:first + 1] - shape[first + length:first + length + 1])[0])
    return apart / max(1e-9, float(numpy.sqrt(shape[first:first + length].var(axis=0).mean())))


def _lively(parts, length):
    """(N - length,) how much ankles part in each window."""
    from_, to = parts.copy(), parts.copy()
    for shift in range(1, length + 1):
        from_[:-shift] = numpy.minimum(from_[:-shift], parts[shift:])
        to[:-shift] = numpy.maximum(to[:-shift], parts[shift:])
    return (to - from_)[:-length]


def window(shape, rate):
    """(first, length) in samples of the cycle that comes round best."""
    count = len(shape)
    lengths = range(max(4, int(SHORTEST * rate)), min(count - 1, int(LONGEST * rate) + 1) + 1)
    seams = _windows(shape, lengths) if count > 4 else {}
    if not seams:
        raise MotionError(f"it is {count / rate:.2f} s long: a clip needs one whole cycle, right and left step")
    parts = _parts(shape)
    lively = {length: _lively(parts, length) for length in lengths}
    most = max(float(each.max()) for each in lively.values())
    best = {}
    for length, seam in seams.items():
        seam = numpy.where(lively[length] >= LIVELY * most, seam, numpy.inf)
        best[length] = (float(seam.min()), int(seam.argmin()))
    least = min(seam for seam, _ in best.values())
    good = AS_GOOD * least + 0.02 * float(numpy.sqrt(shape.var(axis=0).mean()))
    runs, length = [], None
    for length in lengths:  # the first run of lengths that are good, and of it the best
        if best[length][0] <= good:
            runs.append(length)
        elif runs:
            break
    length = min(runs, key=lambda each: best[each][0])
    return best[length][1], length


def _closed_by_one(take):
    """The take with the frame that would follow its last one, if it goes on as it did: where it is the first again, its
    place aside, the clip left that out."""
    frames = take.frames
    after = legs.straightened(2.0 * frames[-1] - frames[-2])
    return numpy.concatenate([frames, after[None]])


def straight(take, found):
    """The Straight of a take. Raises MotionError."""
    frames = _closed_by_one(take)
    step = max(1, int(take.rate / RATE))
    shape = _shape(take, found, frames)
    coarse = shape[::step]
    if (len(frames) - 1) % step:  # its end counts: it may be all there is of a cycle
        step, coarse = (1, shape) if len(frames) < 400 else (step, coarse)
    first, length = (each * step for each in window(coarse, take.rate / step))
    if step > 1:
        first, length = _refined(shape, first, length, step)
    seam = _seam(shape, first, length)
    if seam > SEAM:
        raise MotionError(f"{take.name} does not walk: nothing in it comes round (the best {length / take.rate:.2f} s "
                          f"end {100.0 * seam:.0f} % of their swing away from where they began)")
    notes = []
    if length < 0.9 * len(take.frames):
        notes.append(f"its cycle is from {first / take.rate:.2f} to {(first + length) / take.rate:.2f} s")
    places = first + length * numpy.arange(SAMPLES + 1) / SAMPLES
    bones = replace(take, frames=frames).at(places)
    return _along_x(take, found, bones, length / take.rate, notes)


def _refined(shape, first, length, step):
    low = max(0, first - step)
    part = shape[low:first + length + 2 * step + 1]
    lengths = range(max(2, length - step), min(len(part) - 1, length + step) + 1)
    seams = _windows(part, lengths)
    length = min(seams, key=lambda each: seams[each].min())
    return low + int(seams[length].argmin()), length


def _along_x(take, found, bones, seconds, notes):
    """Turned into the way that it goes, and what it goes taken out."""
    looks = facing(take, found, bones)
    turns = float(looks[-1] - looks[0])
    if abs(numpy.degrees(turns)) > TURNS:
        raise MotionError(f"{take.name} does not walk straight on: it turns by {numpy.degrees(turns):.0f} degrees in "
                          "its cycle")
    hips = _hips(bones, found)
    way = (hips[-1] - hips[0])[:2]
    went, share, mean = float(numpy.linalg.norm(way)), numpy.linspace(0.0, 1.0, len(bones)), float(looks[:-1].mean())
    travels = went > TRAVELS * leg_of(take, found)
    goes = float(numpy.arctan2(way[1], way[0])) if travels else mean
    heading = goes + turns * (share - 0.5)
    path = _arc(heading, went) if travels else share[:, None] * way
    back = numpy.tile(numpy.eye(4), (len(bones), 1, 1))
    back[:, :2, 3] = -(hips[0, :2] + path)
    turned = (turn(-heading) @ back)[:, None] @ bones
    if travels:
        notes.append(f"goes {went:.2f} m a cycle: taken out")
    if abs(numpy.degrees(turns)) > 3.0:
        notes.append(f"turns by {numpy.degrees(turns):.0f} degrees a cycle: made straight")
    aside = numpy.degrees((mean - goes + numpy.pi) % (2.0 * numpy.pi) - numpy.pi)
    return Straight(turned, seconds, went, float(aside), notes)


def _arc(heading, length):
    """(N, 2): a way of such a length from end to end, with even pace along the headings."""
    ahead = numpy.stack([numpy.cos(heading), numpy.sin(heading)], axis=1)
    path = numpy.concatenate([numpy.zeros((1, 2)), numpy.cumsum(0.5 * (ahead[1:] + ahead[:-1]), axis=0)])
    return path * (length / max(1e-9, float(numpy.linalg.norm(path[-1]))))


def leg_of(take, found):
    """m, from hip to ankle at rest."""
    places = take.rest[:, :3, 3]
    return float(numpy.mean([numpy.linalg.norm(places[leg.thigh] - places[leg.shin])
                             + numpy.linalg.norm(places[leg.shin] - places[leg.foot]) for leg in found.legs]))
