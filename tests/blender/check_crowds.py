# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: two crowds, verified, damaged, moved, re-loaded, shown in part and later; saved and opened."""
import json
import os
import shutil
import sys

import bpy

addon, first, second, folder = sys.argv[-4:]
sys.path.insert(0, addon)
import throng  # noqa: E402
from throng.crowd.queries import crowd_objects  # noqa: E402
from throng.crowd.verify import verify  # noqa: E402

bpy.ops.wm.read_factory_settings(use_empty=True)
throng.register()
bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, "scene.blend"))
load = lambda path, **options: bpy.ops.import_scene.throng(filepath=os.path.join(path, "bake.json"),
                                                           scenery=False, camera=False, **options)
assert load(first) == {"FINISHED"} and load(second, frame_start=11) == {"FINISHED"}
scene = bpy.context.scene


def people_of(crowd):
    graph = bpy.context.evaluated_depsgraph_get()
    return {i.persistent_id[1]: tuple(round(v, 4) for v in i.matrix_world.translation)
            for i in graph.object_instances if i.is_instance and i.parent and i.parent.original == crowd}


a, b = crowd_objects(scene)
result = {"sound": [verify(each, scene) for each in (a, b)], "counts": [len(a.data.vertices), len(b.data.vertices)]}

# Later: what was at a frame is there so many frames on.
scene.frame_set(20)
before = people_of(b)
for each in (a, b):
    each.select_set(each == b)
assert bpy.ops.throng.show(percent=100.0, offset=7) == {"FINISHED"}
scene.frame_set(27)
result["later"] = people_of(b) == before and len(before) > 0
assert bpy.ops.throng.show(percent=30.0, offset=0) == {"FINISHED"}
scene.frame_set(20)
part = people_of(b)
result["part"] = [len(part), len(before), set(part.items()) <= set(before.items())]
scene.frame_set(21)
result["same"] = len(set(part) - set(people_of(b)))
assert bpy.ops.throng.show(percent=100.0, offset=0) == {"FINISHED"}

# Damage is told, and mended where it can be.
material = bpy.data.materials[0]
material.diffuse_color = (1.0, 0.0, 0.0, 1.0)
stream = os.path.join(second, "streams", "dir.pc2")
aside = os.path.join(folder, "aside")
shutil.move(stream, aside)
result["missing"] = verify(b, scene)
shutil.move(aside, stream)
table = os.path.join(second, "streams", "pos.npy")  # which playing needs not
with open(table, "r+b") as file:
    file.seek(1000)
    byte = file.read(1)[0]
    file.seek(1000)
    file.write(bytes([byte ^ 4]))
    file.flush()
    result["flipped"] = verify(b, scene)
    file.seek(1000)
    file.write(bytes([byte]))
with open(os.path.join(second, "notes.txt"), "w", encoding="utf-8"):
    result["stranger"] = verify(b, scene)
os.remove(os.path.join(second, "notes.txt"))
scene.render.fps = 30
result["fps"] = verify(a, scene)
b.data.vertices.add(3)
result["rows"] = verify(b, scene)
for each in (a, b):
    each.select_set(True)
assert bpy.ops.throng.reload() == {"FINISHED"}
result["mended"] = [verify(each, scene) for each in (a, b)]
result["look"] = tuple(material.diffuse_color)

# Another bake in the place of the first; then a broken one, which changes nothing.
a.select_set(True)
b.select_set(False)
assert bpy.ops.throng.relink(filepath=os.path.join(second, "bake.json")) == {"FINISHED"}
result["relinked"] = [len(a.data.vertices), a.modifiers["throng pos"].filepath]
try:
    bpy.ops.throng.relink(filepath=os.path.join(folder, "nowhere", "bake.json"))
    result["broken"] = "no error"
except RuntimeError as error:
    result["broken"] = str(error)
result["after"] = a.modifiers["throng pos"].filepath
assert bpy.ops.throng.verify() == {"FINISHED"}

bpy.ops.wm.save_mainfile()
bpy.ops.wm.open_mainfile(filepath=os.path.join(folder, "scene.blend"))
scene = bpy.context.scene
reopened = crowd_objects(scene)
result["reopened"] = [verify(each, scene) for each in reopened]
scene.frame_set(20)
result["people"] = [len(people_of(each)) for each in reopened]
throng.unregister()
print("RESULT " + json.dumps(result))
