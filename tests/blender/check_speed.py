# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: how much processor time importing a bake takes, and a change of frame."""
import json
import os
import sys
import time

import bpy

addon, bake = sys.argv[-2:]
sys.path.insert(0, addon)
import throng  # noqa: E402

bpy.ops.wm.read_factory_settings(use_empty=True)
throng.register()
start = time.process_time()
bpy.ops.import_scene.throng(filepath=os.path.join(bake, "bake.json"))
imported = time.process_time() - start
scene = bpy.context.scene
times = []
for back in 5 * (2, 4, 3, 5, 1, 4, 2, 5, 3, 1, 5, 2):  # near the end: people have spread over all of the cast's gaits
    start = time.process_time()
    scene.frame_set(scene.frame_end - back)
    times.append(time.process_time() - start)
people = sum(1 for i in bpy.context.evaluated_depsgraph_get().object_instances if i.is_instance)
result = {"import": imported, "frame": min(times), "median": sorted(times)[len(times) // 2], "people": people}
print("RESULT " + json.dumps(result))
