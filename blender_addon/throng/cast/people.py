# SPDX-License-Identifier: Apache-2.0
"""The cast: eight different people. Pure Python; figures look along +x and stand on z = 0."""
import math
from dataclasses import dataclass

from . import gait
from .mesh_builder import MeshBuilder, add, mix, ring, scale, sub, turn_y, turn_z, unit

SKIN, HAIR, TOP, BOTTOM, SHOES, EXTRA = range(6)
MATERIALS = ("skin", "hair", "top", "bottom", "shoes", "extra")


@dataclass(frozen=True)
class Person:
    height: float       # m
    girth: float        # 1 = average
    shoulders: float    # m, between the shoulder joints
    hips: float         # 1 = average
    hair: str           # short, long, bun, bald, cap
    top: str            # shirt, jacket, coat, hoodie, tee
    bottom: str         # trousers, skirt, shorts
    extra: str          # "", bag, backpack, scarf


CAST = (
    Person(1.78, 1.00, 0.37, 1.00, "short", "jacket", "trousers", ""),
    Person(1.66, 0.88, 0.32, 1.06, "long", "coat", "trousers", "bag"),
    Person(1.84, 1.10, 0.40, 0.98, "short", "tee", "trousers", "backpack"),
    Person(1.63, 0.94, 0.32, 1.10, "bun", "shirt", "skirt", ""),
    Person(1.73, 1.20, 0.39, 1.08, "bald", "shirt", "trousers", ""),
    Person(1.70, 0.90, 0.33, 1.02, "long", "jacket", "trousers", "scarf"),
    Person(1.76, 0.96, 0.37, 0.96, "cap", "hoodie", "shorts", "backpack"),
    Person(1.60, 1.06, 0.33, 1.14, "bun", "coat", "skirt", "bag"),
)
_STANDARD_HEIGHT = 1.74


class _Figure:
    """One person in one pose, while it is being built."""

    def __init__(self, person, pose, build):
        self.person, self.pose, self.build = person, pose, build
        self.s = person.height / _STANDARD_HEIGHT
        self.g = person.girth
        self.mesh = MeshBuilder()
        self.up = turn_y((0.0, 0.0, 1.0), pose.lean)
        self.pelvis = pose.pelvis
        self.chest = self.along(0.40)
        self.neck = self.along(0.515)

    def along(self, height):
        """A point on the spine, this far above the hips (m for somebody of standard height)."""
        return add(self.pelvis, scale(self.up, height * self.s))

    def yaw(self, share):
        """Turn of the trunk: the pelvis' at 0, the shoulders' at 1."""
        return self.pose.pelvis_yaw + (self.pose.shoulder_yaw - self.pose.pelvis_yaw) * share

    def trunk_ring(self, height, rx, ry, forward=0.0, count=14, square=0.25):
        turn = self.yaw(min(1.0, max(0.0, height / 0.45)))
        centre = add(self.along(height), turn_z((forward * self.s, 0.0, 0.0), turn))
        x, y = turn_z(turn_y((1.0, 0.0, 0.0), self.pose.lean), turn), turn_z((0.0, 1.0, 0.0), turn)
        return ring(centre, x, y, rx * self.s, ry * self.s, count, square)

    # --- parts -----------------------------------------------------------------------------------------------------
    def trunk(self):
        p, g = self.person, self.g
        wide = p.shoulders * 0.5
        bulk = {"coat": 1.10, "jacket": 1.06, "hoodie": 1.08}.get(p.top, 1.0)
        belly = 0.012 * max(0.0, g - 0.95) / 0.1
        profile = [  # height, fore-aft, half width, forward
            (-0.07, 0.100 * g, 0.150 * p.hips, -0.010), (0.00, 0.118 * g, 0.168 * p.hips, -0.010),
            (0.08, 0.110 * g, 0.152 * (0.5 + 0.5 * p.hips), 0.0), (0.17, 0.106 * g + belly, 0.138 * g, 0.008 + belly),
            (0.27, 0.116 * g + 0.5 * belly, wide * 0.80 * g ** 0.5, 0.010), (0.37, 0.124 * g, wide * 0.93, 0.006),
            (0.43, 0.108 * g, wide * 0.99, -0.004), (0.468, 0.090, wide * 0.80, -0.010), (0.495, 0.074, wide * 0.52, -0.012), (0.52, 0.060, 0.070, -0.010)]
        rings = [self.trunk_ring(h, a * (bulk if h > 0.05 else 1.0), b * (bulk if h > 0.05 else 1.0), f) for h, a, b, f in profile]
        split = 2 if p.top in ("shirt", "tee") else 1
        self.mesh.loft(rings[:split + 1], BOTTOM, cap_end=False)
        self.mesh.loft(rings[split:], TOP, cap_start=False)
        if p.top in ("jacket", "hoodie", "tee"):  # the hem hangs over the hips
            hem = [self.trunk_ring(-0.035, 0.122 * g * bulk, 0.176 * p.hips * bulk, -0.008), self.trunk_ring(0.10, 0.121 * g * bulk, 0.163 * bulk, 0.0)]
            self.mesh.loft(hem, TOP, cap_start=False, cap_end=False)
        self.mesh.limb(self.along(0.47), add(self.along(0.575), turn_z((0.018 * self.s, 0, 0), self.yaw(1.0))),
                       [(0.0, 0.066 * self.s), (0.4, 0.056 * self.s), (1.0, 0.053 * self.s)], SKIN, count=10)
        if p.top in ("jacket", "coat", "shirt"):  # a collar
            self.mesh.loft([self.trunk_ring(0.478, 0.083, 0.100, -0.012, 12), self.trunk_ring(0.525, 0.070, 0.076, -0.010, 12)], TOP,
                           cap_start=False, cap_end=False)
        if p.top == "hoodie":  # the hood lies on the back
            self.mesh.ball(add(self.along(0.475), turn_z((-0.085 * self.s, 0, 0), self.yaw(1.0))), (0.06 * self.s, 0.115 * self.s, 0.06 * self.s), TOP, 10, 5, 0.5)
        if p.extra == "scarf":
            self.mesh.loft([self.trunk_ring(h, a, b, 0.0, 12, 0.0) for h, a, b in ((0.465, 0.085, 0.095), (0.49, 0.098, 0.102), (0.525, 0.09, 0.092), (0.54, 0.072, 0.072))], EXTRA)

    def head(self):
        p, s = self.person, self.s
        turn = self.yaw(1.0) * 0.4  # eyes stay ahead
        at = lambda x, y, z: add(self.along(0.665), turn_z((x * s, y * s, z * s), turn))
        # From chin to crown: height over the ears, forward shift, half depth, half width.
        skull = [(-0.118, 0.030, 0.030, 0.026), (-0.100, 0.026, 0.056, 0.046), (-0.066, 0.020, 0.076, 0.060), (-0.020, 0.014, 0.088, 0.070),
                 (0.030, 0.006, 0.095, 0.076), (0.070, 0.000, 0.092, 0.073), (0.100, -0.004, 0.073, 0.060), (0.118, -0.006, 0.038, 0.032)]
        x, y = turn_z((1, 0, 0), turn), turn_z((0, 1, 0), turn)
        self.mesh.loft([ring(at(f, 0, z), x, y, rx * s, ry * s, 12) for z, f, rx, ry in skull], SKIN)
        self.mesh.limb(at(0.088, 0, 0.028), at(0.118, 0, -0.022), [(0, 0.008 * s), (0.75, 0.015 * s), (1, 0.010 * s)], SKIN, 6)  # nose
        for side in (-1, 1):
            self.mesh.ball(at(0.0, side * 0.074, -0.005), (0.020 * s, 0.009 * s, 0.030 * s), SKIN, 6, 4)
        self.hair(at, x, y)

    def hair(self, at, x, y):
        p, s = self.person, self.s
        if p.hair == "bald":
            self.mesh.loft([ring(at(-0.022, 0, z), x, y, rx * s, ry * s, 12) for z, rx, ry in ((-0.05, 0.068, 0.072), (0.0, 0.080, 0.0795), (0.03, 0.079, 0.078))], HAIR,
                           cap_start=False, cap_end=False)
            return
        material = EXTRA if p.hair == "cap" else HAIR
        # A cap of hair: low at the nape, high at the brow, so rings are tilted backwards.
        rings = []
        for z, back, rx, ry in ((-0.045, -0.030, 0.080, 0.079), (0.0, -0.016, 0.096, 0.083), (0.045, -0.007, 0.104, 0.085), (0.085, -0.004, 0.100, 0.080),
                                (0.115, -0.006, 0.077, 0.062), (0.132, -0.008, 0.040, 0.034)):
            tilted = [add(point, scale((0, 0, 1), 0.42 * s * ((point[0] - at(back, 0, z)[0]) * x[0] + (point[1] - at(back, 0, z)[1]) * x[1]) / s * (1.0 if z < 0.06 else 0.35)))
                      for point in ring(at(back, 0, z), x, y, rx * s, ry * s, 12)]
            rings.append(tilted)
        self.mesh.loft(rings, material, cap_start=False)
        if p.hair == "cap":  # a peak
            self.mesh.loft([ring(at(0.10, 0, 0.062), x, y, 0.05 * s, 0.062 * s, 10), ring(at(0.125, 0, 0.054), x, y, 0.055 * s, 0.058 * s, 10)], EXTRA)
            self.mesh.loft([ring(at(-0.03, 0, z), x, y, 0.076 * s, 0.078 * s, 12) for z in (-0.05, 0.02)], HAIR, False, False)
        if p.hair == "long":
            rings = [ring(at(-0.045 - 0.012 * k, 0, 0.02 - 0.062 * k), x, y, (0.062 - 0.004 * k) * s, w * s, 12)
                     for k, w in enumerate((0.078, 0.086, 0.088, 0.084, 0.074, 0.05))]
            self.mesh.loft(rings, HAIR)
        if p.hair == "bun":
            self.mesh.ball(at(-0.115, 0, 0.055), (0.046 * s, 0.05 * s, 0.046 * s), HAIR, 10, 5)

    def arm(self, side, swing, elbow):
        p, s, g = self.person, self.s, self.g
        turn = self.yaw(1.0)
        bulk = {"coat": 1.18, "jacket": 1.12, "hoodie": 1.15, "tee": 1.05}.get(p.top, 1.0) * g ** 0.5
        shoulder = add(self.along(0.435), turn_z((-0.005 * s, side * p.shoulders * 0.465 * s, 0), turn))
        out = 0.11 * side + 0.05 * side * (g - 1.0)

        def hang(angle):
            down = turn_y((0, 0, -1), -angle)
            return turn_z(unit((down[0], down[1] + out * (1.0 - 0.4 * abs(angle)), down[2])), turn)

        upper = hang(swing)
        elbow_at = add(shoulder, scale(upper, 0.285 * s))
        fore = hang(swing + elbow)
        fore = unit(add(fore, scale((0, -side, 0), 0.09)))
        wrist = add(elbow_at, scale(fore, 0.245 * s))
        sleeve_ends = p.top == "tee"
        self.mesh.ball(shoulder, (0.050 * s * bulk, 0.049 * s * bulk, 0.056 * s * bulk), TOP, 10, 5)
        cut = 0.52
        if sleeve_ends:
            self.mesh.limb(shoulder, mix(shoulder, elbow_at, cut), [(0, 0.056 * s), (1, 0.056 * s)], TOP)
            self.mesh.limb(mix(shoulder, elbow_at, 0.4), elbow_at, [(0, 0.044 * s), (0.6, 0.042 * s), (1, 0.037 * s)], SKIN)
            self.mesh.limb(elbow_at, wrist, [(0, 0.037 * s), (0.3, 0.039 * s), (1, 0.026 * s)], SKIN)
        else:
            self.mesh.limb(shoulder, elbow_at, [(0, 0.047 * s * bulk), (0.5, 0.045 * s * bulk), (1.04, 0.039 * s * bulk)], TOP)
            self.mesh.limb(add(elbow_at, scale(upper, -0.01)), wrist, [(0, 0.038 * s * bulk), (0.35, 0.039 * s * bulk), (1, 0.030 * s * bulk)], TOP)
        hand = unit(add(fore, scale((0, 0, -1), 0.25)))
        self.mesh.limb(add(wrist, scale(fore, -0.015 * s)), add(wrist, scale(hand, 0.165 * s)),
                       [(0, 0.024 * s), (0.25, 0.030 * s), (0.6, 0.035 * s), (0.85, 0.027 * s), (1, 0.012 * s)], SKIN, 8, 0.55, side=(1, 0, 0))
        return wrist

    def leg(self, side, foot):
        p, s, b = self.person, self.s, self.build
        bare = p.bottom in ("skirt", "shorts")
        spread = side * 0.5 * b.hip_width
        hip = add(self.pelvis, turn_z((0.0, spread * p.hips, -0.02 * s), self.pose.pelvis_yaw))
        ankle = (foot.ankle[0], spread * 0.72 + 0.25 * self.pelvis[1], foot.ankle[1])
        knee_x, knee_z = gait.knee_of((hip[0], hip[2]), (ankle[0], ankle[2]), b)
        knee = (knee_x, 0.5 * (hip[1] + ankle[1]), knee_z)
        w = s * self.g ** 0.7
        thigh = BOTTOM if p.bottom != "skirt" else SKIN
        self.mesh.limb(add(hip, (0, 0, 0.05 * s)), knee, [(0, 0.080 * w), (0.18, 0.091 * w), (0.55, 0.074 * w), (0.9, 0.060 * w), (1.04, 0.055 * w)], thigh, 10)
        if bare:
            self.mesh.limb(mix(hip, knee, 0.7), ankle, [(0, 0.058 * w), (0.25, 0.054 * w), (0.5, 0.055 * w), (0.75, 0.045 * w), (1, 0.034 * w)], SKIN, 10)
            if p.bottom == "shorts":
                self.mesh.limb(hip, mix(hip, knee, 0.98), [(0, 0.09 * w), (0.6, 0.086 * w), (1, 0.083 * w)], BOTTOM, 10)
        else:
            self.mesh.limb(add(knee, scale(unit(sub(knee, hip)), -0.02)), ankle, [(0, 0.057 * w), (0.25, 0.060 * w), (0.6, 0.051 * w), (0.93, 0.046 * w), (1.0, 0.048 * w)], BOTTOM, 10)
        self.shoe(ankle, foot.pitch)
        return hip, knee

    def shoe(self, ankle, pitch):
        s, b = self.s, self.build
        # Sections from heel to toe: along the foot, height of the sole and of the upper, half width.
        # The front of the foot stays flat while the heel rises: it bends at the ball.
        bend = max(0.0, -pitch)
        rings = []
        for x, low, high, half in ((-0.072, 0.018, 0.055, 0.020), (-0.060, 0.0, 0.085, 0.032), (-0.010, 0.004, 0.105, 0.036), (0.050, 0.006, 0.082, 0.039),
                                   (0.115, 0.0, 0.058, 0.046), (0.165, 0.002, 0.044, 0.043), (0.195, 0.010, 0.030, 0.024)):
            points = []
            for i in range(8):
                a = 2.0 * math.pi * i / 8
                z = low + (high - low) * (0.5 + 0.5 * math.sin(a)) - b.ankle / s
                local_x, local_z = x * s, z * s
                if x > 0.125 and bend:  # toes: turned back up about the ball
                    dx, dz = local_x - b.ball, local_z + b.ankle
                    c, n = math.cos(bend), math.sin(bend)
                    local_x, local_z = b.ball + dx * c - dz * n, -b.ankle + dx * n + dz * c
                c, n = math.cos(pitch), math.sin(pitch)
                points.append((ankle[0] + local_x * c - local_z * n, ankle[1] + half * s * math.cos(a), ankle[2] + local_x * n + local_z * c))
            rings.append(points)
        self.mesh.loft(rings, SHOES)

    def skirt(self, hips, knees, length, material, flare):
        """Cloth from the waist down, wide enough for both legs: its lower rings follow the knees."""
        p, g = self.person, self.g
        rings = [self.trunk_ring(0.09, 0.116 * g * flare, 0.160 * flare, 0.0), self.trunk_ring(-0.02, 0.135 * g * flare, 0.185 * p.hips * flare, -0.01)]
        for k in (0.5, 1.0):
            t = k * length
            points = [mix(hip, knee, t) for hip, knee in zip(hips, knees)]
            centre = mix(points[0], points[1], 0.5)
            reach = 0.5 * abs(points[0][0] - points[1][0]) + 0.125 * self.s * g * flare
            rings.append(ring((centre[0], centre[1], centre[2]), turn_z((1, 0, 0), self.pose.pelvis_yaw * 0.5), turn_z((0, 1, 0), self.pose.pelvis_yaw * 0.5),
                              reach, 0.178 * self.s * p.hips * flare * (1.0 + 0.06 * k), 14, 0.2))
        self.mesh.loft(rings, material, cap_start=False)

    def props(self, wrists):
        s = self.s
        if self.person.extra == "backpack":
            turn = self.yaw(1.0)
            centre = add(self.along(0.27), turn_z((-0.20 * s, 0, 0), turn))
            self.mesh.box(centre, (0.075 * s, 0.135 * s, 0.20 * s), turn, EXTRA, 0.82)
        if self.person.extra == "bag":
            hip = add(self.along(-0.04), turn_z((-0.02 * s, 0.235 * s, 0), self.yaw(0.0)))
            self.mesh.box(hip, (0.13 * s, 0.045 * s, 0.10 * s), self.yaw(0.0), EXTRA, 0.9)
            over = add(self.along(0.485), turn_z((0, -0.11 * s, 0), self.yaw(1.0)))
            for forward in (0.135, -0.125):  # the strap, over chest and back
                chest = add(self.along(0.25), turn_z((forward * s * self.g, 0.03 * s, 0), self.yaw(0.6)))
                self.mesh.limb(over, chest, [(0, 0.012 * s), (1, 0.012 * s)], EXTRA, 4)
                self.mesh.limb(chest, add(hip, (forward * 0.6 * s, 0, 0.08 * s)), [(0, 0.012 * s), (1, 0.012 * s)], EXTRA, 4)


def build_of(person):
    return gait.Build().scaled(person.height / _STANDARD_HEIGHT)


def build_figure(person, pose):
    """The mesh of one person in one pose (gait.walk_pose or gait.idle_pose with build_of(person))."""
    figure = _Figure(person, pose, build_of(person))
    figure.trunk()
    figure.head()
    wrists = [figure.arm(side, *pose.arms[index]) for index, side in enumerate((-1, 1))]
    joints = [figure.leg(side, pose.feet[index]) for index, side in enumerate((-1, 1))]
    hips, knees = zip(*joints)
    if person.bottom == "skirt":
        figure.skirt(hips, knees, 0.95, BOTTOM, 1.0)
    if person.top == "coat":
        figure.skirt(hips, knees, 0.82, TOP, 1.1)
    figure.props(wrists)
    return figure.mesh
