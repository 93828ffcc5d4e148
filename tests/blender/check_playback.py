# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: imports a bake and prints what the scene shows at the asked times, as JSON."""
import json
import math
import os
import sys

import bpy

addon, bake, times = sys.argv[-3:]
sys.path[:0] = [addon, os.path.dirname(os.path.abspath(__file__))]
import throng  # noqa: E402
from pose_names import Names  # noqa: E402

bpy.ops.wm.read_factory_settings(use_empty=True)
throng.register()
assert bpy.ops.import_scene.throng(filepath=os.path.join(bake, "bake.json"), scenery=False,
                                   camera=False) == {"FINISHED"}
scene = bpy.context.scene
crowd = bpy.data.objects["Throng sample crowd"]
names = Names()
result = {"fps": scene.render.fps / scene.render.fps_base, "range": [scene.frame_start, scene.frame_end], "shots": [],
          "gate": []}
for frame, sub in json.loads(times):
    scene.frame_set(frame, subframe=sub)
    result["gate"].append([frame, bpy.data.objects["Throng wall gate"].hide_render])
    depsgraph = bpy.context.evaluated_depsgraph_get()
    people = {}
    for instance in depsgraph.object_instances:
        if not instance.is_instance or not instance.parent or instance.parent.original != crowd:
            continue
        matrix = instance.matrix_world
        people[instance.persistent_id[1]] = [names.of(instance.object.data), matrix.translation.x, matrix.translation.y,
                                             math.atan2(matrix[1][0], matrix[0][0])]
    result["shots"].append({"frame": frame, "sub": sub, "people": people})
print("RESULT " + json.dumps(result))
