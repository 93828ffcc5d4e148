# SPDX-License-Identifier: Apache-2.0
"""Poses of those who have a seat, sitting, clapping, and what they stand up for; and of who does something with its
hands where it stands. Pure Python.

Clips follow each other in the order of the bake's activities from FIRST on (docs/bake.md). A clip is a cycle, or a way
there and back: at half of a cycle somebody is there. So whoever goes from one to the next at whole and half cycles does
not jump: sitting, hands ready to clap, clapping, ready, sitting; or sitting, rising, cheering, rising, sitting.

The bake has people where their seats are. Feet stay where they are: who stands does so before the seat. Only who
settles comes from somewhere: its place goes from before the seat to the seat's, and its feet stay.
"""
import math
from dataclasses import dataclass, replace

from .gait import HIP_DROP, Foot, Pose, idle_pose

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
         Clip("cheer", 8, False), Clip("sing", 8, False),
         # Of those who walk to their seats, and of who stands.
         Clip("settle", 12, True), Clip("raise", 4, True), Clip("applaud", 8, False), Clip("jubilate", 16, False),
         Clip("sway", 8, False), Clip("wave", 20, False))
AUDIENCE = 6  # so many of them are all that audiences do who only ever sit there
AHEAD = 0.10  # m, from the middle of a seat to where who settles stands before (authoring/layout/seat_rows.h)


def clips_for(poses):
    """How many clips a bake needs. @param poses Bake.poses (formats)"""
    return {"all": len(CLIPS), "audience": AUDIENCE}.get(poses, 0)


def poses_in(clips):
    """How many there are in the first so many clips."""
    return sum(each.poses for each in CLIPS[:clips])


# Of both arms: (swing, elbow), and how far upper arm and forearm go aside, outwards.
_LAP = ((0.22, 1.05), (0.02, -0.20))
_READY = ((0.35, 1.42), (0.02, -0.42))
_UP = ((2.78, 0.22), (0.26, 0.20))


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


def _settling(build, share):
    """On the way from sitting (0) to standing, arms hanging (1), over feet that are drawn back a little."""
    low, high = sitting(build), idle_pose(build)
    moved = AHEAD * _smooth(share)  # what the bake's place has gone
    forward, up = _smooth(min(1.0, 1.5 * share)), _smooth(max(0.0, 1.3 * share - 0.3))
    x = _mixed(low.pelvis[0], high.pelvis[0] + AHEAD, 0.3 * forward + 0.7 * up) - moved
    lean = _mixed(low.lean, high.lean, share) + 0.55 * math.sin(math.pi * min(1.0, 1.1 * share)) ** 2
    feet = tuple(Foot((_mixed(one.ankle[0], other.ankle[0] + AHEAD, forward) - moved,
                       _mixed(one.ankle[1], other.ankle[1], forward)), 0.0, "flat")
                 for one, other in zip(low.feet, high.feet))
    y, z = (_mixed(low.pelvis[part], high.pelvis[part], up) for part in (1, 2))
    pose = Pose((x, y, z), _mixed(0.0, high.pelvis_yaw, up), 0.0, lean, feet, (), seated=True)
    arms = tuple(_mixed(_LAP[0], arm, _smooth(share)) for arm in high.arms)
    aside = _mixed(_LAP[1], (0.0, 0.0), _smooth(share))
    return replace(pose, arms=arms, aside=(aside, aside))


def _hands_ready(build, share):
    """Who stands, hands on the way from hanging down (0) to before the chest (1)."""
    pose = idle_pose(build)
    arms = tuple(_mixed(arm, _READY[0], share) for arm in pose.arms)
    aside = _mixed((0.0, 0.0), _READY[1], share)
    return replace(pose, arms=arms, aside=(aside, aside), seated=True)


def _applauding(build, phase):
    shut = 0.5 - 0.5 * math.cos(2.0 * math.pi * phase)
    return _with_arms(_hands_ready(build, 1.0), (_READY[0], (_READY[1][0], _READY[1][1] - 0.40 * shut)))


def _jubilating(build, phase):
    """Up and down again."""
    high = 0.5 - 0.5 * math.cos(2.0 * math.pi * phase)
    pose = _hands_ready(build, 1.0)
    return _with_arms(replace(pose, lean=pose.lean - 0.05 * high), _mixed(_READY, _UP, high))


def _swaying(build, phase):
    """From one foot to the other, hands together."""
    pose, sway = _hands_ready(build, 1.0), math.sin(2.0 * math.pi * phase)
    x, y, z = pose.pelvis
    return replace(pose, pelvis=(x, y - 0.045 * sway, z - 0.012 * abs(sway)), tilt=0.10 * sway)


def _waving(build, phase):
    """The right hand goes up, to and fro, and down; the other one goes down and up again."""
    up = _smooth(min(1.0, 3.0 * min(phase, 1.0 - phase)))
    fro = up * math.sin(6.0 * math.pi * phase)
    pose = _hands_ready(build, 1.0)
    raised = ((2.30, 0.55), (0.30, 0.10 + 0.45 * fro))
    return _with_arms(pose, _mixed(_READY, raised, up), _mixed(_READY, (idle_pose(build).arms[1], (0.0, 0.0)), up))


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
    if name == "raise":
        return _hands_ready(build, share)
    return _OTHERS[name](build, share)


_OTHERS = {"cheer": _cheering, "sing": _singing, "settle": _settling, "applaud": _applauding,
           "jubilate": _jubilating, "sway": _swaying, "wave": _waving}


def poses_of(build, clips):
    """All of the first so many clips, in order."""
    return [seated_pose(number, index / (clip.poses - 1 if clip.there_and_back else clip.poses), build)
            for number, clip in enumerate(CLIPS[:clips]) for index in range(clip.poses)]
