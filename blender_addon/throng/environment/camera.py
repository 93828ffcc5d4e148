# SPDX-License-Identifier: Apache-2.0
"""A crane shot of the crowd: above the street, looking along it at the place where most people are."""
import array
import math
import os

import bpy

from ..formats import BakeError, load_bake
from .shapes import direction, inside

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
    return [(values["pos"][3 * i], values["pos"][3 * i + 1]) for i in range(bake.agents) if values["state"][3 * i] > 0.5]


def _densest(people, radius=6.0):
    """The mean of those in the densest neighbourhood."""
    cells = {}
    for x, y in people:
        cells.setdefault((int(x // radius), int(y // radius)), []).append((x, y))
    def around(cell):
        return [p for dx in (-1, 0, 1) for dy in (-1, 0, 1) for p in cells.get((cell[0] + dx, cell[1] + dy), [])]
    best = max(cells, key=lambda cell: (len(around(cell)), cell))
    near = around(best)
    return sum(p[0] for p in near) / len(near), sum(p[1] for p in near) / len(near)


def _directions(geometry):
    """Ways to look from: along every road, both ways; otherwise from the south-west."""
    found = []
    for road in geometry.get("roads", []):
        line = road["centreline"]
        along, _ = direction(line[0], line[-1])
        found += [along, (-along[0], -along[1])]
    return found or [(-0.6, -0.8)]


def build_camera(scene, manifest, collection):
    bake = _reload(collection)
    frame = int(bake.frames * 0.4) if bake else 0
    people = positions_at(bake, frame) if bake else []
    target = _densest(people) if people else (0.0, 0.0)
    geometry = manifest.get("geometry") or {}
    spread = sorted(math.hypot(x - target[0], y - target[1]) for x, y in people) or [20.0]
    reach = min(max(spread[int(0.5 * (len(spread) - 1))] * 1.7, 12.0), 27.0 if geometry.get("roads") else 70.0)
    solids = [wall["points"] for wall in geometry.get("walls", []) if wall.get("closed")]
    candidates = [u for u in _directions(geometry) if not any(inside([tuple(p) for p in s], (target[0] + u[0] * reach, target[1] + u[1] * reach)) for s in solids)]
    u = (candidates or _directions(geometry))[0]
    # A little to the side: straight down the axis looks like a diagram.
    side = (-u[1], u[0])
    place = (target[0] + u[0] * reach + side[0] * 2.6, target[1] + u[1] * reach + side[1] * 2.6, 4.2 + 0.14 * reach)
    data = bpy.data.cameras.new("Throng camera")
    data.lens, data.clip_end = 36.0, 2000.0
    holder = bpy.data.objects.new("Throng camera", data)
    aim = (target[0] + u[0] * 2.0, target[1] + u[1] * 2.0, 1.6)
    dx, dy, dz = (aim[i] - place[i] for i in range(3))
    holder.location = place
    holder.rotation_euler = (math.atan2(math.hypot(dx, dy), -dz), 0.0, math.atan2(dy, dx) - math.pi / 2)
    data.dof.use_dof, data.dof.aperture_fstop = True, 2.8
    data.dof.focus_distance = math.sqrt(dx * dx + dy * dy + dz * dz) * 0.72
    collection.objects.link(holder)
    scene.camera = holder
    collection["throng_camera_frame"] = scene.frame_start + frame


def _reload(collection):
    path = collection.get("throng_bake")
    if not path or not os.path.exists(path):
        return None
    try:
        return load_bake(path)
    except BakeError:
        return None
