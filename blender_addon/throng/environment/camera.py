# SPDX-License-Identifier: Apache-2.0
"""Shots of the crowd: from a crane above the street, from the street, and of everybody from afar."""
import array
import math
import os

import bpy

from ..formats import BakeError, load_bake
from ..formats.terrain_mesh import read_mesh
from ..setting.dressing import FIELD_TREES, STREET_TREES
from ..setting.plane import distance_to
from ..setting.sunlight import houses_of, sunny_share
from .lights import expose
from .shapes import direction, inside
from .skies import light_of, sun_way

_HEADER = 32


def positions_at(bake, frame):
    """[(x, y)] of the people alive at a frame of the bake (from 0)."""
    values = {}
    for stream in ("pos", "state"):
        data = array.array("f")
        with open(bake.stream_path(stream), "rb") as file:
            file.seek(_HEADER + frame * bake.agents * 12)
            data.frombytes(file.read(bake.agents * 12))
        values[stream] = data
    return [(values["pos"][3 * i], values["pos"][3 * i + 1]) for i in range(bake.agents)
            if values["state"][3 * i] > 0.5]


def _dense_places(people, radius=6.0, share=0.6):
    """The means of those in the densest neighbourhoods, the densest first: those with at least this share of its
    people."""
    cells = {}
    for x, y in people:
        cells.setdefault((int(x // radius), int(y // radius)), []).append((x, y))
    def around(cell):
        return [p for dx in (-1, 0, 1) for dy in (-1, 0, 1) for p in cells.get((cell[0] + dx, cell[1] + dy), [])]
    crowds = [near for _, near in sorted(((cell, around(cell)) for cell in cells),
                                         key=lambda found: (len(found[1]), found[0]), reverse=True)]
    return [(sum(p[0] for p in near) / len(near), sum(p[1] for p in near) / len(near))
            for near in crowds if len(near) >= share * len(crowds[0])]


def _directions(geometry):
    """Ways to look from: along every road, both ways; otherwise from the south-west."""
    found = []
    for road in geometry.get("roads", []):
        line = road["centreline"]
        along, _ = direction(line[0], line[-1])
        found += [along, (-along[0], -along[1])]
    return found or [(-0.6, -0.8)]


def _ground_at(terrain, x, y):
    """The height of the terrain's nearest corner; 0 where the ground is flat."""
    if not terrain:
        return 0.0
    xs, ys, zs = (terrain[0][axis::3] for axis in range(3))
    return min(zip(xs, ys, zs), key=lambda p: (p[0] - x) ** 2 + (p[1] - y) ** 2)[2]


SHOTS = ("crane", "street", "wide")
_EYES = 1.95  # m above the ground: a camera on a shoulder, just over most heads
_LENS = 36.0  # mm, on a sensor 36 mm wide
_HIGH = math.radians(24.0)  # above the horizon, of the shot from afar


def build_camera(scene, manifest, collection, shot="crane"):
    """The scene's camera for a crowd; made anew where it has been made before."""
    bake = _reload(collection)
    frame = int(bake.frames * 0.4) if bake else 0
    people = positions_at(bake, frame) if bake else []
    targets = _dense_places(people) if people else [(0.0, 0.0)]
    geometry = manifest.get("geometry") or {}
    if shot == "street":
        place, aim = _street(geometry, people, targets, sun_way(light_of(collection.get("throng_light_time"))))
    else:
        way = _clear_ways(geometry, targets[0])[0]
        place, aim = {"crane": _crane, "wide": _wide}[shot](geometry, people, targets[0], way)
    terrain = read_mesh(bake.terrain_path) if bake and bake.terrain_path else None
    below = _ground_at(terrain, *aim[:2])
    place = (*place[:2], place[2] + max(below, _ground_at(terrain, *place[:2])))
    aim = (*aim[:2], aim[2] + below)
    holder = collection.objects.get(collection.get("throng_camera", "")) or _new_camera(collection)
    holder.animation_data_clear()
    for constraint in [*holder.constraints]:
        holder.constraints.remove(constraint)
    if "throng_crane" in holder:
        del holder["throng_crane"]
    dx, dy, dz = (aim[i] - place[i] for i in range(3))
    distance = math.sqrt(dx * dx + dy * dy + dz * dz)
    holder.location = place
    holder.rotation_euler = (math.atan2(math.hypot(dx, dy), -dz), 0.0, math.atan2(dy, dx) - math.pi / 2)
    holder.data.dof.use_dof, holder.data.dof.aperture_fstop = shot != "wide", 2.8
    holder.data.dof.focus_object, holder.data.dof.focus_distance = None, distance * (1.0 if shot == "wide" else 0.72)
    scene.camera = holder
    _clear_view(collection, place, aim)
    collection["throng_shot"] = shot
    expose(scene, collection)
    collection["throng_camera_frame"] = scene.frame_start + frame
    return holder


_TREES = {f"Throng {kind}" for kind in (*STREET_TREES, *FIELD_TREES)}
_CROWN = 3.2  # m: how far leaves reach
_HIDDEN = "throng_before_lens"


def _clear_view(collection, place, aim, share=0.7):
    """Hides trees that stand before the lens, up to this share of the way to what is aimed at, and shows those that
    did so before."""
    away = math.dist(place[:2], aim[:2]) or 1.0
    ux, uy = (aim[0] - place[0]) / away, (aim[1] - place[1]) / away
    for holder in collection.children:
        for thing in holder.objects if holder.name.startswith(f"{collection.name} dressing") else ():
            dx, dy = thing.location[0] - place[0], thing.location[1] - place[1]
            ahead, aside = dx * ux + dy * uy, abs(dy * ux - dx * uy)
            hides = getattr(thing.data, "name", "") in _TREES and -_CROWN < ahead < share * away and \
                aside < 18.0 / _LENS * max(ahead, 0.0) + _CROWN
            if hides or _HIDDEN in thing:
                thing.hide_render = thing.hide_viewport = hides
            if hides:
                thing[_HIDDEN] = True
            elif _HIDDEN in thing:
                del thing[_HIDDEN]


def _new_camera(collection):
    data = bpy.data.cameras.new("Throng camera")
    data.lens, data.clip_end = _LENS, 12000.0  # the horizon is in it
    holder = bpy.data.objects.new("Throng camera", data)
    collection.objects.link(holder)
    collection["throng_camera"] = holder.name
    return holder


def _clear_ways(geometry, target, reach=24.0):
    """Ways to look from that do not begin in a building."""
    ways = _directions(geometry)
    clear = [u for u in ways if not any(inside(outline, (target[0] + u[0] * reach, target[1] + u[1] * reach))
                                        for outline, _ in houses_of(geometry))]
    return clear or ways


def _crane(geometry, people, target, u):
    spread = sorted(math.hypot(x - target[0], y - target[1]) for x, y in people) or [20.0]
    reach = min(max(spread[int(0.5 * (len(spread) - 1))] * 1.7, 12.0), 27.0 if geometry.get("roads") else 70.0)
    # A little to the side: straight down the axis looks like a diagram.
    place = (target[0] + u[0] * reach - u[1] * 2.6, target[1] + u[1] * reach + u[0] * 2.6, 4.2 + 0.14 * reach)
    return place, (target[0] + u[0] * 2.0, target[1] + u[1] * 2.0, 1.6)


_OFF_WALLS = 3.0  # m
_SUN = 5.0      # m of room before the lens, for which sun on all who are near makes up,
_AGAINST = 3.0  # and which light that comes from ahead costs: faces are dark against it


def _street(geometry, people, targets, sun):
    """In the crowd, where nobody is right before the lens, and the sun shines on those who are near; of places that are
    as good, the one before the densest crowd."""
    houses = houses_of(geometry)

    def clear(place):
        return min((distance_to(a, b, place) for outline, _ in houses
                    for a, b in zip(outline, outline[1:] + outline[:1])), default=_OFF_WALLS) >= _OFF_WALLS

    def room(place, u):
        ahead = [(x - place[0], y - place[1]) for x, y in people]
        return min((math.hypot(*p) for p in ahead if p[0] * -u[0] + p[1] * -u[1] > -0.5), default=10.0)

    def worth(target, place, u):
        away = math.dist(place, target)
        looks = (target[0] - place[0]) / away, (target[1] - place[1]) / away
        against = max(looks[0] * sun[0] + looks[1] * sun[1], 0.0)
        return min(room(place, u), 3.4) + _SUN * sunny_share(houses, place, looks, sun) - _AGAINST * against, -away

    views = [(target, (target[0] + u[0] * along - u[1] * side, target[1] + u[1] * along + u[0] * side), u)
             for target in targets for u in _clear_ways(geometry, target)
             for along in range(8, 18) for side in (-4.0, -3.0, -2.0, -1.0, 1.0, 2.0, 3.0, 4.0)]
    target, place, _ = max([each for each in views if clear(each[1])] or views, key=lambda each: worth(*each))
    return (*place, _EYES), (*target, 1.35)


def _wide(_geometry, people, _target, u):
    """Everybody, from as far away as it takes for a picture of 16 to 9."""
    xs, ys = sorted(p[0] for p in people) or [0.0], sorted(p[1] for p in people) or [0.0]
    middle = (0.5 * (xs[0] + xs[-1]), 0.5 * (ys[0] + ys[-1]))
    distance = 20.0
    while not all(_fits((x - middle[0]) * -u[1] + (y - middle[1]) * u[0],
                        (x - middle[0]) * u[0] + (y - middle[1]) * u[1], distance) for x, y in people):
        distance *= 1.03
    place = (middle[0] + u[0] * distance * math.cos(_HIGH), middle[1] + u[1] * distance * math.cos(_HIGH),
             distance * math.sin(_HIGH))
    return place, (*middle, 0.0)


def _fits(aside, near, distance):
    """Whether somebody is in the picture; places from the middle, `near` towards the camera."""
    wide, high = 0.94 * 18.0 / _LENS, 0.90 * 18.0 * 9.0 / 16.0 / _LENS
    ahead, up = distance - near * math.cos(_HIGH), -near * math.sin(_HIGH)
    return ahead > 1.0 and abs(aside) < wide * ahead and abs(up) < high * ahead


def _reload(collection):
    path = collection.get("throng_bake")
    if not path or not os.path.exists(path):
        return None
    try:
        return load_bake(path)
    except BakeError:
        return None
