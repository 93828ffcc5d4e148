# SPDX-License-Identifier: Apache-2.0
"""Light for a time of the day, at night with street lamps and lit windows, and the view transform that photographs it
well."""
import math

import bpy

from . import lamps
from .rooms import light_rooms
from .skies import AZIMUTH, build_world, light_of
from .weather import set_haze

# Stops by the shot: from afar all the ground is in the sun, and among people in a street half of it is in the shade.
_EXPOSURES = {"wide": -0.5, "street": 0.35}


def build_light(scene, collection, time="late", manifest=None):
    """Lights for a time of the day, in place of those made before."""
    for thing in [thing for thing in collection.objects if "throng_light" in thing]:
        bpy.data.objects.remove(thing)
    light = light_of(time)
    _add(collection, _sun(light.sun))
    scene.world = build_world(time)
    for thing in lamps.build_lamps(collection, manifest or {}, lit=time == "night"):
        _add(collection, thing)
    set_haze(light.haze, light.visibility)
    collection["throng_light_time"] = time
    expose(scene, collection)
    tame_fireflies(scene)
    light_rooms(*light.rooms)
    set_colours(scene)


def expose(scene, collection):
    """Exposure for the collection's light and shot."""
    time, shot = collection.get("throng_light_time"), collection.get("throng_shot", "crane")
    if time:
        scene.view_settings.exposure = light_of(time).exposure + _EXPOSURES.get(shot, 0.0)


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


def set_colours(scene):
    """AgX where there is one, Filmic before."""
    for transform, look in (("AgX", "AgX - Medium High Contrast"), ("Filmic", "Medium High Contrast")):
        try:
            scene.view_settings.view_transform = transform
            scene.view_settings.look = look
            return
        except TypeError:
            continue
