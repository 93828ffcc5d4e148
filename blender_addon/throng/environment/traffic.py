# SPDX-License-Identifier: Apache-2.0
"""Lanes, crossings, signals and the vehicles of a bake. Vehicles are objects with curves of their own, a key a frame,
as an animator would have them: nothing runs while Blender renders."""
import math

import bpy
import numpy

from . import materials, passengers, rails, vehicle_doors
from .keys import key_hidden
from .shapes import Shape, counter_clockwise, direction
from .streets import MARK_Z, ROAD_Z
from .tracks import fill, read_track
from .vehicle_shapes import body_of, build_axle
from .weather import weathered

_STRIPE = 0.5  # m, of a zebra
_X, _Y, _Z, _HEADING, _SPEED, _ALONG, _STATE, _BRAKING = range(8)


def build_street(traffic):
    """What is painted and paved, as objects."""
    asphalt = weathered(materials.mottled("asphalt", (0.040, 0.041, 0.043), (0.075, 0.075, 0.076), 0.25, 0.9, 60.0,
                                          0.12))
    paint = weathered(materials.mottled("paint", (0.42, 0.42, 0.40), (0.70, 0.70, 0.68), 3.0, 0.7, 30.0))
    street = Shape("Throng lanes")
    for number, lane in enumerate(traffic["lanes"]):
        _pave(street, lane, ROAD_Z - 0.0005 * (number + 1), asphalt)
    for crossing in traffic["crossings"]:
        _zebra(street, crossing["polygon"], _way_near(traffic, crossing["polygon"]), asphalt, paint)
    for lane in traffic["lanes"]:
        for stop in lane["stops"]:
            if "signal" in stop:
                _stop_line(street, lane, stop["at"], paint)
    return [street.to_object()]


def _pave(shape, lane, z, asphalt):
    half, line = 0.5 * float(lane["width"]), [tuple(p[:2]) for p in lane["points"]]
    for a, b in zip(line, line[1:]):
        (ux, uy), size = direction(a, b)
        shape.flat([(a[0] + ux * s - uy * t, a[1] + uy * s + ux * t)
                    for s, t in ((-half, -half), (size + half, -half), (size + half, half), (-half, half))], z, asphalt)


def _nearest(lane, place):
    """(distance, place on the lane, unit vector along it)."""
    best = None
    line = [tuple(p[:2]) for p in lane["points"]]
    for a, b in zip(line, line[1:]):
        (ux, uy), size = direction(a, b)
        along = min(max((place[0] - a[0]) * ux + (place[1] - a[1]) * uy, 0.0), size)
        at = (a[0] + ux * along, a[1] + uy * along)
        apart = math.dist(at, place[:2])
        if best is None or apart < best[0]:
            best = (apart, at, (ux, uy))
    return best


def _way_near(traffic, polygon):
    middle = [sum(p[axis] for p in polygon) / len(polygon) for axis in (0, 1)]
    found = [_nearest(lane, middle) for lane in traffic["lanes"]]
    return min(found)[2] if found else (1.0, 0.0)


def _zebra(shape, polygon, along, asphalt, paint):
    """Stripes along the lane, cut where the crossing's box ends."""
    outline = counter_clockwise(polygon)
    shape.flat(outline, ROAD_Z, asphalt)
    aside = (-along[1], along[0])
    local = [(p[0] * along[0] + p[1] * along[1], p[0] * aside[0] + p[1] * aside[1]) for p in outline]
    (x0, x1), (y0, y1) = ((min(v), max(v)) for v in zip(*local))
    at = y0 + 0.5 * _STRIPE
    while at + _STRIPE <= y1:
        shape.flat([(x * along[0] + y * aside[0], x * along[1] + y * aside[1])
                    for x, y in ((x0, at), (x1, at), (x1, at + _STRIPE), (x0, at + _STRIPE))], MARK_Z, paint)
        at += 2.0 * _STRIPE


def _stop_line(shape, lane, place, paint):
    _, at, (ux, uy) = _nearest(lane, place)
    half = 0.5 * float(lane["width"]) - 0.2
    shape.flat([(at[0] + ux * s - uy * t, at[1] + uy * s + ux * t)
                for s, t in ((0.1, -half), (0.45, -half), (0.45, half), (0.1, half))], MARK_Z, paint)


# Signals

def build_signals(traffic, fps, frame_start, frames):
    """A post at each stop of a signal, with lamps that are keyed as the signal goes."""
    signals = {signal["id"]: signal for signal in traffic["signals"]}
    objects = []
    for lane in traffic["lanes"]:
        for stop in lane["stops"]:
            if "signal" not in stop:
                continue
            _, at, (ux, uy) = _nearest(lane, stop["at"])
            aside = 0.5 * float(lane["width"]) + 0.45
            place = (at[0] + uy * aside, at[1] - ux * aside)
            times = _green_times(signals[stop["signal"]], lane["id"], frames / fps)
            objects += _post(place, math.atan2(uy, ux), times, fps, frame_start)
    return objects


def _green_times(signal, lane, seconds):
    """[(time, whether green)] of all changes, the first at 0 s or before."""
    cycle = sum(phase["seconds"] for phase in signal["phases"])
    time, found = -float(signal["offset"]) % cycle - cycle, []
    while time < seconds:
        for phase in signal["phases"]:
            green = lane in phase["lanes"]
            if not found or found[-1][1] != green:
                found.append((time, green))
            time += phase["seconds"]
    before = [change for change in found if change[0] <= 0.0]
    return before[-1:] + [change for change in found if change[0] > 0.0]


def _post(place, heading, times, fps, frame_start):
    dark = materials.plain("signal post", (0.03, 0.035, 0.03), 0.5)
    post = Shape("Throng signal")
    pole = [(0.05 * math.cos(math.tau * i / 10), 0.05 * math.sin(math.tau * i / 10)) for i in range(10)]
    post.prism(pole, 0.0, 2.3, dark)
    post.prism([(-0.06, -0.14), (0.14, -0.14), (0.14, 0.14), (-0.06, 0.14)], 2.3, 3.1, dark)
    objects = [post.to_object()]
    for name, z, colour, lit in (("red", 2.88, (0.9, 0.03, 0.02), False), ("green", 2.52, (0.03, 0.8, 0.25), True)):
        lamp = Shape(f"Throng {name} lamp")
        ring = [(-0.066, 0.09 * math.cos(t), z + 0.09 * math.sin(t)) for t in (math.tau * i / 14 for i in range(14))]
        lamp.face(ring[::-1], materials.glowing(f"signal {name}", colour, 6.0))
        thing = lamp.to_object()
        for time, green in times:
            key_hidden(thing, green != lit, frame_start + max(math.ceil(time * fps), 0))
        objects.append(thing)
    for thing in objects:
        thing.location, thing.rotation_euler = (*place, 0.0), (0.0, 0.0, heading)
    return objects


# Vehicles

def build_traffic(collection, manifest, folder, frame_start, roads, terrain, people=None):
    """All of it that a bake has.

    @param roads whether the street is built; a terrain takes its place; @param people as build_environment() has them
    """
    traffic = (manifest.get("geometry") or {}).get("traffic")
    if not traffic:
        return
    objects = build_street(traffic) if roads and not terrain else []
    objects += build_signals(traffic, float(manifest["fps"]), frame_start, int(manifest["frames"]))
    track = read_track(folder, manifest, "vehicles") if folder else None
    if track is not None:
        objects += rails.build_rails(traffic, manifest, track) if roads and not terrain else []
        objects += build_vehicles(manifest, track, frame_start, read_track(folder, manifest, "doors"), people)
    for thing in objects:
        collection.objects.link(thing)


def build_vehicles(manifest, track, frame_start, doors=None, people=None):
    """All vehicles, with their axles, doors and passengers, keyed. @param doors what the bake tells of these, if
    anything; @param people as build_environment() has them"""
    bodies, axles, objects = {}, {}, []
    seen = passengers.standing(*people) if people and doors is not None else ()
    for number, what in enumerate(manifest["vehicles"]["list"]):
        there = numpy.flatnonzero(track[:, number, _STATE] > 0.0)
        if not len(there):
            continue
        kind = what["kind"]
        opening = vehicle_doors.opens(manifest, number) if doors is not None else None
        look = (kind, number % 3 if kind == "car" else 0, what["flow"] if opening else "")
        if look not in bodies:
            bodies[look] = body_of(kind, number, what, opening)
        mesh, places = bodies[look]
        thing = bpy.data.objects.new(f"Throng {kind} {number}", mesh)
        frames = there + frame_start
        rows = track[there, number]
        fill(thing, "location", frames, rows[:, [_X, _Y, _Z]])
        turns = numpy.zeros((len(there), 3))
        turns[:, 2] = numpy.unwrap(rows[:, _HEADING])
        fill(thing, "rotation_euler", frames, turns)
        _hide_while_away(thing, frames, frame_start)
        objects.append(thing)
        if opening:
            leaves = vehicle_doors.leaves_of(thing, what, opening, doors[there, number], frames)
            for leaf in leaves:
                _hide_while_away(leaf, frames, frame_start)
            objects += leaves
            aboard = numpy.zeros(len(track))
            aboard[there] = doors[there, number, vehicle_doors.ABOARD] if seen else 0.0
            objects += passengers.passengers_of(thing, what, opening, number, aboard, seen, frame_start)
        for x, radius, half_track, broad in places:
            shape = (radius, half_track, broad)
            if shape not in axles:
                axles[shape] = build_axle(*shape)
            axle = bpy.data.objects.new(f"{thing.name} axle", axles[shape])
            axle.parent, axle.location = thing, (x, 0.0, radius)
            turns = numpy.zeros((len(there), 3))
            turns[:, 1] = rows[:, _ALONG] / radius
            fill(axle, "rotation_euler", frames, turns)
            _hide_while_away(axle, frames, frame_start)
            objects.append(axle)
    return objects


def _hide_while_away(thing, frames, frame_start):
    if frames[0] > frame_start:
        key_hidden(thing, True, frame_start)
    key_hidden(thing, False, int(frames[0]))
    key_hidden(thing, True, int(frames[-1]) + 1)
