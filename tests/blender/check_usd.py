# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: opens a USD file and says where its things and its people are, in some frames."""
import json
import sys

import bpy

path, *frames = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.wm.usd_import(filepath=path)
scene, shots = bpy.context.scene, []
for frame in map(int, frames):
    scene.frame_set(frame)
    graph = bpy.context.evaluated_depsgraph_get()
    people = [list(each.matrix_world.translation) for each in graph.object_instances
              if each.is_instance and each.parent and each.parent.name.startswith("Crowd")]
    things = {}
    for thing in bpy.data.objects:
        seen, above = thing.evaluated_get(graph), thing.parent.name if thing.parent else ""
        things[f"{above}/{thing.name}"] = [list(seen.matrix_world.translation), seen.hide_render]
    shots.append({"frame": frame, "people": people, "things": things})
print("RESULT " + json.dumps(shots))
