# SPDX-License-Identifier: Apache-2.0
"""A person's body in one pose, as lofts. Pure Python."""
import math

from . import cloth, gait, hair, outfit
from .mesh_builder import MeshBuilder, add, extent_at, mix, ring, scale, turn_y, turn_z, unit
from .people import EYES, BOTTOM, GREY, HAIR, SHOES, SKIN, STANDARD_HEIGHT, TOP, build_of

_SHOE = (  # along the foot from the ankle, height of the sole and of the upper, half width
    (-0.072, 0.018, 0.055, 0.020), (-0.060, 0.0, 0.085, 0.032), (-0.010, 0.004, 0.105, 0.036),
    (0.050, 0.006, 0.082, 0.039), (0.115, 0.0, 0.058, 0.046), (0.165, 0.002, 0.044, 0.043),
    (0.195, 0.010, 0.030, 0.024))
_SKULL = (  # height over the ears, forward shift, half depth, half width, from chin to crown
    (-0.118, 0.030, 0.030, 0.026), (-0.100, 0.026, 0.056, 0.046), (-0.066, 0.020, 0.076, 0.060),
    (-0.020, 0.014, 0.088, 0.070), (0.030, 0.006, 0.095, 0.076), (0.070, 0.000, 0.092, 0.073),
    (0.100, -0.004, 0.073, 0.060), (0.118, -0.006, 0.038, 0.032))
# Of those who carry something: how far the arm swings, which way it is held, and how much the elbow bends besides.
_CARRYING = {("case", 1): (0.30, 0.0, 0.10), ("stick", -1): (0.75, 0.10, 0.45)}


class Figure:
    """One person in one pose."""

    def __init__(self, person, pose, build):
        self.person, self.pose, self.build = person, pose, build
        self.s = person.height / STANDARD_HEIGHT
        self.g = person.girth
        self.mesh = MeshBuilder()
        self.lean = pose.lean + 0.4 * person.stoop
        self.up = turn_y((0.0, 0.0, 1.0), self.lean)
        self.bent = turn_y((0.0, 0.0, 1.0), self.lean + person.stoop)  # the way that the upper back goes
        self.pelvis = pose.pelvis
        self.hair_material = GREY if person.grey else HAIR
        self.arms, self.legs = [], []  # right and left: (shoulder, elbow, wrist), (hip, knee, ankle)
        self.leg_limbs = []  # what of them cloth must cover: (start, end, [(share of the length, radius)])
        self.profile = _profile(person)
        self.skirts = []  # of what hangs over the hips, rings of points from the waist down
        self._trunk()
        self._head()
        wrists = [self._arm(side, *pose.arms[index], pose.aside[index]) for index, side in enumerate((-1, 1))]
        hips, knees, ankles = zip(*(self._leg(side, pose.feet[index]) for index, side in enumerate((-1, 1))))
        cloth.add_hem(self)
        cloth.add_skirts(self, hips, knees, ankles)
        outfit.add_things(self, wrists, ankles)

    def along(self, height):
        """A point on the spine, this far above the hips (m for somebody of standard height)."""
        low = min(height, _WAIST)
        return add(add(self.pelvis, scale(self.up, low * self.s)), scale(self.bent, (height - low) * self.s))

    def yaw(self, share):
        """Turn of the trunk: the pelvis' at 0, the shoulders' at 1."""
        return self.pose.pelvis_yaw + (self.pose.shoulder_yaw - self.pose.pelvis_yaw) * share

    def at(self, height, forward=0.0, aside=0.0, share=1.0):
        """A point beside the spine, turned with the trunk."""
        return add(self.along(height), turn_z((forward * self.s, aside * self.s, 0.0), self.yaw(share)))

    def trunk_ring(self, height, rx, ry, forward=0.0):
        turn = self.yaw(min(1.0, max(0.0, height / 0.45)))
        centre = add(self.along(height), turn_z((forward * self.s, 0.0, 0.0), turn))
        lean = self.lean + (self.person.stoop if height > _WAIST else 0.0)
        return ring(centre, turn_z(turn_y((1.0, 0.0, 0.0), lean), turn), turn_z((0.0, 1.0, 0.0), turn), rx * self.s,
                    ry * self.s)

    def trunk_at(self, height):
        """(fore-aft, half width, forward) of the trunk at a height, clothes included."""
        for (low, *below), (high, *above) in zip(self.profile, self.profile[1:]):
            if height <= high:
                return mix(below, above, max(0.0, (height - low) / (high - low)))
        return self.profile[-1][1:]

    def on_trunk(self, height, aside, off, front=True, wider=1.0):
        """A point before the chest or behind the back, so many metres off it; `wider` is what is worn over it."""
        deep, wide, forward = self.trunk_at(height)
        deep, wide = deep * wider, wide * wider
        share = extent_at(min(1.0, abs(aside) / wide), _TRUNK_SQUARE)
        return self.at(height, forward + (1.0 if front else -1.0) * (deep * share + off), aside,
                       min(1.0, max(0.0, height / 0.45)))

    def _trunk(self):
        p, mesh = self.person, self.mesh
        rings = [self.trunk_ring(*each) for each in self.profile]
        split = 2 if p.top in ("shirt", "tee") else 1
        mesh.loft(rings[:split + 1], BOTTOM, 12, _TRUNK_SQUARE, caps=(True, False))
        mesh.loft(rings[split:], TOP, 12, _TRUNK_SQUARE, caps=(False, True))
        mesh.limb(self.along(0.47), self.at(0.575, 0.018),
                  [(0.0, 0.066 * self.s), (0.4, 0.056 * self.s), (1.0, 0.053 * self.s)], SKIN, 8)
        outfit.add_collar(self)

    def _head(self):
        p, s = self.person, self.s * self.person.head
        turn = self.yaw(1.0) * 0.4  # eyes stay ahead
        middle = self.along(0.55)
        middle = add(middle, (0.6 * p.stoop * 0.1 * s, 0.0, 0.115 * s))  # the neck is upright whatever the back

        def at(x, y, z):
            return add(middle, turn_z((x * s, y * s, z * s), turn))

        x, y = turn_z((1.0, 0.0, 0.0), turn), turn_z((0.0, 1.0, 0.0), turn)
        self.mesh.loft([ring(at(f, 0.0, z), x, y, rx * s, ry * s) for z, f, rx, ry in _SKULL], SKIN, 12)
        # nose
        self.mesh.limb(at(0.088, 0, 0.028), at(0.118, 0, -0.022), [(0, 0.008 * s), (0.75, 0.015 * s), (1, 0.010 * s)],
                       SKIN, 6, caps=(False, True), until=0)
        for side in (-1, 1):  # eyes and brows
            self.mesh.ball(at(0.0895, side * 0.031, 0.020), (0.009 * s, 0.0125 * s, 0.0075 * s), EYES, 6, 3, until=0)
            self.mesh.limb(at(0.0945, side * 0.013, 0.041), at(0.084, side * 0.049, 0.039),
                           [(0, 0.0055 * s), (1, 0.0045 * s)], HAIR, 4, until=0)
        if p.hair != "headscarf":
            for side in (-1, 1):
                self.mesh.ball(at(0.0, side * 0.074, -0.005), (0.020 * s, 0.009 * s, 0.030 * s), SKIN, 6, 3, until=0)
        hair.add_hair(hair.Head(self, at, x, y, s))

    def _arm(self, side, swing, elbow, aside):
        p, s, mesh = self.person, self.s, self.mesh
        turn = self.yaw(1.0)
        bulk = outfit.SLEEVES.get(p.top, 1.0) * self.g ** 0.5
        shoulder = self.at(0.435, -0.005, side * p.shoulders * 0.465)
        # Outwards enough for the hand to pass beside what hangs over the hips.
        room = (cloth.hem(p) + 0.055 - p.shoulders * 0.465 / s) / 0.55
        out = side * max(0.11 + 0.05 * (self.g - 1.0), min(room, 0.30))
        share, held, more = _CARRYING.get((p.extra, side), (1.0, 0.0, 0.0))
        swing, elbow = swing * share + held, elbow * share + more

        def hang(angle, further):
            down = turn_y((0, 0, -1), -angle)
            return turn_z(unit((down[0], down[1] + out * (1.0 - 0.4 * abs(angle)) + side * further, down[2])), turn)

        upper = hang(swing, aside[0])
        elbow_at = add(shoulder, scale(upper, 0.285 * s))
        fore = unit(add(hang(swing + elbow, aside[1]), (0.0, -side * 0.09, 0.0)))
        wrist = add(elbow_at, scale(fore, 0.245 * s))
        self.arms.append((shoulder, elbow_at, wrist))
        mesh.ball(shoulder, (0.0485 * s * bulk, 0.0485 * s * bulk, 0.052 * s * bulk), TOP, 8, 4, until=1)
        if p.top == "tee":
            mesh.limb(shoulder, mix(shoulder, elbow_at, 0.52), [(0, 0.056 * s * bulk), (1, 0.056 * s * bulk)], TOP,
                      caps=(True, True))
            mesh.limb(mix(shoulder, elbow_at, 0.4), elbow_at,
                      [(0, 0.044 * s * bulk), (0.6, 0.042 * s * bulk), (1, 0.037 * s * bulk)], SKIN)
            mesh.ball(elbow_at, (0.037 * s * bulk,) * 3, SKIN, 8, 4, until=0)
            mesh.limb(elbow_at, wrist, [(0, 0.037 * s * bulk), (0.3, 0.039 * s * bulk), (1, 0.026 * s * bulk)], SKIN,
                      caps=(False, True))
        else:
            mesh.limb(shoulder, elbow_at, [(0, 0.0485 * s * bulk), (0.5, 0.045 * s * bulk), (1.0, 0.0395 * s * bulk)],
                      TOP, caps=(True, False))
            mesh.ball(elbow_at, (0.0395 * s * bulk,) * 3, TOP, 8, 4, until=0)
            mesh.limb(elbow_at, wrist, [(0, 0.0395 * s * bulk), (0.35, 0.039 * s * bulk), (1, 0.030 * s * bulk)], TOP,
                      caps=(False, True))
        hand = unit(add(fore, (0.0, 0.0, -0.25)))
        mesh.limb(add(wrist, scale(fore, -0.015 * s)), add(wrist, scale(hand, 0.165 * s)),
                  [(0, 0.024 * s), (0.25, 0.030 * s), (0.6, 0.035 * s), (0.85, 0.027 * s), (1, 0.012 * s)], SKIN, 8,
                  0.55, side=(1, 0, 0), caps=(False, True))
        return add(wrist, scale(hand, 0.09 * s))

    def _leg(self, side, foot):
        p, s, b, mesh = self.person, self.s, self.build, self.mesh
        spread = side * 0.5 * b.hip_width
        hip = add(self.pelvis, turn_z((0.0, spread * p.hips, -gait.HIP_DROP * s), self.pose.pelvis_yaw))
        ankle = (foot.ankle[0], spread * 0.72 + 0.25 * self.pelvis[1], foot.ankle[1])
        knee_x, knee_z = gait.knee_of((hip[0], hip[2]), (ankle[0], ankle[2]), b)
        knee = (knee_x, 0.5 * (hip[1] + ankle[1]), knee_z)
        self.legs.append((hip, knee, ankle))
        w = s * self.g ** 0.7
        thigh = SKIN if p.bottom == "skirt" else TOP if p.top == "dress" else BOTTOM

        def limb(start, end, profile, material):
            radii = [(share, radius * w) for share, radius in profile]
            self.leg_limbs.append((start, end, radii))
            mesh.limb(start, end, radii, material)

        limb(add(hip, (0, 0, 0.05 * s)), knee, _THIGH, thigh)
        if p.bottom != "shorts":
            mesh.ball(knee, (0.0575 * w,) * 3, SKIN if p.bottom == "skirt" else BOTTOM, 8, 4, until=0)
        if p.bottom in ("skirt", "shorts"):
            limb(mix(hip, knee, 0.7), ankle, _BARE_SHANK, SKIN)
            if p.bottom == "shorts":
                limb(hip, mix(hip, knee, 0.98), _SHORTS, BOTTOM)
        else:
            limb(knee, ankle, _TROUSERS, BOTTOM)
        self._shoe(ankle, foot.pitch)
        return hip, knee, ankle

    def _shoe(self, ankle, pitch):
        """The front of the foot stays flat while the heel rises: it bends at the ball."""
        s, b = self.s, self.build
        bend = max(0.0, -pitch)
        rings = []
        for x, low, high, half in _SHOE:
            angle, local_x, local_z = pitch, x * s, 0.5 * (low + high) * s - b.ankle
            if x > 0.125 and bend:  # toes: turned back up about the ball
                dx, dz, c, n = local_x - b.ball, local_z + b.ankle, math.cos(bend), math.sin(bend)
                local_x, local_z = b.ball + dx * c - dz * n, -b.ankle + dx * n + dz * c
                angle += bend
            c, n = math.cos(pitch), math.sin(pitch)
            thick = 0.5 * (high - low) * s
            rings.append((ankle[0] + local_x * c - local_z * n, ankle[1], ankle[2] + local_x * n + local_z * c,
                          0.0, half * s, 0.0, -thick * math.sin(angle), 0.0, thick * math.cos(angle)))
        self.mesh.loft(rings, SHOES, 8, stands=True)


_WAIST = 0.12  # m above the hips: from here on a bent back bends
_TRUNK_SQUARE = 0.25
# Of the legs' limbs: (share of the length, radius in m).
_THIGH = ((0.0, 0.080), (0.18, 0.091), (0.55, 0.074), (0.9, 0.060), (1.0, 0.0575))
_SHORTS = ((0.0, 0.09), (0.6, 0.086), (1.0, 0.083))
_BARE_SHANK = ((0.0, 0.058), (0.25, 0.054), (0.5, 0.055), (0.75, 0.045), (1.0, 0.034))
_TROUSERS = ((0.0, 0.0575), (0.25, 0.060), (0.6, 0.051), (0.93, 0.046), (1.0, 0.048))


def _profile(person):
    """The trunk with its clothes: [(height above the hips, fore-aft, half width, forward)], in m for
    somebody of standard height."""
    p, g, wide = person, person.girth, person.shoulders * 0.5
    bulk = cloth.BULK.get(p.top, 1.0)
    belly = 0.012 * max(0.0, g - 0.95) / 0.1
    profile = ((-0.07, 0.100 * g, 0.150 * p.hips, -0.010), (0.00, 0.118 * g, 0.168 * p.hips, -0.010),
               (0.08, 0.110 * g, 0.152 * (0.5 + 0.5 * p.hips), 0.0),
               (0.17, 0.106 * g + belly, 0.138 * g, 0.008 + belly),
               (0.27, 0.116 * g + 0.5 * belly, wide * 0.80 * g ** 0.5, 0.010), (0.37, 0.124 * g, wide * 0.93, 0.006),
               (0.43, 0.108 * g, wide * 0.99, -0.004), (0.468, 0.090, wide * 0.80, -0.010),
               (0.495, 0.074, wide * 0.52, -0.012), (0.52, 0.060, 0.070, -0.010))
    return [(h, a * (bulk if h > 0.05 else 1.0), b * (bulk if h > 0.05 else 1.0), f) for h, a, b, f in profile]


def build_figure(person, pose):
    """The rings and parts of one person in one pose (gait.walk_pose or gait.standing_pose with build_of(person)).

    Figures look along +x and stand on z = 0.
    """
    return Figure(person, pose, build_of(person)).mesh
