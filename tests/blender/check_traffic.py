# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: imports a bake with vehicles and says where they are, how wheels turn, which lamps are lit."""
import json
import math
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
vehicles = [thing for thing in bpy.data.objects if thing.name.startswith("Throng car") and thing.parent is None]
shots = []
for frame in (2, 10, 40):
    scene.frame_set(frame)
    graph = bpy.context.evaluated_depsgraph_get()
    found = []
    for thing in vehicles:
        now = thing.evaluated_get(graph)
        axle = next(child for child in thing.children).evaluated_get(graph)
        found.append({"place": list(now.matrix_world.translation), "heading": now.rotation_euler.z,
                      "hidden": now.hide_render, "turn": axle.rotation_euler.y})
    doors = [list(thing.evaluated_get(graph).matrix_world.translation) for thing in bpy.data.objects
             if thing.name.startswith("Throng tram") and " door" in thing.name]
    riders = [list(thing.evaluated_get(graph).matrix_world.translation) for thing in bpy.data.objects
              if "throng_passenger" in thing and not thing.evaluated_get(graph).hide_render]
    lamps = {thing.name.split(".")[0]: not thing.hide_render for thing in bpy.data.objects if " lamp" in thing.name}
    shots.append({"frame": frame, "vehicles": found, "lamps": lamps, "doors": doors,
                  "passengers": riders})
lowest = min((thing.matrix_world @ vertex.co).z for thing in bpy.data.objects if " axle" in thing.name
             for vertex in thing.data.vertices)
size = [max(v.co[i] for v in vehicles[0].data.vertices) - min(v.co[i] for v in vehicles[0].data.vertices)
        for i in range(3)]
print("RESULT " + json.dumps({"shots": shots, "lowest": lowest, "size": size, "turns": math.tau,
                               "streets": sum(thing.name.startswith("Throng lanes") for thing in bpy.data.objects)}))
