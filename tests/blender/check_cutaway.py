# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: what is left of a bake with two storeys when the upper one is taken off. ADDON BAKE FOLDER"""
import json
import os
import sys

import bpy

addon, bake, folder = sys.argv[-3:]
sys.path.insert(0, addon)
import throng  # noqa: E402
from throng.crowd.queries import crowd_objects, terrain_of  # noqa: E402

bpy.ops.wm.read_factory_settings(use_empty=True)
throng.register()
bpy.ops.import_scene.throng(filepath=os.path.join(bake, "bake.json"), dressing=False)
scene = bpy.context.scene
crowd = crowd_objects(scene)[0]
scene.frame_set(10)


def left():
    """[heights of people, the highest face of the terrain, names of walls that are seen]"""
    graph = bpy.context.evaluated_depsgraph_get()
    people = sorted(round(i.matrix_world.translation.z, 3) for i in graph.object_instances
                    if i.is_instance and i.parent and i.parent.original == crowd)
    mesh = terrain_of(crowd).evaluated_get(graph).data
    highest = max((face.center.z for face in mesh.polygons), default=None)
    walls = sorted(thing.name for thing in bpy.data.objects if "rail" in thing.name.lower() and not thing.hide_render)
    return [people, highest, walls]


def cut(**settings):
    try:
        result = bpy.ops.throng.cutaway(**settings)
    except RuntimeError as error:
        return str(error)
    bpy.context.view_layer.update()
    return sorted(result)


result = {"all": left(), "level": [cut(by="level", level="deck"), left()]}
bpy.ops.throng.cull(by="camera", margin=1000.0)
bpy.context.view_layer.update()
result["culled, too"] = left()
bpy.ops.throng.cull(by="none")
path, name = os.path.join(folder, "cut.blend"), crowd.name
bpy.ops.wm.save_as_mainfile(filepath=path)
throng.unregister()
bpy.ops.wm.open_mainfile(filepath=path)
throng.register()
crowd, scene = bpy.data.objects[name], bpy.context.scene
scene.frame_set(10)
result["saved"] = left()
result["height"] = [cut(by="height", height=20.0), left()]
result["none"] = [cut(by="none"), left()]
result["unknown"] = [cut(by="level", level="roof"), left()]
print("RESULT " + json.dumps(result))
