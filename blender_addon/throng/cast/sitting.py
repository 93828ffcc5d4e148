# SPDX-License-Identifier: Apache-2.0
"""Poses of those who have a seat: sitting, clapping, and what they stand up for. Pure Python.

Clips follow each other in the order of the bake's activities from FIRST on (docs/bake.md). A clip is a cycle, or a way
there and back: at half of a cycle somebody is there. So whoever goes from one to the next at whole and half cycles does
not jump: sitting, hands ready to clap, clapping, ready, sitting; or sitting, rising, cheering, rising, sitting.

The bake has people where their seats are. Feet stay where they are: who stands does so before the seat.
"""
import math
from dataclasses import dataclass, replace

from .gait import HIP_DROP, Foot, Pose

FIRST = 5     # the bake's activity of the first clip
SEAT = 0.42   # m, of the seat over the floor
_FLESH = 0.095  # m, of the hip joints over the seat, of an average adult
_BACK = -0.20   # m, of the hips from the middle of the seat
_SLOPE = 0.06   # m that knees may be lower than hips for feet to reach the floor
_AVERAGE = 0.86  # m, of thigh and shank


@dataclass(frozen=True)
class Clip:
    name: str
    poses: int          # a multiple of the cast's BEATS
    there_and_back: bool


CLIPS = (Clip("sit", 4, False), Clip("ready", 4, True), Clip("clap", 8, False), Clip("rise", 12, True),
         Clip("cheer", 8, False), Clip("sing", 8, False))
POSES = sum(clip.poses for clip in CLIPS)

# Of both arms: (swing, elbow), and how far upper arm and forearm go aside, outwards.
_LAP = ((0.22, 1.05), (0.02, -0.20))
_READY = ((0.35, 1.42), (0.02, -0.42))
_UP = ((2.78, 0.22), (0.26, 0.20))


def first_pose(clip):
    """Of a clip by number, behind the standing ones."""
    return sum(each.poses for each in CLIPS[:clip])


def _mixed(one, other, share):
    if isinstance(one, tuple):
        return tuple(_mixed(a, b, share) for a, b in zip(one, other))
    return one + (other - one) * share


def _smooth(t):
    return t * t * (3.0 - 2.0 * t)


def _with_arms(pose, right, left=None):
    left = right if left is None else left
    return replace(pose, arms=(right[0], left[0]), aside=(right[1], left[1]))


def sitting(build, lean=0.0, turn=0.0):
    """Upright in the seat: thighs as level as feet on the floor allow."""
    size = (build.thigh + build.shank) / _AVERAGE
    hip = SEAT + _FLESH * size
    drop = min(hip - build.shank - build.ankle, _SLOPE)
    knee = _BACK + math.sqrt(build.thigh ** 2 - drop ** 2)
    foot = Foot((knee, max(hip - drop - build.shank, build.ankle)), 0.0, "flat")
    pose = Pose((_BACK, 0.0, hip + HIP_DROP * size), 0.0, turn, -0.06 + lean, (foot, foot), (), seated=True)
    return _with_arms(pose, _LAP)


def _standing(build):
    """Before the seat, arms up."""
    ahead = sitting(build).feet[0].ankle[0]
    foot = Foot((ahead, build.ankle), 0.0, "flat")
    height = 0.98 * (build.thigh + build.shank) + build.ankle
    return _with_arms(Pose((ahead - 0.03, 0.0, height), 0.0, 0.0, 0.0, (foot, foot), (), seated=True), _UP)


def _rising(build, share):
    """On the way from sitting (0) to standing, arms up (1): bent forward at first, over the feet, and then up."""
    low, high = sitting(build), _standing(build)
    forward, up = _smooth(min(1.0, 1.35 * share)), _smooth(max(0.0, 1.25 * share - 0.25))
    arms = _mixed((_LAP[0], _LAP[1]), (_UP[0], _UP[1]), _smooth(max(0.0, 1.4 * share - 0.4)))
    x = _mixed(low.pelvis[0], high.pelvis[0], 0.35 * forward + 0.65 * up)
    lean = _mixed(low.lean, high.lean, share) + 0.62 * math.sin(math.pi * min(1.0, 1.1 * share)) ** 2
    feet = tuple(Foot(_mixed(one.ankle, other.ankle, forward), 0.0, "flat")
                 for one, other in zip(low.feet, high.feet))
    pose = Pose((x, 0.0, _mixed(low.pelvis[2], high.pelvis[2], up)), 0.0, 0.0, lean, feet, (), seated=True)
    return _with_arms(pose, arms)


def _cheering(build, phase):
    """On toes and off them, fists pumping."""
    pose, low = _standing(build), 0.5 - 0.5 * math.cos(2.0 * math.pi * phase)
    x, y, z = pose.pelvis
    arms = ((_UP[0][0] - 0.42 * low, _UP[0][1] + 0.75 * low), (_UP[1][0] + 0.10 * low, _UP[1][1] - 0.10 * low))
    return _with_arms(replace(pose, pelvis=(x, y, z - 0.045 * low), lean=0.05 * low), arms)


def _singing(build, phase):
    """From one side to the other."""
    pose, sway = _standing(build), math.sin(2.0 * math.pi * phase)
    x, _, z = pose.pelvis
    pose = replace(pose, pelvis=(x, -0.05 * sway, z - 0.012 * abs(sway)), tilt=0.13 * sway)
    upper, fore = _UP[1]
    return _with_arms(pose, (_UP[0], (upper + 0.30 * sway, fore + 0.42 * sway)),
                      (_UP[0], (upper - 0.30 * sway, fore - 0.42 * sway)))


def place_at(activity, phase):
    """(clip, share) of seated_pose() at a moment, as the bake has it."""
    clip, place = min(max(int(activity) - FIRST, 0), len(CLIPS) - 1), phase % 1.0
    return clip, 1.0 - abs(2.0 * place - 1.0) if CLIPS[clip].there_and_back else place


def seated_pose(clip, share, build):
    """@param clip by number; @param share of a cycle, or of the way there"""
    name, wave = CLIPS[clip].name, math.sin(2.0 * math.pi * share)
    if name == "sit":
        return sitting(build, 0.035 * wave, 0.05 * wave)
    if name == "ready":
        return _with_arms(sitting(build, 0.05 * share), _mixed(_LAP, _READY, _smooth(share)))
    if name == "clap":
        shut = 0.5 - 0.5 * math.cos(2.0 * math.pi * share)
        return _with_arms(sitting(build, 0.05), (_READY[0], (_READY[1][0], _READY[1][1] - 0.40 * shut)))
    if name == "rise":
        return _rising(build, share)
    return _cheering(build, share) if name == "cheer" else _singing(build, share)


def poses_of(build):
    """All of them, in order."""
    return [seated_pose(number, index / (clip.poses - 1 if clip.there_and_back else clip.poses), build)
            for number, clip in enumerate(CLIPS) for index in range(clip.poses)]
