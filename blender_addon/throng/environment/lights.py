# SPDX-License-Identifier: Apache-2.0
"""A late-afternoon sun, the sky to go with it, and the view transform that photographs it well."""
import math

import bpy

ELEVATION, AZIMUTH = math.radians(31.0), math.radians(128.0)


def build_light(scene, collection):
    sun = bpy.data.lights.new("Throng sun", "SUN")
    sun.energy, sun.angle, sun.color = 3.6, math.radians(0.8), (1.0, 0.90, 0.78)
    holder = bpy.data.objects.new("Throng sun", sun)
    holder.rotation_euler = (math.pi / 2 - ELEVATION, 0.0, AZIMUTH)
    collection.objects.link(holder)
    world = bpy.data.worlds.new("Throng sky")
    world.use_nodes = True
    nodes, links = world.node_tree.nodes, world.node_tree.links
    background = next(node for node in nodes if node.type == "BACKGROUND")
    sky = nodes.new("ShaderNodeTexSky")
    kinds = sky.bl_rna.properties["sky_type"].enum_items.keys()
    sky.sky_type = next(kind for kind in ("NISHITA", "MULTIPLE_SCATTERING", "SINGLE_SCATTERING", "HOSEK_WILKIE") if kind in kinds)
    if hasattr(sky, "sun_disc"):
        sky.sun_disc = False
        sky.sun_elevation = ELEVATION
        sky.sun_rotation = math.pi - AZIMUTH
        sky.altitude = 50.0
        for dust in ("dust_density", "aerosol_density"):
            if hasattr(sky, dust):
                setattr(sky, dust, 1.6)
    links.new(sky.outputs[0], background.inputs[0])
    background.inputs[1].default_value = 0.22
    scene.world = world
    set_colours(scene)
    scene.view_settings.exposure = 0.6


def set_colours(scene):
    """AgX where there is one, Filmic before."""
    for transform, look in (("AgX", "AgX - Medium High Contrast"), ("Filmic", "Medium High Contrast")):
        try:
            scene.view_settings.view_transform = transform
            scene.view_settings.look = look
            return
        except TypeError:
            continue
