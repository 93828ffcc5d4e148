# SPDX-License-Identifier: Apache-2.0
"""What parts of a layout are coloured with in the viewport."""
import bpy

COLOURS = {"ROAD": (0.16, 0.20, 0.26, 1.0), "ARROW": (0.85, 0.85, 0.80, 1.0), "AREA": (0.16, 0.42, 0.36, 1.0),
           "WALL": (0.62, 0.55, 0.45, 1.0), "PATCH": (0.30, 0.42, 0.12, 1.0), "LEVEL": (0.24, 0.25, 0.28, 1.0),
           "LINK": (0.55, 0.42, 0.20, 1.0), "FORMATION": (0.85, 0.45, 0.10, 1.0), "SEATS": (0.40, 0.39, 0.37, 1.0),
           "SEAT": (0.06, 0.18, 0.50, 1.0), "PASSAGE": (0.12, 0.11, 0.10, 1.0)}


def material_of(kind):
    name = f"Throng drawing {kind.lower()}"
    material = bpy.data.materials.get(name)
    if material is None:
        material = bpy.data.materials.new(name)
        material.diffuse_color = COLOURS[kind]
    return material
