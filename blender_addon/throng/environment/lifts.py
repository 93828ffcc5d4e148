# SPDX-License-Identifier: Apache-2.0
"""Lifts of a bake: cabins that go up and down, and the doors of each stop, as objects with curves of their own."""
import math

import bpy
import numpy

from . import materials
from .shapes import Shape
from .tracks import fill, read_track

_HEIGHT, _OPEN, _, _STOP = range(4)
_INSIDE = 0.07  # m: a cabin is less wide than its shaft, whose walls have a thickness
_FLOOR, _CEILING, _RAIL, _DOOR = 0.012, 2.25, 1.0, 2.1  # m over its floor
_LEAF = 0.04  # m, thick
_FOLDED = 0.92  # of a leaf that is open: leaves behind each other


def build_lifts(collection, manifest, folder, frame_start):
    """All lifts that a bake has. @param folder the bake's"""
    track = read_track(folder, manifest, "lifts") if folder else None
    if track is None:
        return
    frames = numpy.arange(len(track)) + frame_start
    for number, lift in enumerate(manifest["lifts"]["list"]):
        for thing in _lift(lift, track[:, number], frames):
            collection.objects.link(thing)


def _lift(lift, rows, frames):
    """The cabin, and two leaves at each stop."""
    objects = [_cabin(lift)]
    places = numpy.zeros((len(rows), 3))
    places[:, :2] = lift["at"][:2]
    places[:, 2] = rows[:, _HEIGHT]
    fill(objects[0], "location", frames, places)
    leaf = _leaf_mesh(float(lift["door_width"]))
    for number, stop in enumerate(lift["stops"]):
        is_here = (rows[:, _STOP] == number) & (numpy.abs(rows[:, _HEIGHT] - stop["height"]) < 0.01)
        scales = numpy.ones((len(rows), 3))
        scales[:, 1] -= _FOLDED * numpy.where(is_here, rows[:, _OPEN], 0.0)
        for side in (-1.0, 1.0):
            objects.append(_leaf(lift, stop, side, leaf))
            fill(objects[-1], "scale", frames, scales)
    return objects


def _cabin(lift):
    """Its own x points out of its doors."""
    steel = materials.plain("lift steel", (0.32, 0.33, 0.34), 0.35)
    floor = materials.plain("lift floor", (0.06, 0.06, 0.065), 0.6)
    x, y = 0.5 * float(lift["size"][1]) - _INSIDE, 0.5 * float(lift["size"][0]) - _INSIDE
    cabin = Shape(f"Throng lift {lift['id']}")
    box = [(-x, -y), (x, -y), (x, y), (-x, y)]
    cabin.prism(box, -0.1, _FLOOR, steel, floor)
    cabin.prism(box, _CEILING, _CEILING + 0.1, steel)
    cabin.face([(cx, cy, _CEILING) for cx, cy in box[::-1]], steel)
    for cx, cy in box:
        inward_x, inward_y = cx - math.copysign(0.05, cx), cy - math.copysign(0.05, cy)
        cabin.prism([(cx, cy), (inward_x, cy), (inward_x, inward_y), (cx, inward_y)], _FLOOR, _CEILING, steel)
    walls = [((-x, -y), (x, -y)), ((-x, y), (x, y))]
    if all(stop["doors"] == lift["doors"] for stop in lift["stops"]):
        walls.append(((-x, -y), (-x, y)))
    for a, b in walls:
        cabin.strip(a, b, 0.015, _FLOOR, _RAIL, steel)
    thing = cabin.to_object()
    thing.rotation_euler = (0.0, 0.0, math.radians(lift["doors"]))
    return thing


def _leaf_mesh(door_width):
    """From its jamb, in its own negative y."""
    leaf = Shape("Throng lift door")
    half = 0.5 * _LEAF
    steel = materials.plain("lift door", (0.42, 0.43, 0.44), 0.3)
    leaf.prism([(-half, -0.5 * door_width), (half, -0.5 * door_width), (half, 0.0), (-half, 0.0)], 0.01, _DOOR, steel)
    return leaf.to_mesh()


def _leaf(lift, stop, side, mesh):
    angle = math.radians(stop["doors"])
    out, aside = 0.5 * float(lift["size"][1]), 0.5 * float(lift["door_width"]) * side
    thing = bpy.data.objects.new(f"Throng lift {lift['id']} door", mesh)
    thing.location = (lift["at"][0] + out * math.cos(angle) - aside * math.sin(angle),
                      lift["at"][1] + out * math.sin(angle) + aside * math.cos(angle), stop["height"])
    thing.rotation_euler = (0.0, 0.0, angle if side > 0.0 else angle + math.pi)
    return thing
