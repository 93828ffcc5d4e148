# SPDX-License-Identifier: Apache-2.0
"""Trees, bushes and hedges: a trunk, limbs, and leaves as single faces in clumps."""
import math
import random
import zlib

import bpy

from ..cast.mesh_builder import cross
from . import materials
from .shading import Shading
from .shapes import Shape

# (height, height where the crown begins, half its width, clumps, leaves, a leaf's length), in metres
_FORMS = {"plane tree": (9.5, 3.2, 2.9, 15, 2100, 0.34), "lime tree": (11.0, 3.0, 2.3, 16, 2100, 0.32),
          "oak": (12.0, 2.2, 5.0, 17, 1500, 0.62), "poplar": (17.0, 1.2, 1.9, 15, 1300, 0.60),
          "bush": (2.6, 0.1, 1.9, 8, 620, 0.36)}
_GREENS = {"plane tree": ((0.020, 0.038, 0.008), (0.075, 0.115, 0.026)),
           "lime tree": ((0.018, 0.042, 0.010), (0.070, 0.125, 0.030)),
           "oak": ((0.016, 0.030, 0.007), (0.060, 0.082, 0.020)),
           "poplar": ((0.020, 0.036, 0.012), (0.070, 0.095, 0.034)),
           "bush": ((0.018, 0.032, 0.009), (0.060, 0.080, 0.022)),
           "hedge": ((0.014, 0.032, 0.010), (0.050, 0.085, 0.024))}


def build_plant(kind):
    """A mesh of a kind of tree or bush."""
    height, begins, half, clumps, leaves, leaf = _FORMS[kind]
    chance, shape = random.Random(zlib.crc32(kind.encode())), Shape(f"Throng {kind}")
    bark = materials.mottled("bark", (0.035, 0.026, 0.019), (0.095, 0.075, 0.058), 6.0, 0.95, 30.0)
    centre = 0.5 * (begins + height)
    shape.limb((0.0, 0.0, -0.3), (0.05, 0.03, centre), 0.022 * height, 0.010 * height, bark)
    crowns = []
    for i in range(clumps):
        up = begins + (height - begins) * (i + 0.5) / clumps
        reach = half * math.sqrt(max(0.05, 1.0 - ((up - centre) / (0.56 * (height - begins))) ** 2))
        turn, out = 2.4 * i + chance.uniform(-0.3, 0.3), reach * chance.uniform(0.35, 0.66)
        crowns.append(((out * math.cos(turn), out * math.sin(turn), up), chance.uniform(0.40, 0.56) * reach + 0.25))
        if kind != "bush" and i % 2 == 0:
            shape.limb((0.0, 0.0, max(0.6 * begins, up - 0.45 * (height - begins))), crowns[-1][0], 0.007 * height,
                  0.003 * height, bark)
    _leaves(shape, crowns, leaves, leaf, chance, _green(kind))
    return shape.to_mesh()


def build_planter():
    """A box with a hedge in it, long along x."""
    shape, chance = Shape("Throng planter"), random.Random(5)
    shape.prism([(-0.75, -0.3), (0.75, -0.3), (0.75, 0.3), (-0.75, 0.3)], 0.0, 0.52,
                materials.mottled("planter", (0.10, 0.095, 0.09), (0.17, 0.165, 0.155), 2.0))
    crowns = [((x, y, 0.66), 0.26) for x in (-0.55, -0.2, 0.2, 0.55) for y in (-0.08, 0.08)]
    _leaves(shape, crowns, 620, 0.10, chance, _green("hedge"))
    return shape.to_mesh()


def _leaves(shape, crowns, count, size, chance, material):
    """Faces on and in the clumps, turned at random, more of them outside."""
    total = sum(radius ** 2 for _, radius in crowns)
    for (x, y, z), radius in crowns:
        for _ in range(int(count * radius ** 2 / total)):
            way = [chance.gauss(0.0, 1.0) for _ in range(3)]
            long = math.sqrt(sum(w * w for w in way)) or 1.0
            out = radius * chance.random() ** 0.28
            middle = (x + way[0] / long * out, y + way[1] / long * out, z + 0.82 * way[2] / long * out)
            u = [chance.gauss(0.0, 1.0) for _ in range(3)]
            v = cross(u, [chance.gauss(0.0, 1.0) for _ in range(3)])
            (lu, lv) = (math.sqrt(sum(w * w for w in axis)) or 1.0 for axis in (u, v))
            half = 0.5 * size * chance.uniform(0.7, 1.3)
            corners = [tuple(middle[axis] + s * half * u[axis] / lu + t * 0.55 * half * v[axis] / lv
                             for axis in range(3)) for s, t in ((-1, 0), (0, -1), (1, 0), (0, 1))]
            shape.face(corners, material)


def _green(kind):
    found = bpy.data.materials.get(f"throng leaves {kind}")
    if found:
        return found
    dark, light = _GREENS[kind]
    material = materials.plain(f"leaves {kind}", light, 0.6)
    shader = next(node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    shading = Shading(material.node_tree)
    # Every leaf and every tree a little different, and dark inside the crown.
    place = shading.node("ShaderNodeTexCoord").outputs["Object"]
    leaf = shading.noise(place, 1.1, 4.0)
    tree = shading.node("ShaderNodeObjectInfo").outputs["Random"]
    mixed = shading.math("ADD", shading.smooth(leaf, 0.3, 0.7), shading.math("MULTIPLY_ADD", tree, 0.5, -0.25))
    shading.link(shading.mix(shading.math("MINIMUM", shading.math("MAXIMUM", mixed, 0.0), 1.0), dark, light),
                 shader.inputs["Base Color"])
    return material
