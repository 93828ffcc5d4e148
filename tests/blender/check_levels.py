# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: which level of detail everybody has, by a camera that moves; then off again, and from a saved
file without the add-on."""
import json
import os
import sys

import bpy

addon, bake, folder = sys.argv[-3:]
sys.path[:0] = [addon, os.path.dirname(os.path.abspath(__file__))]
import throng  # noqa: E402
from pose_names import Names  # noqa: E402
from throng.crowd.queries import crowd_objects  # noqa: E402
from throng.tools.levels import default_distances  # noqa: E402

bpy.ops.wm.read_factory_settings(use_empty=True)
throng.register()
bpy.ops.import_scene.throng(filepath=os.path.join(bake, "bake.json"), scenery=False, walls=False, roads=False,
                            relative=False)
scene = bpy.context.scene
crowd = crowd_objects(scene)[0]
camera = scene.camera


def people():
    graph, names = bpy.context.evaluated_depsgraph_get(), Names()
    return {i.persistent_id[1]: names.of(i.object.data) for i in graph.object_instances
            if i.is_instance and i.parent and i.parent.original.name == "Throng sample crowd"}


def sizes():
    return [sum(thing.name.startswith("Throng person") for thing in things)
            for things in (bpy.data.objects, bpy.data.meshes)]


scene.frame_set(20)
result = {"before": people(), "sizes": [sizes()], "lens": camera.data.lens,
          "lists": sum("throng_poses_of" in thing for thing in bpy.data.objects)}
scene.render.resolution_x, scene.render.resolution_y = 1920, 1080
result["defaults"] = default_distances(camera, scene)
camera.data.type = "ORTHO"
for options, key in (({"by": "camera"}, "ortho"), ({"by": "camera", "near": 30.0, "far": 20.0}, "order")):
    try:
        bpy.ops.throng.levels(**options)
        result[key] = "no error"
    except RuntimeError as error:
        result[key] = str(error)
    camera.data.type = "PERSP"
result["sizes"].append(sizes())

camera.location, camera.rotation_euler = (-16.0, -6.0, 3.0), (1.35, 0.0, -1.2)
camera.keyframe_insert("location", frame=20)
camera.location = (4.0, 9.0, 3.0)
camera.keyframe_insert("location", frame=30)
assert bpy.ops.throng.levels(by="camera", near=9.0, far=19.0) == {"FINISHED"}
assert bpy.ops.throng.levels(by="camera", near=9.5, far=18.5) == {"FINISHED"}  # again: nothing is there twice
result["sizes"].append(sizes())
result["shots"] = []
for frame, sub in ((20, 0.0), (25, 0.0), (30, 0.0), (24, 0.76), (25, 0.24)):
    scene.frame_set(frame, subframe=sub)
    result["shots"].append([frame, sub, list(camera.matrix_world.translation), people()])
bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, "levels.blend"))
scene.frame_set(20)
assert bpy.ops.throng.levels(by="none") == {"FINISHED"}
result["off"], result["after"] = people(), sizes()
result["trees"] = sorted(tree.name for tree in bpy.data.node_groups)
throng.unregister()
for name in [name for name in sys.modules if name.split(".")[0] == "throng"]:
    del sys.modules[name]
bpy.ops.wm.open_mainfile(filepath=os.path.join(folder, "levels.blend"))
bpy.context.scene.frame_set(25)
result["farm"] = people()
print("RESULT " + json.dumps(result))
