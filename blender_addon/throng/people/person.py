# SPDX-License-Identifier: Apache-2.0
"""Somebody as a whole: body, clothes, hair and what is carried, at a level of detail."""
from dataclasses import dataclass, replace

import numpy

from . import bags, cloth, faces, hair, head, levels, palettes, regions, whiskers
from .rig import Rig, skinned
from .shape import shape_of


@dataclass
class Model:
    """Somebody at a level of detail, at rest. `pattern` (V, 3) says where materials look up: on the base mesh for skin,
    along strands for hair, from the pupil for eyes, and in a neutral stand for cloth."""
    faces: numpy.ndarray      # (F, 3)
    points: numpy.ndarray     # (V, 3)
    weights: numpy.ndarray    # (V, B)
    pattern: numpy.ndarray    # (V, 3)
    materials: list
    material_of: numpy.ndarray  # (F,)
    rig: Rig
    moves: dict               # {what moves in a face: (V, 3)} as faces.on_parts() has it, where people are seen closely

    def posed(self, poses):
        """(P, V, 3) in poses of cast/gait.py."""
        return skinned(self.points, self.weights, self.rig.all_matrices(poses))


class Maker:
    """Makes one person; the shape is worked out once for all levels."""

    def __init__(self, bodies, person):
        self.bodies, self.person = bodies, person
        self.shape = shape_of(bodies, person.body)
        self.rig = Rig(bodies, self.shape, person.body.height, stoop=person.stoop, stick=person.stick,
                       holds=person.holds, limp=person.limp, manner=person.manner)
        self._surfaces = {}

    def model(self, level):
        parts = self._parts(level)
        names = sorted({part.material for part in parts})
        first = numpy.cumsum([0, *[len(part.points) for part in parts]])
        neutral = self.rig.neutral()[None]
        return Model(
            numpy.concatenate([part.faces + start for part, start in zip(parts, first)]),
            numpy.concatenate([part.points for part in parts]), numpy.concatenate([part.weights for part in parts]),
            numpy.concatenate([_pattern(part, neutral, self.rig.scale) for part in parts]), names,
            numpy.concatenate([numpy.full(len(part.faces), names.index(part.material)) for part in parts]), self.rig,
            faces.on_parts(self.bodies, self.person.body, self.shape, parts) if level <= levels.CLOSE else {})

    def _parts(self, level):
        person, bodies, shape, scale = self.person, self.bodies, self.shape, self.rig.scale
        seed = person.body.seed
        tailor = cloth.Tailor(bodies, shape, self.rig, level, seed, self._surfaces)
        clothes = cloth.layered([(garment, tailor.wear(garment)) for garment in person.garments])
        colour = f"hair {person.hair_colour}" if person.hair_colour != "grey" else "grey"
        skin = head.skin(bodies, shape, level, person.garments)
        if person.hat == "headscarf":
            keep = numpy.maximum(regions.angle_of(skin.places) - 62.0, 0.0)
            skin = skin.kept(skin.faces[~((keep > 0) & (skin.places[:, regions.HEAD] > 0.5))[skin.faces].all(axis=1)])
        stubble = " stubble" if person.beard else ""
        parts = [replace(skin, material=f"skin {person.skin}{stubble}")]
        parts += head.eyes(bodies, shape, level, person.skin in palettes.BROWN_EYED) + head.lashes(bodies, shape, level)
        parts += head.teeth(bodies, shape, level)
        parts += whiskers.brows(bodies, shape, level, colour, scale, seed)
        parts += whiskers.beard(bodies, shape, level, person.beard, colour, scale, seed)
        parts += clothes
        parts += hair.hair(bodies, shape, level, person.hair, colour, scale, seed, person.hat)
        if person.hat:
            parts += head.hat(bodies, shape, level, person.hat, scale)
        if person.glasses:
            parts += head.glasses(bodies, shape, level, scale, person.glasses == "round")
        upper = [part for part in clothes if part.material.startswith(("top", "shirt"))]
        tops = [part for part in upper if part.material.startswith("top")] or upper
        if person.stick:
            parts += bags.stick(bodies, self.rig, level)
        parts += bags.held(bodies, person.holds, self.rig, level)
        return [part for part in parts + bags.bag(bodies, person.bag, tops, self.rig, level) if len(part.faces)]


def _pattern(part, neutral, scale):
    if part.material.startswith("skin"):
        return part.places[:, :3]
    if part.material.startswith(("hair", "grey", "eyes")):
        return numpy.concatenate([part.flat, part.places[:, :1]], axis=1)
    return skinned(part.points, part.weights, neutral)[0] / scale
