# SPDX-License-Identifier: Apache-2.0
"""Skies and suns of the times of the day. Radiances are in one unit, so that the sky is as bright beside what the sun
shines on as it is outdoors: a camera that is set for people then has clouds in its sky, not one white."""
import math
from dataclasses import dataclass

import bpy

from .shading import Shading


@dataclass(frozen=True)
class Sun:
    name: str
    energy: float
    colour: tuple
    angle: float      # degrees across: the edges of shadows
    elevation: float  # degrees above the horizon


@dataclass(frozen=True)
class Clouds:
    cover: float      # 0 none, 1 all of the sky
    soft: float       # from where there is none to where it is thick
    size: float       # the larger, the smaller the clouds
    lit: tuple
    shaded: tuple
    stretch: float = 1.0  # across the sun's way


@dataclass(frozen=True)
class Light:
    sun: Sun
    horizon: tuple
    middle: tuple     # of the sky
    zenith: tuple
    glow: tuple       # round the sun, added
    clouds: Clouds
    haze: tuple       # what far ground fades into
    visibility: float  # m, at which two thirds of what is seen are haze
    exposure: float   # stops, for people in streets
    clamp: float      # of indirect light
    rooms: tuple      # daylight and lamps in rooms behind windows, and the share of flats that is lit


AZIMUTH = math.radians(128.0)  # of all suns: scenes are staged for it

LIGHTS = {
    "noon": Light(Sun("Throng sun", 4.6, (1.0, 0.965, 0.91), 0.55, 58.0),
                  (0.42, 0.50, 0.58), (0.165, 0.27, 0.46), (0.060, 0.135, 0.335), (0.10, 0.09, 0.07),
                  Clouds(0.47, 0.14, 1.5, (0.95, 0.94, 0.92), (0.40, 0.45, 0.53)),
                  (0.42, 0.50, 0.58), 3800.0, 0.2, 4.0, (0.15, 0.12, 0.06)),
    "overcast": Light(Sun("Throng sun", 0.55, (0.94, 0.97, 1.0), 40.0, 62.0),
                      (0.34, 0.365, 0.39), (0.36, 0.385, 0.41), (0.46, 0.48, 0.50), (0.04, 0.04, 0.04),
                      Clouds(0.86, 0.36, 1.1, (0.62, 0.635, 0.65), (0.17, 0.195, 0.23)),
                      (0.34, 0.365, 0.39), 1500.0, 0.85, 4.0, (0.09, 0.12, 0.18)),
    "late": Light(Sun("Throng sun", 3.6, (1.0, 0.85, 0.66), 0.8, 30.0),
                  (0.52, 0.42, 0.31), (0.25, 0.29, 0.36), (0.095, 0.155, 0.285), (0.55, 0.30, 0.11),
                  Clouds(0.48, 0.18, 1.15, (0.86, 0.64, 0.44), (0.235, 0.235, 0.28), 2.2),
                  (0.48, 0.40, 0.32), 2600.0, 0.6, 4.0, (0.10, 0.15, 0.22)),
    "night": Light(Sun("Throng moon", 0.10, (0.60, 0.73, 1.0), 0.8, 48.0),
                   (0.0115, 0.0110, 0.0125), (0.0050, 0.0072, 0.0145), (0.0022, 0.0038, 0.0095), (0.004, 0.005, 0.007),
                   Clouds(0.46, 0.25, 1.15, (0.0150, 0.0150, 0.0175), (0.0048, 0.0055, 0.0085), 1.6),
                   (0.0105, 0.0105, 0.0125), 2600.0, 1.7, 0.4, (0.0015, 0.16, 0.46)),
}
TIMES = tuple(LIGHTS)
# what lies next to a lamp is so bright that the few rays that find it would be fireflies: hence night's clamp


def light_of(time):
    """A light by its name; late, where a scene knows another one."""
    return LIGHTS.get(time, LIGHTS["late"])


def sun_way(light):
    """The unit vector towards the sun."""
    up = math.radians(light.sun.elevation)
    return math.cos(up) * math.sin(AZIMUTH), -math.cos(up) * math.cos(AZIMUTH), math.sin(up)


def build_world(time):
    """A world with a light's sky."""
    light = light_of(time)
    world = bpy.data.worlds.new(f"Throng {time} sky")
    world.use_nodes = True
    background = next(node for node in world.node_tree.nodes if node.type == "BACKGROUND")
    shading = Shading(world.node_tree)
    shading.link(_sky(shading, light), background.inputs[0])
    if hasattr(world, "cycles"):  # not where that add-on is disabled
        # Clouds are large and soft: a map in which rays look for light need not be fine, and takes seconds a frame.
        world.cycles.sampling_method, world.cycles.sample_map_resolution = "MANUAL", 128
    return world


def _sky(shading, light):
    way = shading.node("ShaderNodeTexCoord").outputs["Generated"]
    up = shading.separate(way)[2]
    colour = shading.mix(shading.smooth(up, 0.0, 0.22), light.horizon, light.middle)
    colour = shading.mix(shading.smooth(up, 0.12, 0.85), colour, light.zenith)
    towards = shading.math("MAXIMUM", shading.vector("DOT_PRODUCT", way, sun_way(light)), 0.0)
    wide, narrow = (shading.math("POWER", towards, power) for power in (6.0, 90.0))
    glow = shading.math("ADD", shading.math("MULTIPLY", wide, 0.45), shading.math("MULTIPLY", narrow, 0.55))
    colour = shading.add_colours(colour, shading.times(light.glow, glow))
    return _clouded(shading, light, way, up, colour, glow)


def _clouded(shading, light, way, up, colour, glow):
    """Clouds on a plane overhead, lighter where there are fewer of them towards the sun."""
    clouds, sun = light.clouds, sun_way(light)
    x, y, _ = shading.separate(way)
    down = shading.math("DIVIDE", 1.0, shading.math("ADD", shading.math("MAXIMUM", up, 0.0), 0.16))
    level = math.hypot(sun[0], sun[1])
    ahead, aside = (sun[0] / level, sun[1] / level), (-sun[1] / level, sun[0] / level)

    def on(axis, factor):
        along = shading.math("ADD", shading.math("MULTIPLY", x, axis[0]), shading.math("MULTIPLY", y, axis[1]))
        return shading.math("MULTIPLY", shading.math("MULTIPLY", along, factor), down)

    place = shading.combine(on(ahead, 1.0), on(aside, 1.0 / clouds.stretch), 0.37)
    here = shading.noise(place, clouds.size, 8.0, 0.56)
    nearer = shading.noise(shading.vector("ADD", place, (0.10, 0.0, 0.05)), clouds.size, 4.0, 0.56)
    edge = 0.80 - 0.60 * clouds.cover  # noise is between 0.2 and 0.8, and mostly half
    thick = shading.smooth(here, edge, edge + clouds.soft)
    sunny = shading.smooth(shading.math("SUBTRACT", here, nearer), -0.07, 0.08)
    body = shading.mix(sunny, clouds.shaded, clouds.lit)
    body = shading.add_colours(body, shading.times(light.glow, shading.math("MULTIPLY", glow, 0.5)))
    seen = shading.math("MULTIPLY", thick, shading.smooth(up, 0.015, 0.16, 0.0, 0.94))
    return shading.mix(seen, colour, body)
