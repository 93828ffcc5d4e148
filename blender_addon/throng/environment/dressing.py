# SPDX-License-Identifier: Apache-2.0
"""Puts the things of a set into the scene: one mesh a kind, and an object for each thing, so that artists can move and
remove them singly. Renderers keep one copy of a mesh."""
import math
import random
import zlib

import bpy

from ..setting import street_ends
from ..setting.dressing import CARS, dress, dress_country
from ..setting.lamp_places import BEYOND_APART, lamp_places
from ..setting.relief import Relief
from ..setting.trodden import Trodden
from . import cars, furniture, materials, plants, streets, walls
from .lamps import LAMPS
from .shapes import Shape, direction
from .weather import weathered


def build_dressing(bake, collection, terrain=None):
    """Dresses the set of a bake; returns {kind: count}."""
    geometry, bounds = bake.manifest.get("geometry") or {}, _bounds(bake.manifest)
    trodden = Trodden.of_bake(bake)
    holder = bpy.data.collections.new(f"{collection.name} dressing")
    collection.children.link(holder)
    own = geometry.get("roads", [])
    if terrain:
        things, ground = dress_country(*terrain, geometry, trodden, bake.name), Relief(*terrain)
        _keep_lamps(collection, [(x, y, ground.height(x, y) or 0.0) for x, y in lamp_places(own)], trodden)
        return _stand(holder, things)
    roads, houses = street_ends.beyond(geometry)
    lamps = lamp_places(own) + lamp_places(roads, BEYOND_APART)
    _keep_lamps(collection, [(x, y, 0.0) for x, y in lamps], trodden)
    for thing in streets.build_streets({"roads": roads}):
        holder.objects.link(thing)
    holder.objects.link(_pavements(roads))
    _houses(holder, houses, bake.name)
    outlines = [street_ends.corners(*house) for house in houses]
    things = dress(geometry, trodden, bounds, bake.name, beyond=roads, houses=outlines, lamps=lamps)
    counts = _stand(holder, [(*thing, 0.0) for thing in things])
    return {**counts, "house": len(houses)} if houses else counts


def _bounds(manifest):
    bounds = manifest.get("bounds") or {}
    return tuple(tuple(bounds.get(key, fallback))[:2]
                 for key, fallback in (("min", (-50.0, -50.0)), ("max", (50.0, 50.0))))


_FURNITURE = {"bench": furniture.build_bench, "bin": furniture.build_bin, "bollard": furniture.build_bollard,
              "planter": plants.build_planter}


def _keep_lamps(collection, places, trodden):
    """Notes down where lamps are; those that people would walk through hang from cables."""
    collection[LAMPS] = [number for x, y, z in places for number in (x, y, z, float(trodden.free([(x, y)], 0.35)))]


_PAVED_Z = -0.008  # between the ground and areas


def _pavements(roads):
    """Paving along roads beyond the layout, from kerbs to behind the houses."""
    shape = Shape("Throng pavement beyond")
    paving = weathered(materials.slabs("pavement", (0.185, 0.180, 0.168), (0.105, 0.102, 0.097), 0.9))
    for road in roads:
        (a, b), half = road["centreline"], 0.5 * float(road["width"])
        (ux, uy), size = direction(a, b)
        out = half + street_ends.SIDEWALK + street_ends.HOUSE[1] + 2.0
        end = size + street_ends.SIDEWALK + street_ends.HOUSE[1] + 2.0
        shape.flat([(a[0] + ux * s - uy * t, a[1] + uy * s + ux * t)
                    for s, t in ((0.0, -out), (end, -out), (end, out), (0.0, out))], _PAVED_Z, paving)
    return shape.to_object()


def _mesh(kind):
    """The one mesh of a kind, made where there is none."""
    found = bpy.data.meshes.get(f"Throng {kind}")
    if found:
        return found
    if kind in CARS:
        return cars.build_car(kind)
    return _FURNITURE[kind]() if kind in _FURNITURE else plants.build_plant(kind)


def _stand(holder, things):
    """An object for each thing; returns {kind: count}."""
    counts = {}
    for kind, x, y, heading, size, z in things:
        thing = bpy.data.objects.new(f"Throng {kind}", _mesh(kind))
        thing.location, thing.rotation_euler, thing.scale = (x, y, z), (0.0, 0.0, heading), (size,) * 3
        holder.objects.link(thing)
        counts[kind] = counts.get(kind, 0) + 1
    return counts


def _houses(holder, houses, name):
    """Houses along streets beyond the layout: one mesh for each height."""
    chance = random.Random(zlib.crc32(name.encode()))
    for x, y, (ux, uy) in houses:
        thing = bpy.data.objects.new("Throng house beyond", walls.house_mesh(chance.randrange(walls.HOUSES)))
        thing.location, thing.rotation_euler = (x, y, 0.0), (0.0, 0.0, math.atan2(uy, ux))
        holder.objects.link(thing)
