# SPDX-License-Identifier: Apache-2.0
"""Light for a time of the day, at night with street lamps and lit windows, and the view transform that photographs it
well."""
import math

import bpy

from .materials import glow, glass, plain
from .shapes import Shape, direction
from .skies import AZIMUTH, build_world, light_of
from .weather import set_haze

_LESS_FROM_AFAR = 0.5  # stops: from afar all the ground is in the sun
_LAMP_HEIGHT, _LAMPS_APART, _MOST_LAMPS, _HUNG_HEIGHT = 5.4, 16.0, 40, 8.5
_WARM = (1.0, 0.66, 0.36)


def build_light(scene, collection, time="late", manifest=None):
    """Lights for a time of the day, in place of those made before."""
    for thing in [thing for thing in collection.objects if "throng_light" in thing]:
        bpy.data.objects.remove(thing)
    light = light_of(time)
    _add(collection, _sun(light.sun))
    scene.world = build_world(time)
    if time == "night":
        _light_streets(collection, manifest or {})
    set_haze(light.haze, light.visibility)
    collection["throng_light_time"] = time
    expose(scene, collection)
    tame_fireflies(scene)
    glow(glass(), 0.3 if time == "night" else 0.0)
    set_colours(scene)


def expose(scene, collection):
    """Exposure for the collection's light and shot."""
    time, shot = collection.get("throng_light_time"), collection.get("throng_shot", "crane")
    if time:
        scene.view_settings.exposure = light_of(time).exposure - (_LESS_FROM_AFAR if shot == "wide" else 0.0)


def lights_of(scene):
    """What the scene's crowds are lit by."""
    return [light_of(collection["throng_light_time"]) for collection in scene.collection.children_recursive
            if "throng_light_time" in collection]


def tame_fireflies(scene):
    """How much of indirect light to keep, by the time of the day that the scene's crowds are lit for."""
    if hasattr(scene, "cycles"):  # which may be disabled
        scene.cycles.sample_clamp_indirect = min((light.clamp for light in lights_of(scene)), default=4.0)


def _add(collection, thing):
    thing["throng_light"] = True
    collection.objects.link(thing)


def _sun(kind):
    sun = bpy.data.lights.new(kind.name, "SUN")
    sun.energy, sun.angle, sun.color = kind.energy, math.radians(kind.angle), kind.colour
    holder = bpy.data.objects.new(kind.name, sun)
    holder.rotation_euler = (math.radians(90.0 - kind.elevation), 0.0, AZIMUTH)
    return holder


def lamp_places(manifest):
    """[(x, y)] along both kerbs of the roads, alternately."""
    places = []
    for road in (manifest.get("geometry") or {}).get("roads", []):
        half, line, next_at, side = 0.5 * float(road["width"]) + 0.5, road["centreline"], 0.5 * _LAMPS_APART, 1
        for a, b in zip(line, line[1:]):
            (ux, uy), size = direction(a, b)
            while next_at < size:
                places.append((a[0] + ux * next_at - uy * half * side, a[1] + uy * next_at + ux * half * side))
                next_at, side = next_at + _LAMPS_APART, -side
            next_at -= size
    roads = (manifest.get("geometry") or {}).get("roads", [])
    return [p for p in places if not any(_on_road(p, road) for road in roads)][:_MOST_LAMPS]


def _on_road(place, road):
    half = 0.5 * float(road["width"])
    for a, b in zip(road["centreline"], road["centreline"][1:]):
        (ux, uy), size = direction(a, b)
        dx, dy = place[0] - a[0], place[1] - a[1]
        if 0.0 <= dx * ux + dy * uy <= size and abs(-dx * uy + dy * ux) < half:
            return True
    return False


def _light_streets(collection, manifest):
    places = lamp_places(manifest)
    if not places:
        _flood(collection, manifest)
        return
    lamp = bpy.data.lights.new("Throng lamp", "POINT")
    lamp.energy, lamp.color, lamp.shadow_soft_size = 520.0, _WARM, 0.16
    posts, heads = Shape("Throng lamp posts"), Shape("Throng lamp heads")
    post = plain("lamp post", (0.03, 0.03, 0.035), 0.5)
    head = glow(plain("lamp head", (0.9, 0.8, 0.6), 0.4).copy(), 25.0, varied=False)
    for x, y in places:
        holder = bpy.data.objects.new("Throng lamp", lamp)
        holder.location = (x, y, _LAMP_HEIGHT - 0.25)
        _add(collection, holder)
        posts.strip((x - 0.05, y), (x + 0.05, y), 0.05, 0.0, _LAMP_HEIGHT, post)
        heads.strip((x - 0.16, y), (x + 0.16, y), 0.16, _LAMP_HEIGHT, _LAMP_HEIGHT + 0.12, head)
    hung = bpy.data.lights.new("Throng hung lamp", "SPOT")  # over junctions, from cables
    hung.energy, hung.color, hung.shadow_soft_size = 2600.0, _WARM, 0.25
    hung.spot_size, hung.spot_blend = math.radians(150.0), 0.8
    for x, y in junctions(manifest):
        holder = bpy.data.objects.new("Throng hung lamp", hung)
        holder.location = (x, y, _HUNG_HEIGHT - 0.15)
        _add(collection, holder)
        heads.strip((x - 0.25, y), (x + 0.25, y), 0.25, _HUNG_HEIGHT, _HUNG_HEIGHT + 0.12, head)
    _add(collection, posts.to_object())
    shining = heads.to_object()
    # the lamps light; rays that found so small a head by chance would be fireflies
    shining.visible_diffuse = shining.visible_glossy = False
    _add(collection, shining)


def junctions(manifest):
    """[(x, y)] where roads cross."""
    found = []
    lines = [[tuple(p[:2]) for p in road["centreline"]] for road in (manifest.get("geometry") or {}).get("roads", [])]
    for i, one in enumerate(lines):
        for other in lines[:i]:
            for a, b in zip(one, one[1:]):
                for c, d in zip(other, other[1:]):
                    turn = (b[0] - a[0]) * (d[1] - c[1]) - (b[1] - a[1]) * (d[0] - c[0])
                    if abs(turn) < 1e-6:
                        continue
                    s = ((c[0] - a[0]) * (d[1] - c[1]) - (c[1] - a[1]) * (d[0] - c[0])) / turn
                    t = ((c[0] - a[0]) * (b[1] - a[1]) - (c[1] - a[1]) * (b[0] - a[0])) / turn
                    if 0.0 <= s <= 1.0 and 0.0 <= t <= 1.0:
                        found.append((a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])))
    return found


def _flood(collection, manifest):
    """Floodlights round what has no streets: a stadium, a square."""
    bounds = manifest.get("bounds") or {}
    (x0, y0), (x1, y1) = (tuple(bounds.get(key, fallback))[:2]
                          for key, fallback in (("min", (-20.0, -20.0)), ("max", (20.0, 20.0))))
    middle, radius = (0.5 * (x0 + x1), 0.5 * (y0 + y1)), 0.5 * math.hypot(x1 - x0, y1 - y0)
    light = bpy.data.lights.new("Throng floodlight", "SPOT")
    light.energy, light.color = 13.0 * radius * radius, (1.0, 0.94, 0.84)
    light.spot_size, light.spot_blend = math.radians(95.0), 0.6
    light.shadow_soft_size = 1.2
    for i in range(4):
        angle = math.pi * (0.25 + 0.5 * i)
        holder = bpy.data.objects.new("Throng floodlight", light)
        high = 0.5 * radius
        holder.location = (middle[0] + 1.05 * radius * math.cos(angle), middle[1] + 1.05 * radius * math.sin(angle),
                           high)
        holder.rotation_euler = (math.atan2(1.05 * radius, high), 0.0, angle + math.pi / 2)
        _add(collection, holder)


def set_colours(scene):
    """AgX where there is one, Filmic before."""
    for transform, look in (("AgX", "AgX - Medium High Contrast"), ("Filmic", "Medium High Contrast")):
        try:
            scene.view_settings.view_transform = transform
            scene.view_settings.look = look
            return
        except TypeError:
            continue
