# SPDX-License-Identifier: Apache-2.0
"""What walls of houses are faced with: plaster, bricks, ashlar and concrete, weathered: dirty at the foot, with streaks
below. Patterns run along each wall, whichever way it looks."""
import bpy

from . import materials
from .shading import Shading

PLASTER = [((0.36, 0.24, 0.17), (0.44, 0.31, 0.22)), ((0.42, 0.39, 0.33), (0.52, 0.48, 0.41)),
           ((0.47, 0.40, 0.28), (0.56, 0.48, 0.35)), ((0.31, 0.34, 0.33), (0.40, 0.43, 0.41))]
BRICKS = [((0.19, 0.060, 0.040), (0.30, 0.115, 0.075)), ((0.155, 0.088, 0.058), (0.26, 0.165, 0.105)),
          ((0.30, 0.24, 0.155), (0.42, 0.345, 0.235))]
CONCRETE = [((0.30, 0.30, 0.29), (0.40, 0.395, 0.38)), ((0.20, 0.205, 0.21), (0.28, 0.285, 0.29))]

# (width, height, joint) in metres, and how much darker or lighter joints and pieces are
_PATTERNS = {"brick": (0.25, 0.083, 0.010, 1.25, 0.30), "ashlar": (1.1, 0.55, 0.022, 0.42, 0.07),
             "panels": (2.7, 1.75, 0.014, 0.45, 0.05)}


def plaster(number):
    which = number % len(PLASTER)
    return _facing(f"plaster {which}", *PLASTER[which])


def ashlar(number):
    """Plaster with joints as of large stones, a little darker: ground floors."""
    which = number % len(PLASTER)
    return _facing(f"ashlar {which}", *(tuple(0.86 * c for c in colour) for colour in PLASTER[which]), "ashlar")


def bricks(number):
    which = number % len(BRICKS)
    return _facing(f"bricks {which}", *BRICKS[which], "brick")


def concrete(number):
    which = number % len(CONCRETE)
    return _facing(f"concrete {which}", *CONCRETE[which], "panels")


def _facing(name, dark, light, pattern=None):
    found = bpy.data.materials.get(f"throng {name}")
    if found:
        return found
    material = materials.mottled(name, dark, light, 0.35, 0.9, 9.0)
    shader = next(node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    shading = Shading(material.node_tree)
    coordinates = shading.node("ShaderNodeTexCoord").outputs
    x, y, z = shading.separate(coordinates["Object"])
    nx, ny, _ = shading.separate(coordinates["Normal"])
    along = shading.math("SUBTRACT", shading.math("MULTIPLY", y, nx), shading.math("MULTIPLY", x, ny))
    colour = shader.inputs["Base Color"].links[0].from_socket
    if pattern:
        colour = _pieces(shading, shader, shading.combine(along, z, 0.0), colour, pattern)
    shading.link(shading.times(colour, _weather(shading, along, z)), shader.inputs["Base Color"])
    return material


def _pieces(shading, shader, place, colour, pattern):
    width, height, joint, joints, varied = _PATTERNS[pattern]
    wall = shading.node("ShaderNodeTexBrick", offset=0.5 if pattern != "panels" else 0.0)
    shading.link(place, wall.inputs["Vector"])
    for name, value in (("Scale", 1.0), ("Brick Width", width), ("Row Height", height), ("Mortar Size", joint),
                        ("Mortar Smooth", 0.2), ("Color1", (1.0 - varied,) * 3 + (1.0,)),
                        ("Color2", (1.0 + varied,) * 3 + (1.0,)), ("Mortar", (joints,) * 3 + (1.0,))):
        wall.inputs[name].default_value = value
    bump = shading.node("ShaderNodeBump", invert=True)
    bump.inputs["Strength"].default_value, bump.inputs["Distance"].default_value = 0.6, 0.4 * joint
    shading.link(wall.outputs["Fac"], bump.inputs["Height"])
    shading.link(bump.outputs[0], shader.inputs["Normal"])
    return shading.vector("MULTIPLY", colour, wall.outputs["Color"])


def _weather(shading, along, z):
    """How much darker rain and the street have made a wall."""
    streaks = shading.noise(shading.combine(shading.math("MULTIPLY", along, 2.6), shading.math("MULTIPLY", z, 0.16),
                                            0.0), 1.0, 4.0)
    streaked = shading.smooth(streaks, 0.36, 0.66, 0.80, 1.06)
    ragged = shading.math("MULTIPLY_ADD", shading.noise(shading.combine(along, z, 3.1), 1.3, 5.0), 1.5, -0.75)
    return shading.math("MULTIPLY", streaked, shading.smooth(shading.math("ADD", z, ragged), -0.1, 1.7, 0.50, 1.0))
