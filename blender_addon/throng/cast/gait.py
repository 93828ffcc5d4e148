# SPDX-License-Identifier: Apache-2.0
"""A walking person's joints, from where its feet are planted. Pure Python: no Blender here.

Feet must not slide, so the feet are the input and the joints follow: during stance the planted point (the heel, then the whole
foot, then the ball) stays where it is on the ground, which in the walker's own frame is a straight line backwards at one stride
length per cycle. Hip and knee come from the ankle by two-bone inverse kinematics. Timing and amplitudes are those of healthy
adults at comfortable speed: stance 62 % of the cycle, foot flat from 10 % to 40 %, pelvis rotation about 4 degrees to each side,
arm swing about 20 degrees (Winter, Biomechanics and Motor Control of Human Movement; Murray, Drought and Kory 1964).

Frame: x forward, y left, z up, metres; phase 0 is the right heel's strike, the left foot is half a cycle later.
"""
import math
from dataclasses import dataclass

STANCE = 0.62      # share of the cycle that a foot is on the ground
FLAT_FROM = 0.10   # heel strike ends
FLAT_UNTIL = 0.40  # heel rise begins
STRIKE_PITCH = math.radians(18.0)   # toes up
TOE_OFF_PITCH = math.radians(-52.0)  # toes down
LIFT = 0.055       # m, how high the ankle rises above a straight swing


@dataclass(frozen=True)
class Build:
    """Lengths of one person, metres."""
    thigh: float = 0.435
    shank: float = 0.425
    ankle: float = 0.085        # height of the ankle joint over the sole
    heel: float = 0.065         # from the ankle back to the heel's contact point
    ball: float = 0.125         # from the ankle forward to the ball of the foot
    hip_width: float = 0.17     # between the hip joints

    def scaled(self, factor):
        return Build(*(getattr(self, name) * factor for name in self.__dataclass_fields__))


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


def _smooth(t):
    return t * t * (3.0 - 2.0 * t)


def _ankle_over(point_x, offset, pitch, build):
    """The ankle when the contact point `offset` ahead of it is on the ground at point_x and the foot is pitched."""
    c, s = math.cos(pitch), math.sin(pitch)
    # the contact point in the foot's frame is (offset, -ankle); rotate by the pitch
    return (point_x - (offset * c + build.ankle * s), -(offset * s - build.ankle * c))


def foot_at(phase, build, stride):
    """One foot at a phase of its own cycle (0 = its heel's strike)."""
    phase %= 1.0
    # Where the ankle's ground point is when flat: symmetric about the pelvis over the flat phase, a little ahead at strike.
    middle = 0.5 * (FLAT_FROM + FLAT_UNTIL) + 0.03

    def ground(t):
        return (middle - t) * stride

    if phase < STANCE:
        if phase < FLAT_FROM:
            pitch = STRIKE_PITCH * (1.0 - _smooth(phase / FLAT_FROM))
            return Foot(_ankle_over(ground(phase) - build.heel, -build.heel, pitch, build), pitch, "heel")
        if phase < FLAT_UNTIL:
            return Foot((ground(phase), build.ankle), 0.0, "flat")
        t = (phase - FLAT_UNTIL) / (STANCE - FLAT_UNTIL)
        pitch = TOE_OFF_PITCH * t ** 1.6
        return Foot(_ankle_over(ground(phase) + build.ball, build.ball, pitch, build), pitch, "ball")

    t = (phase - STANCE) / (1.0 - STANCE)
    start = foot_at(STANCE - 1e-6, build, stride)
    end = foot_at(0.0, build, stride)
    s = _smooth(t)
    x = start.ankle[0] + (end.ankle[0] - start.ankle[0]) * s
    z = start.ankle[1] + (end.ankle[1] - start.ankle[1]) * min(1.0, 1.35 * t) + LIFT * math.sin(math.pi * t) * (1.0 - 0.4 * t)
    pitch = start.pitch + (end.pitch - start.pitch) * _smooth(min(1.0, 1.15 * t))
    return Foot((x, max(z, build.ankle * 0.9)), pitch, "")


def walk_pose(phase, build, stride):
    """The pose at a phase of the cycle in [0, 1)."""
    tau = 2.0 * math.pi
    right, left = foot_at(phase, build, stride), foot_at(phase + 0.5, build, stride)
    leg = build.thigh + build.shank
    # Highest over the standing leg, lowest in double support: the vault of an inverted pendulum.
    bob = -0.018 * math.cos(2.0 * tau * (phase - 0.02))
    height = 0.958 * leg + build.ankle + bob
    for foot in (right, left):  # and never higher than the legs reach: small people dip more for the same stride
        height = min(height, foot.ankle[1] + math.sqrt((0.995 * leg) ** 2 - foot.ankle[0] ** 2))
    sway = -0.022 * math.sin(tau * phase + 0.3)  # towards the standing leg (right leg stands in the first half)
    yaw = 0.075 * math.cos(tau * phase)          # the right hip is ahead when the right heel strikes
    swing = 0.36 * math.cos(tau * phase)
    arms = ((-swing + 0.03, 0.30 + 0.22 * max(0.0, -math.cos(tau * phase))),
            (swing + 0.03, 0.30 + 0.22 * max(0.0, math.cos(tau * phase))))
    return Pose((0.0, sway, height), yaw, -1.15 * yaw, 0.045, (right, left), arms)


def idle_pose(build):
    """Standing at ease: weight on the right leg, feet apart, arms hanging."""
    right = Foot((0.01, build.ankle), 0.0, "flat")
    left = Foot((0.05, build.ankle), 0.0, "flat")
    height = 0.985 * (build.thigh + build.shank) + build.ankle
    return Pose((0.0, -0.02, height), 0.06, 0.0, 0.01, (right, left), ((0.04, 0.22), (0.06, 0.30)))


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
