# SPDX-License-Identifier: Apache-2.0
"""A person's joints, walking, running or standing, from where the feet are planted. Pure Python: no Blender here.

Feet must not slide, so the feet are the input and the joints follow: during stance the planted point (the heel, then
the whole foot, then the ball) stays where it is on the ground, which in the walker's own frame is a straight line
backwards at one stride length per cycle. Hip and knee come from the ankle by two-bone inverse kinematics. Timing and
amplitudes are those of healthy adults: at comfortable speed stance is 62 % of the cycle, the foot flat from 10 to 40 %,
pelvis rotation about 4 degrees to each side, arm swing about 20 degrees (Winter, Biomechanics and Motor Control of
Human Movement; Murray, Drought and Kory 1964). With longer strides the stance gets shorter and all amplitudes larger
(Murray 1967); runners have a phase of flight (Novacheck 1998).

Frame: x forward, y left, z up, metres; phase 0 is the right heel's strike, the left foot is half a cycle later.
Whatever the stride, the planted foot is under the body at phase UNDER_BODY of its own cycle: the simulation changes
strides there, and nowhere else.
"""
import math
from dataclasses import dataclass, replace
from functools import lru_cache

UNDER_BODY = 0.28     # as GAIT_UNDER_BODY of the simulation
NORMAL_STRIDE = 1.446  # m, of an adult at 1.34 m/s
STRIDE_AT_ONE = 1.249  # m, at 1 m/s: as in recording/gaits.cpp; strides grow with the root of the speed
RUNNING_STRIDE = 2.1   # m: from here on people run
HIP_DROP = 0.02        # m, of the hip joints below the middle of the pelvis


@dataclass(frozen=True)
class Gait:
    """How one stride length is walked. Shares are of the cycle, from the moment that a foot comes down."""
    stride: float
    down: float          # phase at which the foot comes down
    flat_from: float     # heel strike ends
    flat_until: float    # heel rise begins
    stance: float        # the foot leaves the ground
    strike_pitch: float  # rad, toes up
    toe_off_pitch: float  # rad, toes down
    lift: float          # m, how high the ankle rises above a straight swing
    bob: float           # m, of the pelvis, up and down
    yaw: float           # rad, of the pelvis
    swing: float         # rad, of the arms
    elbow: float         # rad
    lean: float          # rad

    @property
    def runs(self):
        return self.stride >= RUNNING_STRIDE

    def spared(self, share):
        """The same for a leg that hurts: it stands for a shorter time and hardly pushes off, and is lifted less."""
        return replace(self, stance=self.stance - 0.07 * share, toe_off_pitch=(1.0 - 0.45 * share) * self.toe_off_pitch,
                       lift=(1.0 - 0.35 * share) * self.lift)

    @property
    def seconds(self):
        """Of a cycle, at the speed that belongs to the stride."""
        return self.stride / (self.stride / STRIDE_AT_ONE) ** 2


def gait_of(stride):
    """The gait of a stride length (m)."""
    if stride >= RUNNING_STRIDE:
        return Gait(stride, 0.15, 0.04, 0.17, 0.33, math.radians(6.0), math.radians(-58.0), 0.20, 0.026, 0.11, 0.62,
                    1.35, 0.11)
    a = stride / NORMAL_STRIDE
    return Gait(stride, 0.0, 0.10, 0.40, 0.62 - 0.09 * (a - 1.0), math.radians(18.0) * min(a, 1.2),
                math.radians(-52.0) * min(a ** 0.8, 1.15), 0.055 * (0.6 + 0.4 * a), 0.018 * a ** 1.5, 0.075 * a,
                min(0.36 * a ** 1.3, 0.55), 0.30 * (0.7 + 0.3 * a), 0.045 + 0.03 * (a - 1.0))


@dataclass(frozen=True)
class Manner:
    """How somebody moves beside all others, by which friends are known from afar: shares of what the gait has, and
    angles (rad) on top of it. How far apart people are in this is chosen by eye, the means stay those of the gait."""
    swing: tuple = (1.0, 1.0)  # of the right arm and of the left one
    elbow: float = 0.0         # more bent
    yaw: float = 1.0           # of pelvis and shoulders
    sway: float = 1.0          # of the pelvis, from side to side
    lean: float = 0.0          # of the trunk, forwards
    nod: float = 0.0           # of the head, forwards
    toes: float = 0.09         # outwards
    rests_on: float = 1.0      # 1 who likes to stand on the right leg, -1 on the left one


@dataclass(frozen=True)
class Build:
    """Lengths of one person, metres, how much the left leg is spared in walking, and how they move."""
    thigh: float = 0.435
    shank: float = 0.425
    ankle: float = 0.085        # height of the ankle joint over the sole
    heel: float = 0.065         # from the ankle back to the heel's contact point
    ball: float = 0.125         # from the ankle forward to the ball of the foot
    hip_width: float = 0.17     # between the hip joints
    limp: float = 0.0           # 0 (none) to 1
    manner: Manner = Manner()

    def scaled(self, factor):
        lengths = [name for name in self.__dataclass_fields__ if name not in ("limp", "manner")]
        return replace(self, **{name: factor * getattr(self, name) for name in lengths})


@dataclass(frozen=True)
class Foot:
    ankle: tuple      # (x, z)
    pitch: float      # rad, positive = toes up
    planted: str      # "heel", "flat", "ball" or "" in the air


@dataclass(frozen=True)
class Pose:
    """Everything that the body is hung on. Angles in radians; positions in the walker's frame."""
    pelvis: tuple           # (x, y, z) of the middle between the hips
    pelvis_yaw: float       # counter-clockwise
    shoulder_yaw: float
    lean: float             # forward
    feet: tuple             # (right, left) Foot
    arms: tuple             # (right, left) of (swing forward, elbow flexion)
    tilt: float = 0.0       # of the trunk, to the right
    runs: bool = False
    aside: tuple = ((0.0, 0.0), (0.0, 0.0))  # of the arms: how far upper arm and forearm go outwards, of their length
    seated: bool = False    # has a seat, and free hands


def _smooth(t):
    return t * t * (3.0 - 2.0 * t)


def _ankle_over(point_x, offset, pitch, build):
    """The ankle when the contact point `offset` ahead of it is on the ground at point_x and the foot is pitched."""
    c, s = math.cos(pitch), math.sin(pitch)
    # the contact point in the foot's frame is (offset, -ankle); rotate by the pitch
    return (point_x - (offset * c + build.ankle * s), -(offset * s - build.ankle * c))


def foot_at(phase, build, gait):
    """One foot at a phase of its own cycle."""
    phase = (phase - gait.down) % 1.0 + gait.down

    def ground(t):
        """Where the ankle's ground point is when flat."""
        return (UNDER_BODY - t) * gait.stride

    since = phase - gait.down
    if since < gait.stance:
        if since < gait.flat_from:
            pitch = gait.strike_pitch * (1.0 - _smooth(since / gait.flat_from))
            return Foot(_ankle_over(ground(phase) - build.heel, -build.heel, pitch, build), pitch, "heel")
        if since < gait.flat_until:
            return Foot((ground(phase), build.ankle), 0.0, "flat")
        t = (since - gait.flat_until) / (gait.stance - gait.flat_until)
        pitch = gait.toe_off_pitch * t ** 1.6
        return Foot(_ankle_over(ground(phase) + build.ball, build.ball, pitch, build), pitch, "ball")

    t = (since - gait.stance) / (1.0 - gait.stance)
    start = foot_at(gait.down + gait.stance - 1e-6, build, gait)
    end = foot_at(gait.down, build, gait)
    s = _smooth(t)
    x = start.ankle[0] + (end.ankle[0] - start.ankle[0]) * s
    rise = math.sin(math.pi * min(1.0, 1.15 * t)) if gait.runs else math.sin(math.pi * t) * (1.0 - 0.4 * t)
    z = start.ankle[1] + (end.ankle[1] - start.ankle[1]) * min(1.0, 1.35 * t) + gait.lift * rise
    pitch = start.pitch + (end.pitch - start.pitch) * _smooth(min(1.0, 1.15 * t))
    return Foot((x, max(z, build.ankle * 0.9)), pitch, "")


def _reach(feet, leg):
    """How high the pelvis may be so that the legs still reach the feet that are planted."""
    return min((foot.ankle[1] + math.sqrt(max(0.2, (0.995 * leg) ** 2 - foot.ankle[0] ** 2)) for foot in feet
                if foot.planted), default=math.inf)


@lru_cache(maxsize=None)
def _lowest_reach(build, gait):
    return min(_reach((foot_at(i / 48.0, build, gait), foot_at(i / 48.0 + 0.5, build, gait)), build.thigh + build.shank)
               for i in range(48))


@lru_cache(maxsize=None)
def _running_height(build, gait):
    """Of the pelvis on average: as high as the legs reach the ground in all of the stance."""
    leg, highest = build.thigh + build.shank, 0.94 * (build.thigh + build.shank) + build.ankle
    for i in range(96):
        phase = i / 96.0
        reach = _reach((foot_at(phase, build, gait), foot_at(phase + 0.5, build, gait)), leg)
        highest = min(highest, reach + 0.6 * HIP_DROP + gait.bob * math.cos(4.0 * math.pi * (phase - UNDER_BODY)))
    return highest


def _limp(phase, build, gait):
    """(the gait of the left leg, how far it bears somebody who limps, from 0 to 1). Who limps gets off the leg sooner
    and leans over it meanwhile, which takes load off the hip (antalgic gait: Perry and Burnfield 2010). Feet come down
    where and when they do in even walking, as simulated steps are even."""
    if gait.runs or not build.limp:
        return gait, 0.0
    spared = gait.spared(build.limp)
    since = (phase + 0.5 - gait.down) % 1.0
    return spared, build.limp * math.sin(math.pi * min(since / spared.stance, 1.0))


def walk_pose(phase, build, gait):
    """The pose at a phase of the cycle in [0, 1)."""
    tau = 2.0 * math.pi
    spared, bears = _limp(phase, build, gait)
    right, left = foot_at(phase, build, gait), foot_at(phase + 0.5, build, spared)
    leg = build.thigh + build.shank
    if gait.runs:  # lowest over the standing leg, highest in flight
        height = _running_height(build, gait) - gait.bob * math.cos(2.0 * tau * (phase - UNDER_BODY))
    else:  # highest over the standing leg, lowest in double support: the vault of an inverted pendulum
        # long strides bend the knees
        top = min(0.958 * leg + build.ankle + gait.bob, _lowest_reach(build, gait) + 2.5 * gait.bob)
        height = min(top - gait.bob - gait.bob * math.cos(2.0 * tau * (phase - 0.02)), _reach((right, left), leg))
    height -= 0.022 * bears
    # towards the standing leg (right leg stands in the first half)
    manner = build.manner
    sway = -0.022 * manner.sway * math.sin(tau * phase + 0.3) + 0.012 * bears
    turn = math.cos(tau * (phase - gait.down))   # the right hip is ahead when the right foot comes down
    elbow, yaw = gait.elbow + manner.elbow, gait.yaw * manner.yaw
    arms = tuple((gait.swing * share * ahead + 0.03, elbow + 0.22 * share * max(0.0, ahead))
                 for share, ahead in zip(manner.swing, (-turn, turn)))
    return Pose((0.0, sway, height), yaw * turn, -1.15 * yaw * turn, gait.lean + manner.lean + 0.03 * bears,
                (right, left), arms, -0.11 * bears, gait.runs)


STANDING_CLIPS = ("idle", "shift", "talk", "phone")


def standing_pose(clip, beat, build):
    """A pose of those who stand; `beat` goes through one slow round in [0, 1)."""
    wave = math.sin(2.0 * math.pi * beat)
    if clip == "shift":  # weight on the other leg, thumbs in the pockets
        pose = idle_pose(build, -build.manner.rests_on, 0.010 * wave)
        return Pose(pose.pelvis, pose.pelvis_yaw, -0.10 + 0.05 * wave, 0.02, pose.feet,
                    ((-0.14, 0.62 + 0.04 * wave), (-0.16, 0.66)))
    if clip == "talk":  # one hand speaks
        pose = idle_pose(build, build.manner.rests_on, 0.008 * wave)
        return Pose(pose.pelvis, pose.pelvis_yaw, 0.08 * wave, 0.03 + 0.02 * wave, pose.feet,
                    ((0.42 + 0.16 * wave, 1.35 - 0.30 * wave), (0.05, 0.28)))
    if clip == "phone":  # looks at what it holds
        pose = idle_pose(build, -build.manner.rests_on, 0.004 * wave)
        return Pose(pose.pelvis, pose.pelvis_yaw, 0.0, 0.07, pose.feet, ((0.40, 1.95 + 0.03 * wave), (0.04, 0.25)))
    return idle_pose(build, build.manner.rests_on, 0.010 * wave)


def idle_pose(build, side=1.0, sway=0.0):
    """Standing at ease: weight on the right leg (side 1) or the left one, feet apart, arms hanging."""
    right = Foot((0.01 if side > 0.0 else 0.05, build.ankle), 0.0, "flat")
    left = Foot((0.05 if side > 0.0 else 0.01, build.ankle), 0.0, "flat")
    height = 0.985 * (build.thigh + build.shank) + build.ankle
    elbow = 0.5 * build.manner.elbow
    return Pose((0.0, -0.02 * side + sway, height), 0.06 * side, 0.0, 0.01 + 0.5 * build.manner.lean, (right, left),
                ((0.04 + sway, 0.22 + elbow), (0.06 - sway, 0.30 + elbow)))


def knee_of(hip, ankle, build):
    """The knee between a hip and an ankle, bent forwards; (x, z) in the plane of walking."""
    dx, dz = ankle[0] - hip[0], ankle[1] - hip[1]
    reach = math.hypot(dx, dz)
    most = (build.thigh + build.shank) * 0.9995
    distance = min(reach, most)
    along = (build.thigh ** 2 - build.shank ** 2 + distance ** 2) / (2.0 * distance)
    aside = math.sqrt(max(0.0, build.thigh ** 2 - along ** 2))
    ux, uz = dx / reach, dz / reach
    return (hip[0] + ux * along - uz * aside, hip[1] + uz * along + ux * aside)
