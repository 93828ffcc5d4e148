# SPDX-License-Identifier: Apache-2.0
"""Street lamps, which shine at night, and floodlights where there are no streets."""
import math

import bpy

from ..setting.lamp_places import junctions, lamp_places
from .materials import glow, plain
from .shapes import Shape

LAMPS = "throng_lamps"  # of a collection whose set is dressed: x, y, z of each lamp, and 1 where nobody walks below it
_HEIGHT, _HUNG_HEIGHT = 5.4, 8.5
_WARM = (1.0, 0.66, 0.36)


def build_lamps(collection, manifest, lit):
    """Objects: posts and heads, lights where they are lit, and floodlights at night where there are no streets."""
    roads = (manifest.get("geometry") or {}).get("roads", [])
    places = _places(collection, roads)
    if not places:
        return _flood(manifest) if lit else []
    if lit:
        return _posts(places, glow(plain("lamp head", (0.9, 0.8, 0.6), 0.4).copy(), 25.0), roads) + \
            _lights(places, roads)
    return _posts(places, plain("lamp head", (0.9, 0.8, 0.6), 0.4))


def _places(collection, roads):
    """[(x, y, z, whether it has a post)]"""
    stored = collection.get(LAMPS)
    if stored is not None:
        stored = list(stored)
        return list(zip(stored[0::4], stored[1::4], stored[2::4], stored[3::4]))
    return [(x, y, 0.0, 1.0) for x, y in lamp_places(roads)]


def _posts(places, head, hung_over=()):
    """Posts and heads; heads alone, as if from cables, where people walk and over junctions."""
    posts, heads = Shape("Throng lamp posts"), Shape("Throng lamp heads" if hung_over else "Throng dark lamp heads")
    metal = plain("lamp post", (0.03, 0.03, 0.035), 0.5)
    for x, y, z, has_post in places:
        heads.strip((x - 0.16, y), (x + 0.16, y), 0.16, z + _HEIGHT, z + _HEIGHT + 0.12, head)
        if has_post:
            posts.strip((x - 0.05, y), (x + 0.05, y), 0.05, z, z + _HEIGHT, metal)
            posts.strip((x - 0.11, y), (x + 0.11, y), 0.11, z, z + 0.55, metal)
            posts.strip((x - 0.20, y), (x + 0.20, y), 0.20, z + _HEIGHT + 0.12, z + _HEIGHT + 0.17, metal)
    for x, y in junctions(hung_over):
        heads.strip((x - 0.25, y), (x + 0.25, y), 0.25, _HUNG_HEIGHT, _HUNG_HEIGHT + 0.12, head)
    shining = heads.to_object()
    if hung_over:  # the lamps light; rays that found so small a head by chance would be fireflies
        shining.visible_diffuse = shining.visible_glossy = False
    return [posts.to_object(), shining]


def _lights(places, roads):
    lamp = bpy.data.lights.new("Throng lamp", "POINT")
    lamp.energy, lamp.color, lamp.shadow_soft_size = 520.0, _WARM, 0.16
    hung = bpy.data.lights.new("Throng hung lamp", "SPOT")  # over junctions, from cables
    hung.energy, hung.color, hung.shadow_soft_size = 2600.0, _WARM, 0.25
    hung.spot_size, hung.spot_blend = math.radians(150.0), 0.8
    found = []
    for light, here in ((lamp, [(x, y, z + _HEIGHT - 0.25) for x, y, z, _ in places]),
                        (hung, [(x, y, _HUNG_HEIGHT - 0.15) for x, y in junctions(roads)])):
        for place in here:
            holder = bpy.data.objects.new(light.name, light)
            holder.location = place
            found.append(holder)
    return found


def _flood(manifest):
    """Floodlights round what has no streets: a stadium, a square."""
    bounds = manifest.get("bounds") or {}
    (x0, y0), (x1, y1) = (tuple(bounds.get(key, fallback))[:2]
                          for key, fallback in (("min", (-20.0, -20.0)), ("max", (20.0, 20.0))))
    middle, radius = (0.5 * (x0 + x1), 0.5 * (y0 + y1)), 0.5 * math.hypot(x1 - x0, y1 - y0)
    light = bpy.data.lights.new("Throng floodlight", "SPOT")
    light.energy, light.color = 13.0 * radius * radius, (1.0, 0.94, 0.84)
    light.spot_size, light.spot_blend = math.radians(95.0), 0.6
    light.shadow_soft_size, found = 1.2, []
    for i in range(4):
        angle = math.pi * (0.25 + 0.5 * i)
        holder = bpy.data.objects.new("Throng floodlight", light)
        high = 0.5 * radius
        holder.location = (middle[0] + 1.05 * radius * math.cos(angle), middle[1] + 1.05 * radius * math.sin(angle),
                           high)
        holder.rotation_euler = (math.atan2(1.05 * radius, high), 0.0, angle + math.pi / 2)
        found.append(holder)
    return found
