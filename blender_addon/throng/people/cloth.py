# SPDX-License-Identifier: Apache-2.0
"""Clothes, made from the body's own surface: the base mesh brings a suit from neck to toes and a skirt, which follow
every shape. They are smoothed, kept at a distance from the body, loosened, cut by fields, and trimmed."""
from dataclasses import dataclass, replace

import numpy

from . import drape, levels, regions
from .parts import (
    Part, border_of, clipped, evened, folded, grown, laid_on, normals_of, smooth_normals, smoothed, strap_on,
    subdivided)

NECK, CUFF, HEM, FRONT = 1, 2, 3, 4  # tags of cuts
TUCKED_FROM = 0.09  # tops that end above are tucked in
_HANGS = 0.5     # how much of a hem hangs on the pelvis, not on legs
_THICK = 0.005  # m, how far edges are turned in
_EDGE_ROUNDS = 40  # of smoothing along edges
_OVER = 0.018   # m, that the others fall outside of what is worn below them
SUIT, SKIRT = "helper-tights", "helper-skirt"
_COLLARS = {  # rows of (up, away from the neck), m
    "crew": ((0.006, -0.004), (0.011, -0.002), (0.009, 0.004)),
    "shirt": ((0.018, -0.005), (0.026, 0.001), (0.008, 0.013), (-0.020, 0.030)),
    "roll": ((0.022, -0.003), (0.044, -0.005), (0.050, 0.002), (0.034, 0.008), (0.008, 0.011)),
    "coat": ((0.020, -0.003), (0.030, 0.004), (0.006, 0.024), (-0.028, 0.042)),
    "hood": ((0.014, 0.006), (0.030, 0.024), (0.016, 0.050), (-0.022, 0.060), (-0.050, 0.045)),
    "stand": ((0.020, -0.004), (0.042, -0.006), (0.045, 0.000), (0.022, 0.004)),
}


@dataclass(frozen=True)
class Garment:
    kind: str                # top, legs, skirt, shoes
    material: str            # "top knit": what it is worn as, and of what
    off: float = 0.010       # m, from the body
    loose: float = 0.10      # how much wider than the limbs
    smooth: int = 4          # rounds
    sleeve: float = 0.97     # until where on the arm
    hem: float = 0.02        # height on the base mesh
    waist: float = 0.19
    width: float = 1.0       # of trouser legs
    flare: float = 0.0
    pleats: float = 0.0
    neck: tuple = (1.0, 1.0)
    vee: float = None        # the bottom of a V
    gap: tuple = None        # an open front: (half width at the waist, at the neck)
    collar: str = ""
    lapels: float = 0.0      # m
    pockets: tuple = ()      # chest, hip, thigh, kangaroo
    belt: str = ""           # its material
    heel: float = 0.0
    folds: float = 1.0


class Tailor:
    """Makes somebody's clothes at a level of detail."""

    def __init__(self, bodies, shape, rig, level, seed, surfaces=None):
        """@param surfaces what has been worked out of the same clothes for other levels, to be added to"""
        self.bodies, self.shape, self.rig, self.level, self.seed = bodies, shape, rig, level, seed
        self._surfaces = {} if surfaces is None else surfaces
        self.detail, self.scale = levels.DETAILS[level], rig.scale
        self.places = regions.places_of(bodies)

    def wear(self, garment):
        """Its parts."""
        return {"top": self._top, "legs": self._legs, "skirt": self._skirt, "shoes": self._shoes}[garment.kind](garment)

    def bone(self, *names):
        """How much vertices of the base mesh hang on bones, both sides."""
        return self.bodies.weights[:, [self.bodies.bone[name] for name in names]].sum(axis=1)

    # --- the surface

    def _surface(self, garment, group=SUIT):
        """Where the suit is, loosened: points for all vertices of the base mesh."""
        if (garment, group) not in self._surfaces:
            self._surfaces[garment, group] = self._loosened(garment, group)
        return self._surfaces[garment, group]

    def _loosened(self, garment, group):
        triangles = self.bodies.triangles(group)
        numbers = numpy.unique(triangles)
        place = numpy.zeros(len(self.shape), int)
        place[numbers] = numpy.arange(len(numbers))
        faces, body = place[triangles], self.shape[numbers]
        off = garment.off * max(self.scale, 0.8)
        points = smoothed(body + off * normals_of(body, faces), faces, garment.smooth)
        normals = normals_of(points, faces)
        near = ((points - body) * normals).sum(axis=1)
        points += normals * numpy.maximum(0.0, off - near)[:, None]
        whole = self.shape.copy()
        whole[numbers] = points
        if garment.kind == "top":
            whole = self._loose_sleeves(garment, self._loose_trunk(garment, whole))
        if garment.kind == "legs":
            whole = self._loose_legs(garment, whole)
        whole[numbers] = smoothed(whole[numbers], faces, 2, 0.4)
        return whole

    def _loose_trunk(self, garment, points):
        """Cloth falls from shoulder blades, chest and belly, the straighter the looser it is, and stays a little away
        from the waist."""
        trunk = (self.places[:, regions.ARM] <= 0.0) & (self.places[:, regions.Z] < 0.46)
        trunk &= self.places[:, regions.Z] > -0.16
        middle = numpy.array([0.5 * (points[trunk, 0].max() + points[trunk, 0].min()), 0.0])
        found = points.copy()
        if garment.hem < TUCKED_FROM:
            steepest = numpy.interp(garment.loose, (0.05, 0.10, 0.17, 0.25), (0.50, 0.34, 0.20, 0.12))
            hangs = numpy.clip((0.10 - self.places[trunk, regions.Z]) / 0.08, 0.0, 1.0)
            found[trunk] = drape.Fall(points[trunk], middle, steepest).moved(points[trunk], hangs)
        low, high = self.rig.heads["pelvis"][2], self.bodies.joint(self.shape, "spine-1")[2]
        bulge = numpy.sin(numpy.clip((high - points[:, 2]) / (high - low), 0.0, 1.0) * 2.6) * garment.loose
        found[trunk, :2] += (found[trunk, :2] - middle) * (0.35 * bulge[trunk] + garment.flare)[:, None]
        return found

    def _loose_sleeves(self, garment, points):
        """Loosest at the elbow; cuffs are close."""
        arm = numpy.clip(self.places[:, regions.ARM], 0.0, 1.2)
        share = numpy.interp(arm, (0.0, 0.2, 0.5, 0.75, 0.97), (0.10, 0.30, 0.50, 0.45, 0.12)) * garment.loose
        if garment.sleeve < 0.6:  # short ones are open
            share = numpy.interp(arm, (0.0, 0.2, 0.45), (0.10, 0.35, 1.1)) * garment.loose
        for side in "lr":
            joints = [self.rig.heads[f"{bone}_{side}"] for bone in ("upperarm", "lowerarm", "hand")]
            for bone, (start, stop) in (("upperarm", joints[:2]), ("lowerarm", joints[1:])):
                away = _from_axis(points, start, stop)
                points = points + away * (share * self.bone(f"{bone}_{side}"))[:, None]
        return points

    def _loose_legs(self, garment, points):
        for side in "lr":
            hip, knee, ankle = (self.rig.heads[f"{bone}_{side}"] for bone in ("thigh", "calf", "foot"))
            least = 0.52 * abs(hip[1]) * garment.width  # of a leg of cloth below the knee
            share = numpy.clip((points[:, 2] - ankle[2]) / (knee[2] - ankle[2]), -0.3, 1.0)
            away = points - (ankle + (knee - ankle) * share[:, None])
            away[:, 2] = 0.0
            size = numpy.linalg.norm(away, axis=1) + 1e-9
            wanted = numpy.maximum(size, least * (1.0 + (0.12 + garment.flare) * (1.0 - share)))
            points = points + away * ((wanted / size - 1.0) * self.bone(f"calf_{side}", f"foot_{side}"))[:, None]
            share = numpy.clip((points[:, 2] - knee[2]) / (hip[2] - knee[2]), 0.0, 1.0)
            away = points - (knee + (hip - knee) * share[:, None])
            away[:, 2] = 0.0
            points = points + away * (garment.loose * 1.2 * (1.08 - share) * self.bone(f"thigh_{side}"))[:, None]
        return points

    def _part(self, points, group, material):
        """A part of the level's triangles; the finest are cut smaller."""
        triangles = levels.triangles_of(self.bodies, group, self.level)
        numbers, faces = numpy.unique(triangles, return_inverse=True)
        part = Part(faces.reshape(-1, 3), points[numbers], self.bodies.weights[numbers], self.places[numbers], material)
        for _ in range(self.detail.finer):
            part = subdivided(part)
        return part

    # --- garments

    def _top(self, garment):
        part = self._part(self._surface(garment), SUIT, garment.material)
        places = part.places
        if self.detail.finer and garment.folds:
            part = part.moved(part.points + part.normals * self._folds(part, garment)[:, None])
        if garment.hem > TUCKED_FROM:  # below the belt it is under trousers and skirts
            under = _ramp(0.215 - places[:, regions.Z], 0.0, 0.03) * (places[:, regions.ARM] <= 0.0)
            part = part.moved(part.points - part.normals * (0.012 * self.scale * under)[:, None])
        else:  # it falls over trousers and skirts
            over = _ramp(0.15 - places[:, regions.Z], 0.0, 0.09) * (places[:, regions.ARM] <= 0.0)
            part = part.moved(part.points + part.normals * (_OVER * self.scale * over)[:, None])
            part = self._hung(part)
        part = clipped(part, self._above(part, garment, garment.hem), HEM)
        part = clipped(part, regions.sleeve(part.places, garment.sleeve), CUFF)
        part = clipped(part, regions.neckline(part.places, *garment.neck), NECK)
        if garment.vee is not None:
            part = clipped(part, regions.vee(part.places, garment.vee), FRONT)
        if garment.gap:
            part = clipped(part, regions.gap(part.places, *garment.gap, garment.hem), FRONT)
        return self._trimmed(part, garment)

    def _hung(self, part):
        """What falls over the hips goes less with a leg than cloth does that is round it, and so hems stay level."""
        share = _HANGS * _ramp(0.13 - part.places[:, regions.Z], 0.0, 0.12) * (part.places[:, regions.ARM] <= 0.0)
        weights = part.weights * (1.0 - share)[:, None]
        weights[:, self.bodies.bone["pelvis"]] += share
        return replace(part, weights=weights)

    def _above(self, part, garment, height):
        """Positive above a height on the base mesh, and its zero is level, as hems of what falls are, whatever the
        shape; at all levels of detail the same. Arms are inside."""
        group = SKIRT if garment.kind == "skirt" else SUIT
        points, numbers = self._surface(garment, group), numpy.unique(self.bodies.triangles(group))
        near = numbers[(self.places[numbers, regions.ARM] <= 0.0)
                       & (numpy.abs(self.places[numbers, regions.Z] - height) < 0.03)]
        level = numpy.median(points[near, 2] + self.scale * (height - self.places[near, regions.Z]))
        return regions.on_trunk(part.places, part.points[:, 2] - level)

    def _legs(self, garment):
        part = self._part(self._surface(garment), SUIT, garment.material)
        if self.detail.finer and garment.folds:
            part = part.moved(part.points + part.normals * self._folds(part, garment)[:, None])
        part = clipped(part, regions.below(part.places, garment.waist), HEM)
        part = clipped(part, regions.above(part.places, garment.hem), CUFF)
        return self._trimmed(part, garment)

    def _skirt(self, garment):
        part = self._part(self._surface(garment, SKIRT), SKIRT, garment.material)
        part = clipped(part, numpy.minimum(garment.waist - part.places[:, regions.Z], 1.0), HEM)
        part = clipped(part, part.places[:, regions.Z] - garment.hem, HEM)
        high, low = part.points[:, 2].max(), part.points[:, 2].min()
        share = (high - part.points[:, 2]) / max(high - low, 1e-6)
        middle = part.points[:, 0].mean()
        angle = numpy.arctan2(part.points[:, 1], part.points[:, 0] - middle)
        waves = numpy.sin(angle * 13.0 + 2.0 * numpy.sin(2.0 * angle + self.seed)) if self.level < 1 else 0.0
        wider = 1.0 + share * (garment.flare + garment.pleats * waves)
        points = part.points.copy()
        points[:, 1] *= wider
        points[:, 0] = middle + (points[:, 0] - middle) * wider
        return self._trimmed(part.moved(points), garment)

    def _trimmed(self, part, garment):
        """With a collar, lapels, pockets, a belt, and edges that have a thickness."""
        if self.level < 1:  # no edge is ragged
            part = part.moved(smoothed(part.points, part.faces, _EDGE_ROUNDS, 0.5, part.tags == 0))
        extras = []
        if self.detail.trimmed:
            for pocket in garment.pockets:
                extras += self._pocket(part, pocket, garment)
            if garment.belt:
                extras += self._belt(part, garment)
        if garment.lapels and self.detail.trimmed:
            part = self._lapels(part, garment)
        if garment.collar and self.level < 2:
            part = self._collar(part, _COLLARS[garment.collar])
        if self.detail.trimmed:
            tags = [CUFF, HEM, FRONT] if garment.collar else [NECK, CUFF, HEM, FRONT]
            part = folded(part, _THICK * self.scale, tags)
        return [part, *extras]

    def _collar(self, part, rows):
        neck = self.rig.heads["neck_01"]
        border = border_of(part.faces)
        border = border[(part.tags[border] == NECK).all(axis=1)]
        if len(border) < 4:
            return part
        rows = rows if self.detail.trimmed else rows[:1] + rows[-1:]

        ends = numpy.unique(border)

        # where the front is open, collars end, and are narrow there
        open_ = numpy.bincount(border.ravel(), minlength=len(part.points))[ends] == 1
        size = numpy.minimum(1.0, 0.3 + evened(1.0 - open_[:, None], border, ends, 14))

        def rings(points, _normals):
            away = (points - neck) * (1.0, 1.0, 0.0)
            away = evened(away / (numpy.linalg.norm(away, axis=1, keepdims=True) + 1e-9), border, ends)
            # lower before the throat than behind
            lower = numpy.where(away[:, 0] > 0.5, 0.8, 1.0)[:, None]
            line = evened(points, border, ends, 6)
            return [line + self.scale * size * (lower * up * numpy.array([0.0, 0.0, 1.0]) + aside * away)
                    for up, aside in rows]

        return grown(part, border, rings)

    def _lapels(self, part, garment):
        """The edges of the front, turned over: widest below the collar."""
        border = border_of(part.faces)
        border = border[(part.tags[border] == FRONT).all(axis=1)]
        if not len(border):
            return part
        ends = numpy.unique(border)
        height = part.places[ends, regions.Z]
        bottom = garment.vee if garment.vee is not None else 0.18
        share = numpy.clip((height - bottom) / (0.49 - bottom), 0.0, 1.0)
        width = garment.lapels * self.scale * numpy.where(share < 0.80, share / 0.80, 1.0 - 4.8 * (share - 0.80))

        normals = evened(smooth_normals(part)[ends], border, ends, 20)
        normals /= numpy.linalg.norm(normals, axis=1, keepdims=True) + 1e-9
        width = evened(width[:, None], border, ends, 4)[:, 0]

        def rings(points, _normals):
            aside = numpy.stack([0.0 * height, numpy.sign(points[:, 1]), 0.25 + 0.0 * height], axis=1)
            aside -= normals * (aside * normals).sum(axis=1, keepdims=True)
            aside /= numpy.linalg.norm(aside, axis=1, keepdims=True) + 1e-9
            lift = (0.010 + 0.0 * height)[:, None]
            return [points + normals * lift + 0.1 * width[:, None] * aside,
                    points + normals * lift * 0.8 + width[:, None] * aside]

        return grown(part, border, rings)

    def _pocket(self, part, kind, garment):
        low, high = {"chest": ((0.05, 0.045, 0.385), (None, 0.105, 0.465)),
                     "hip": ((-0.02, 0.060, 0.035), (None, 0.135, 0.120)),
                     "kangaroo": ((0.03, -0.105, 0.075), (None, 0.105, 0.205)),
                     "thigh": ((-0.075, 0.115, -0.235), (0.09, None, -0.120)),
                     "back": ((None, 0.035, -0.015), (-0.03, 0.105, 0.085))}[kind]
        sides = (0.0,) if kind == "kangaroo" else (-1.0, 1.0) if kind != "chest" else (1.0,)
        return [piece for side in sides
                for piece in laid_on(part, regions.box(low, high, side), 0.004 * self.scale, garment.material)]

    def _belt(self, part, garment):
        # of coats and dresses above what the skirt covers
        middle = (garment.waist if garment.kind != "top" else 0.190) - 0.020
        trunk = clipped(part, regions.but_arms(part.places, 1.0))
        if not len(trunk.faces):
            return []
        line = self._above(trunk, garment, middle)
        return strap_on(trunk, line, 0.034 * self.scale, 0.0055 * self.scale, garment.belt,
                        self.level == levels.NEAR)

    def _folds(self, part, garment):
        """How far the cloth goes out, m: ridges, here and there, across limbs where joints bend and where cloth piles
        up, and from the armpits over the chest."""
        points, wave, other = part.points / self.scale, _Waves(self.seed), _Waves(self.seed + 1)
        wander, patches = 0.6 * wave(points * 8.0) + 0.25 * wave(points * 19.0), _ramp(other(points * 7.0), -0.4, 0.7)
        if garment.kind == "top":
            height = self._folds_of_top(part, points, wander)
        else:
            level, height = part.places[:, regions.Z], numpy.zeros(len(points))
            for middle, wide, often, far in ((-0.74, 0.09, 58.0, 0.0090), (-0.38, 0.09, 46.0, 0.0060),
                                             (0.02, 0.09, 40.0, 0.0065)):
                lean = 16.0 * points[:, 0] + 12.0 * numpy.abs(points[:, 1])
                ridges = _ridges(level * often + lean + 2.6 * wander)
                height += numpy.exp(-((level - middle) / wide) ** 2) * ridges * far
        return height * (0.25 + 0.75 * patches) * garment.folds * self.scale

    def _folds_of_top(self, part, points, wander):
        weights = dict(zip(self.bodies.bones, part.weights.T))
        arm, height = part.places[:, regions.ARM], numpy.zeros(len(points))
        amount = 0.15 + numpy.exp(-((arm - 0.53) / 0.12) ** 2) + 0.6 * numpy.exp(-((arm - 0.92) / 0.08) ** 2)
        height += numpy.where(arm > 0.0, amount, 0.0) * _ridges(arm * 27.0 + 9.0 * points[:, 0] + 2.8 * wander) * 0.0070
        low = weights["spine_01"] + weights["spine_02"] + weights["pelvis"]
        side = _ramp(numpy.abs(points[:, 1]), 0.02, 0.13)
        sag = points[:, 2] * 34.0 + numpy.abs(points[:, 1]) * 26.0
        height += low * (0.35 + 0.65 * side) * _ridges(sag + 2.8 * wander) * 0.0060
        chest = points[:, 2] * 17.0 - numpy.abs(points[:, 1]) * 34.0
        return height + weights["spine_03"] * _ridges(chest + 2.4 * wander) * 0.0048

    def _shoes(self, garment):
        """The suit's feet, whose toes are one, with a sole."""
        part = self._part(self.shape, SUIT, garment.material)
        part = clipped(part, regions.below(part.places, garment.hem), CUFF)
        points = smoothed(part.points, part.faces, 3 if self.level < 2 else 0)
        normals = normals_of(points, part.faces)
        points = points + 0.008 * self.scale * normals
        low = points[:, 2] < 0.026 * self.scale
        flat = normals * (1.0, 1.0, 0.0)
        points = points + flat * (0.006 * self.scale * low)[:, None]
        under = low & (normals[:, 2] < -0.35)
        points[:, 2] = numpy.where(under, -self.rig.sole, points[:, 2])
        points[:, 2] = numpy.maximum(points[:, 2], -self.rig.sole)
        part = part.moved(points)
        sole = low[part.faces].all(axis=1)
        parts = [part.kept(part.faces[~sole]), replace(part.kept(part.faces[sole]), material="shoes sole")]
        return [folded(parts[0], 0.006, [CUFF]) if self.detail.trimmed else parts[0],
                *(each for each in parts[1:] if len(each.faces))]


def _ridges(phase):
    """Narrow ridges and wide valleys, from -0.4 to 0.6."""
    return (1.0 - numpy.abs(numpy.sin(phase))) ** 1.6 - 0.4


def _ramp(values, low, high):
    share = numpy.clip((values - low) / (high - low), 0.0, 1.0)
    return share * share * (3.0 - 2.0 * share)


class _Waves:
    """A smooth noise from -1 to 1: sines in all directions."""

    def __init__(self, seed):
        draw = numpy.random.default_rng(seed)
        self.ways, self.starts = draw.normal(size=(8, 3)), draw.random(8) * 6.28

    def __call__(self, points):
        return numpy.sin(points @ self.ways.T + self.starts).sum(axis=1) / 4.0


def _from_axis(points, start, stop):
    """From the nearest places of a line between two points."""
    along = (stop - start) / numpy.linalg.norm(stop - start)
    share = numpy.clip((points - start) @ along, 0.0, numpy.linalg.norm(stop - start))
    return points - start - share[:, None] * along


def covered(places, garment, margin):
    """Positive where a garment does not cover what is under it, by more than a margin (m)."""
    if garment.kind == "skirt":
        inside = regions.below(places, garment.waist - margin)
        return -numpy.minimum(inside, places[:, regions.Z] - max(garment.hem + 0.12, -0.25))
    if garment.kind == "shoes":
        return -regions.below(places, garment.hem - margin)
    if garment.kind == "legs":
        return -numpy.minimum(regions.below(places, garment.waist - margin),
                              regions.above(places, garment.hem + margin))
    inside = numpy.minimum(regions.above(places, garment.hem + margin), regions.sleeve(places, garment.sleeve))
    arm = places[:, regions.ARM] > 0.0
    inside = numpy.where(arm, inside - margin, inside)
    inside = numpy.minimum(inside, regions.neckline(places, *garment.neck) - margin)
    inside = numpy.minimum(inside, 0.605 - places[:, regions.Z])  # heads are free
    if garment.vee is not None:
        inside = numpy.minimum(inside, regions.vee(places, garment.vee) - margin)
    if garment.gap:
        inside = numpy.minimum(inside, regions.gap(places, *garment.gap, garment.hem) - margin)
    return -inside


def layered(worn):
    """Parts of garments from the inside out: an inner one loses what the outer ones hide.

    @param worn [(garment, parts)]
    """
    found = []
    for number, (_, parts) in enumerate(worn):
        for part in parts:
            for garment, _ in worn[number + 1:]:
                if len(part.faces):
                    part = clipped(part, covered(part.places, garment, 0.03))
            if len(part.faces):
                found.append(part)
    return found
