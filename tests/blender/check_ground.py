# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: how people stand on a bake's terrain, and on a mesh that only the scene has.

check_ground.py ADDON BAKE FLAT TIMES OUT: the same people on a terrain and on flat ground.
"""
import json
import os
import sys

import bpy

addon, bake, flat, times, out = sys.argv[-5:]
sys.path.insert(0, addon)
import throng  # noqa: E402
from throng.crowd.verify import verify  # noqa: E402
from throng.formats import BakeError  # noqa: E402
from throng.tools.update import reload, set_offset  # noqa: E402


def people(crowd):
    found = {}
    for instance in bpy.context.evaluated_depsgraph_get().object_instances:
        if instance.is_instance and instance.parent and instance.parent.original == crowd:
            found[instance.persistent_id[1]] = [list(row) for row in instance.matrix_world]
    return found


def shots(crowd):
    result = []
    for frame in json.loads(times):
        bpy.context.scene.frame_set(frame)
        result.append(people(crowd))
    return result


def crowd_of(path):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    if not hasattr(bpy.types, "IMPORT_SCENE_OT_throng"):
        throng.register()
    assert bpy.ops.import_scene.throng(filepath=os.path.join(path, "bake.json")) == {"FINISHED"}
    return next(thing for thing in bpy.context.scene.objects if "throng pos" in thing.modifiers)


result = {}
crowd = crowd_of(flat)
result["flat"] = [modifier.name for modifier in crowd.modifiers
                  if "ground" in modifier.name or "conform" in modifier.name]
result["flat"] += [node.bl_idname for tree in bpy.data.node_groups for node in tree.nodes
                   if node.bl_idname == "GeometryNodeRotateInstances"]

crowd = crowd_of(bake)
scene = bpy.context.scene
result["baked"] = shots(crowd)
terrain = bpy.data.objects["Throng terrain"]
result["terrain"] = {"corners": [list(v.co) for v in terrain.data.vertices], "faces": len(terrain.data.polygons),
                     "road": [item.value for item in terrain.data.attributes["throng_road"].data]}
result["ground"] = any(name == "Throng ground" or name.startswith("Throng road") for name in bpy.data.objects.keys())
result["walls"] = {thing.name: [thing.location.z, max(v.co.z for v in thing.data.vertices)] for thing in scene.objects
                   if thing.name.startswith("Throng wall")}
result["camera"] = scene.camera.location.z

result["problems"] = verify(crowd, scene)
set_offset(crowd, 3)
result["starts"] = sorted({modifier.frame_start for modifier in crowd.modifiers if modifier.type == "MESH_CACHE"})
set_offset(crowd, 0)
reload(crowd, scene)
try:
    reload(crowd, scene, os.path.join(flat, "bake.json"))
    result["relinked"] = ""
except BakeError as error:
    result["relinked"] = str(error)

# The flat bake on the terrain's mesh.
mesh = terrain.data
corners, faces = [tuple(v.co) for v in mesh.vertices], [tuple(p.vertices) for p in mesh.polygons]
crowd = crowd_of(flat)
hill = bpy.data.meshes.new("hill")
hill.from_pydata(corners, [], faces)
hill = bpy.data.objects.new("hill", hill)
bpy.context.scene.collection.objects.link(hill)
hill.location.z = 2.0  # moved: people follow
bpy.context.view_layer.update()
try:
    bpy.ops.throng.conform(ground="no such thing")
    result["refused"] = ""
except RuntimeError as error:
    result["refused"] = str(error)
assert bpy.ops.throng.conform(ground="hill") == {"FINISHED"}
assert bpy.ops.throng.conform(ground="hill") == {"FINISHED"}
result["modifiers"] = [modifier.name for modifier in crowd.modifiers]
result["conformed"] = shots(crowd)
bpy.ops.wm.save_as_mainfile(filepath=out)
bpy.ops.throng.release()
result["released"] = shots(crowd)
print("RESULT " + json.dumps(result))
