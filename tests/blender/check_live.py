# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: a layout is drawn, its crowd is watched, it is changed, made wrong and mended; then a bake.
ADDON FOLDER"""
import json
import os
import sys
import time

import bpy
import numpy

addon, folder = sys.argv[-2:]
sys.path.insert(0, addon)
import throng  # noqa: E402

bpy.ops.wm.read_factory_settings(use_empty=True)
throng.register()
from throng.live import discs, preview  # noqa: E402

scene, result = bpy.context.scene, {}


def until(condition, seconds=90):
    """As Blender's timer and its windows would."""
    end = time.monotonic() + seconds
    while not condition():
        shown = preview.running()
        assert shown is None or shown.tick(bpy.context), shown.job.message
        bpy.context.view_layer.update()
        assert time.monotonic() < end, (shown and shown.job.told, [each.message for each in problems()])
        time.sleep(0.02)


def problems():
    return scene.throng_layout.problems


def told():
    return preview.running().job.told.get("state")


def crowds():
    return preview.running().job.listener.crowds


def changed(thing):
    """As an edit by hand does."""
    thing.update_tag()
    bpy.context.view_layer.update()


# ---- a road with people
bpy.ops.throng.add_road(length=30.0, width=6.0)
road = bpy.context.object
scene.throng_layout.simulation.duration = 5.0
bpy.ops.throng.add_flow(count=20)
objects = len(bpy.data.objects)
scene.throng_live_clock = "TIMELINE"
assert bpy.ops.throng.live() == {"FINISHED"}
file = preview.running().file.path
until(lambda: told() == "complete")
result["people"] = preview.running().job.crowd.count
result["status"] = preview.running().status()
result["objects"] = len(bpy.data.objects) - objects
scene.frame_set(scene.frame_start + 60)
places, radii, colours = preview.running().discs(scene)
result["places"] = [float(abs(places[:, 1]).max()), len(places), len(radii), len(colours)]
later = preview.running().job.crowd.at(90)[0]
result["moved"] = float(numpy.abs(later[:len(places), 0] - places[:len(later), 0]).max())
corners, shades = discs.triangles(places, radii, colours)
result["triangles"] = [corners.shape[0] == shades.shape[0] == 30 * len(places),
                       float(numpy.abs(corners[:, :2].reshape(len(places), 30, 2) - places[:, None, :2]).max())]

# ---- it is changed: the road is moved
first = crowds()
road.location.y += 100.0
begin = time.monotonic()
changed(road)
until(lambda: crowds() > first and told() == "complete")
result["seconds"] = time.monotonic() - begin
result["there"] = float(preview.running().discs(scene)[0][:, 1].mean())

# ---- and made wrong, which leaves the crowd where it was, and mended
shown = preview.running().job.crowd
selected = [thing.name for thing in bpy.context.selected_objects]
road.throng_layout.width = 0.0
road.throng_layout["width"] = 0.0
changed(road)
until(lambda: told() == "mistaken" and len(problems()))
result["mistake"] = [[each.pointer, each.target.name if each.target else ""] for each in problems()]
result["selected"] = selected == [thing.name for thing in bpy.context.selected_objects]
result["kept"] = preview.running().job.crowd is shown
road.throng_layout.width = 6.0
changed(road)
until(lambda: told() == "complete" and not len(problems()))
result["mended"] = len(problems())

# ---- nothing is left
assert bpy.ops.throng.live_stop() == {"FINISHED"}
result["left"] = [os.path.exists(file), preview.running() is None, preview._on_change in
                  bpy.app.handlers.depsgraph_update_post]

# ---- a bake under way, which no import plays
try:
    bpy.ops.import_scene.throng(filepath=os.path.join(folder, "bake.unfinished", "under-way.json"))
except RuntimeError as error:
    result["imported"] = str(error)
assert bpy.ops.throng.live_bake(filepath=os.path.join(folder, "bake.unfinished", "under-way.json")) == {"FINISHED"}
until(lambda: told() == "baking" and preview.running().job.crowd.frames)
result["baking"] = [preview.running().status(), preview.running().job.crowd.count]
open(os.path.join(folder, "go on"), "w").close()
until(lambda: told() == "baked")
result["baked"] = [preview.running().status(), preview.running().job.crowd.end]
throng.unregister()
result["over"] = preview.running() is None
print("RESULT " + json.dumps(result))
