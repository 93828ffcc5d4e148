# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: ADDON BAKE SAVED.blend plain|levels. Times importing and changes of frame, saves the scene."""

import json
import os
import sys
import time

import bpy

addon, bake, saved, levels = sys.argv[-4:]
sys.path.insert(0, addon)
import throng  # noqa: E402

bpy.ops.wm.read_factory_settings(use_empty=True)
throng.register()
bpy.ops.wm.save_as_mainfile(filepath=saved, compress=True)
start = time.perf_counter()
bpy.ops.import_scene.throng(filepath=os.path.join(bake, "bake.json"))
imported = time.perf_counter() - start
if levels == "levels":
    bpy.ops.throng.levels(by="camera")
scene = bpy.context.scene
times = []
for back in 5 * (2, 4, 3, 5, 1, 4, 2, 5, 3, 1, 5, 2):  # near the end: people have spread over all of the cast's gaits
    start = time.perf_counter()
    scene.frame_set(scene.frame_end - back)
    times.append(time.perf_counter() - start)
people = sum(1 for instance in bpy.context.evaluated_depsgraph_get().object_instances if instance.is_instance)
bpy.ops.wm.save_mainfile(compress=True)
print(
    "RESULT "
    + json.dumps(
        {
            "version": bpy.app.version_string,
            "import": imported,
            "frame": min(times),
            "median": sorted(times)[len(times) // 2],
            "people": people,
            "bytes": os.path.getsize(saved),
        }
    )
)
