# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: people moved, retimed and promoted on a bake's terrain. ADDON BAKE MOVED RETIMED HERO FRAMES"""
import json
import math
import os
import sys

import bpy

addon, bake, moved, retimed, hero, frames = sys.argv[-6:]
sys.path.insert(0, addon)
import throng  # noqa: E402

bpy.ops.wm.read_factory_settings(use_empty=True)
throng.register()
assert bpy.ops.import_scene.throng(filepath=os.path.join(bake, "bake.json")) == {"FINISHED"}
scene = bpy.context.scene
crowd = next(thing for thing in scene.objects if "throng pos" in thing.modifiers)
ops = bpy.ops.throng
assert ops.move_people(rows=moved, by=(3.0, -1.0, 0.5), turn=math.radians(10.0)) == {"FINISHED"}
assert ops.retime_people(rows=retimed, offset=-12.5, speed=1.2) == {"FINISHED"}
assert ops.move_people(rows=hero, by=(-4.0, 0.5, 0.0)) == {"FINISHED"}
before = {thing.name for thing in scene.objects}
assert ops.promote_person(rows=hero, hero="Anna") == {"FINISHED"}
armature = next(thing for thing in scene.objects if thing.name not in before and thing.type == "ARMATURE")
result = []
for frame in json.loads(frames):
    scene.frame_set(frame)
    people = {i.persistent_id[1]: [list(row) for row in i.matrix_world]
              for i in bpy.context.evaluated_depsgraph_get().object_instances
              if i.is_instance and i.parent and i.parent.original == crowd}
    result.append({"people": people, "hero": list(armature.matrix_world.translation)})
print("RESULT " + json.dumps(result))
