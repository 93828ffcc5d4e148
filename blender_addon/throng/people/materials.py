# SPDX-License-Identifier: Apache-2.0
"""Materials of people. As in the rest of the cast, three random numbers a person (the instance attribute `tint`) pick
colours, and the attribute `pattern` of the mesh says where on the body, the strand or the cloth something is."""
import bpy
import numpy

from ..blender.builds import can_denoise
from ..blender.nodes import of_person
from . import fabrics, hair, masks, palettes
from .shades import Shade

PICTURE = "throng faces"


def material_of(kind, look, bodies):
    """`kind` as parts have it, such as "top knit"; the material of that name, if the file has it already."""
    slot, *rest = kind.split()
    name = f"throng {kind}" + (f" {look}" if slot in ("top", "bottom", "extra") else "")
    found = bpy.data.materials.get(name)
    if found and found.get("throng_people"):
        return found
    shade = Shade(name)
    shade.material["throng_people"] = True
    tint = shade.split(of_person(shade.tree, "tint")[1])
    pattern = shade.attribute("pattern")
    make = {"skin": _skin, "hair": _hair, "grey": _hair, "eyes": _eyes, "lashes": _lashes,
            "teeth": _teeth}.get(slot, fabrics.cloth)
    make(shade, tint, pattern, kind, look, bodies)
    return shade.material


def _picture(number, bodies):
    name = f"{PICTURE} {number}"
    found = bpy.data.images.get(name)
    if found:
        return found
    for index, mask in enumerate(masks.masks(bodies)):
        picture = bpy.data.images.new(f"{PICTURE} {index}", mask.shape[1], mask.shape[0])
        picture.colorspace_settings.name = "Non-Color"
        pixels = numpy.ones((*mask.shape[:2], 4), numpy.float32)
        pixels[..., :3] = mask
        picture.pixels.foreach_set(pixels.ravel())
        picture.pack()
    return bpy.data.images[name]


def _skin(shade, tint, pattern, kind, _look, bodies):
    _, tone, *stubble = kind.split()
    base = shade.palette(tint[2], 1.0, palettes.SKINS[tone])
    ahead, left, up = shade.split(pattern)
    spot = shade.combine(
        shade.math("DIVIDE", shade.math("SUBTRACT", left, masks.LOW[0]), masks.HIGH[0] - masks.LOW[0]),
        shade.math("DIVIDE", shade.math("SUBTRACT", up, masks.LOW[1]), masks.HIGH[1] - masks.LOW[1]), 0.0)
    # what is painted is on the front of the head alone
    front = shade.math("MULTIPLY", shade.math("GREATER_THAN", ahead, 0.035), shade.math("GREATER_THAN", up, 0.592))
    masks_of = []
    for number in range(2):
        image = shade.node("ShaderNodeTexImage", image=_picture(number, bodies), extension="CLIP")
        shade.link(spot, image.inputs[0])
        masks_of += [shade.math("MULTIPLY", front, each) for each in shade.split(image.outputs["Color"])]
    brows, beard, lips, cheeks, shadow, _ = masks_of
    mottle, fine = shade.noise(pattern, 38.0, 4.0), shade.noise(pattern, 260.0)
    colour = shade.mix(base, shade.mix(base, (0.80, 0.42, 0.36), 1.0, "MULTIPLY"), shade.math("MULTIPLY", mottle, 0.30))
    colour = shade.mix(colour, shade.mix(base, (0.96, 0.52, 0.44), 1.0, "MULTIPLY"),
                       shade.math("MULTIPLY", cheeks, 0.55))
    colour = shade.mix(colour, shade.mix(base, (0.60, 0.47, 0.46), 1.0, "MULTIPLY"),
                       shade.math("MULTIPLY", shadow, 0.55))
    colour = shade.mix(colour, shade.mix(base, (0.86, 0.42, 0.42), 1.0, "MULTIPLY"),
                       shade.math("MULTIPLY", lips, 0.68))
    if stubble:
        colour = shade.mix(colour, shade.mix(base, (0.22, 0.22, 0.24), 1.0, "MULTIPLY"),
                           shade.math("MULTIPLY", beard, shade.math("ADD", 0.25, shade.math("MULTIPLY", fine, 0.6))))
    colour = shade.mix(colour, shade.mix(base, (0.10, 0.085, 0.08), 1.0, "MULTIPLY"),
                       shade.math("MULTIPLY", brows, 0.60))
    shade.set(colour, "Base Color")
    shade.set(shade.math("ADD", 0.44, shade.math("MULTIPLY", mottle, 0.20)), "Roughness")
    if can_denoise():  # what light does below skin takes more samples
        shade.set(0.15, "Subsurface", "Subsurface Weight")
        shade.set(colour, "Subsurface Color")
        shade.set((1.0, 0.35, 0.18), "Subsurface Radius")
        shade.set(0.012, "Subsurface Scale")
    shade.set(0.42, "Specular", "Specular IOR Level")
    shade.set(shade.bump(fine, 0.10, 0.0008, shade.bump(mottle, 0.10, 0.002)), "Normal")


def _hair(shade, tint, pattern, kind, _look, _bodies):
    soft, kind = kind.endswith(hair.SOFT), kind.removesuffix(hair.SOFT)
    base = shade.palette(tint[2], 7.0, palettes.HAIR[kind.removeprefix("hair ")])
    across, along, inside = shade.split(pattern)
    strands = shade.noise(shade.combine(shade.math("MULTIPLY", across, 26.0), shade.math("MULTIPLY", along, 2.2), 0.0),
                          1.0, 3.0)
    lock = shade.noise(shade.combine(shade.math("MULTIPLY", across, 2.3), along, 3.0), 1.0, 1.0)
    share = shade.math("MULTIPLY", shade.math("ADD", strands, lock), 0.5)
    colour = shade.mix(shade.mix(base, (0.36, 0.34, 0.32), 1.0, "MULTIPLY"),
                       shade.mix(base, (1.55, 1.5, 1.42), 1.0, "MULTIPLY"), share)
    # darker at the roots, lighter at the tips
    colour = shade.mix(shade.mix(colour, (0.62, 0.60, 0.58), 1.0, "MULTIPLY"), colour,
                       shade.math("MINIMUM", shade.math("ADD", along, 0.35), 1.0))
    shade.set(colour, "Base Color")
    shade.set(0.44, "Roughness")
    shade.set(0.34, "Specular", "Specular IOR Level")
    shade.set(0.6, "Anisotropic")
    shade.set(shade.bump(strands, 0.65, 0.004), "Normal")
    if soft:  # single hairs at its edge
        fine = shade.combine(shade.math("MULTIPLY", across, 70.0), shade.math("MULTIPLY", along, 6.0), 0.0)
        hairs = shade.noise(fine, 1.0, 1.0)
        there = shade.math("SUBTRACT", shade.math("MULTIPLY", inside, 1.4), hairs)
        shade.set(shade.math("MULTIPLY_ADD", there, 3.5, 0.5), "Alpha")
        shade.see_through()


def _lashes(shade, *_):
    shade.set((0.012, 0.010, 0.009), "Base Color")
    shade.set(0.6, "Roughness")


def _teeth(shade, *_):
    shade.set((0.62, 0.56, 0.47), "Base Color")
    shade.set(0.25, "Roughness")


def _eyes(shade, tint, pattern, kind, *_):
    across, upwards, _ = shade.split(pattern)
    away = shade.math("SQRT", shade.math("ADD", shade.math("MULTIPLY", across, across),
                                         shade.math("MULTIPLY", upwards, upwards)))
    iris = shade.palette(tint[2], 13.0, palettes.BROWN_EYES if kind.endswith("brown") else palettes.EYES)
    streaks = shade.noise(pattern, 22.0, 3.0)
    colour = shade.mix(iris, shade.mix(iris, (2.2, 2.0, 1.6), 1.0, "MULTIPLY"), streaks)
    colour = shade.mix(colour, (0.003, 0.003, 0.003), shade.math("LESS_THAN", away, 0.125))
    rim = shade.math("MULTIPLY", shade.math("GREATER_THAN", away, 0.27), 0.8)
    colour = shade.mix(colour, (0.010, 0.008, 0.006), rim)
    colour = shade.mix(colour, (0.40, 0.36, 0.335), shade.math("GREATER_THAN", away, 0.315))
    shade.set(colour, "Base Color")
    shade.set(0.08, "Roughness")
    shade.set(0.4, "Specular", "Specular IOR Level")
