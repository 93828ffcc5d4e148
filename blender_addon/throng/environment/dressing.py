# SPDX-License-Identifier: Apache-2.0
"""Puts the things of a set into the scene: one mesh a kind, and an object for each thing, so that artists can move and
remove them singly. Renderers keep one copy of a mesh."""
import math
import random
import zlib

import bpy

from ..setting import street_ends
from ..setting.dressing import CARS, dress, dress_country
from ..setting.trodden import Trodden
from . import cars, furniture, plants, streets, walls


def build_dressing(bake, collection, terrain=None):
    """Dresses the set of a bake; returns {kind: count}."""
    geometry, bounds = bake.manifest.get("geometry") or {}, _bounds(bake.manifest)
    trodden = Trodden.of_bake(bake)
    holder = bpy.data.collections.new(f"{collection.name} dressing")
    collection.children.link(holder)
    if terrain:
        return _stand(holder, dress_country(*terrain, geometry, trodden, bake.name))
    roads, houses = street_ends.beyond(geometry)
    for thing in streets.build_streets({"roads": roads}):
        holder.objects.link(thing)
    _houses(holder, houses, bake.name)
    things = dress(geometry, trodden, bounds, bake.name, roads, [street_ends.corners(*house) for house in houses])
    counts = _stand(holder, [(*thing, 0.0) for thing in things])
    return {**counts, "house": len(houses)} if houses else counts


def _bounds(manifest):
    bounds = manifest.get("bounds") or {}
    return tuple(tuple(bounds.get(key, fallback))[:2]
                 for key, fallback in (("min", (-50.0, -50.0)), ("max", (50.0, 50.0))))


_FURNITURE = {"bench": furniture.build_bench, "bin": furniture.build_bin, "bollard": furniture.build_bollard,
              "planter": plants.build_planter}


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
