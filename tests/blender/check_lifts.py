# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: imports a bake with lifts and says where cabins are and how far doors are open."""
import json
import os
import sys

import bpy

addon, bake = sys.argv[-2:]
sys.path[:0] = [addon, os.path.dirname(os.path.abspath(__file__))]
import throng  # noqa: E402

bpy.ops.wm.read_factory_settings(use_empty=True)
throng.register()
assert bpy.ops.import_scene.throng(filepath=os.path.join(bake, "bake.json"), scenery=False, dressing=False) == {
    "FINISHED"}
scene = bpy.context.scene
things = [thing for thing in bpy.data.objects if thing.name.startswith("Throng lift")]
cabins = [thing for thing in things if " door" not in thing.name]
shots = []
for frame in (1, 12, 30, 48):
    scene.frame_set(frame)
    graph = bpy.context.evaluated_depsgraph_get()
    doors = [thing.evaluated_get(graph) for thing in things if " door" in thing.name]
    shots.append({"frame": frame, "cabin": list(cabins[0].evaluated_get(graph).matrix_world.translation),
                  "doors": sorted([round(door.matrix_world.translation.z, 4), door.scale.y] for door in doors)})
corners = [cabins[0].matrix_world.to_3x3() @ vertex.co for vertex in cabins[0].data.vertices]
size = [max(corner[i] for corner in corners) - min(corner[i] for corner in corners) for i in range(3)]
print("RESULT " + json.dumps({"shots": shots, "cabins": len(cabins), "size": size}))
