# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: a crowd of few gaits, with levels of detail and a changed look, plays a bake of more gaits,
and the first one again."""
import json
import os
import sys

import bpy

addon, few, many = sys.argv[-3:]
sys.path[:0] = [addon, os.path.dirname(os.path.abspath(__file__))]
import throng  # noqa: E402
from pose_names import Names  # noqa: E402
from throng.cast.sheets import points_of  # noqa: E402
from throng.crowd.queries import crowd_objects, figure  # noqa: E402

bpy.ops.wm.read_factory_settings(use_empty=True)
throng.register()
assert bpy.ops.import_scene.throng(filepath=os.path.join(few, "bake.json"), scenery=False) == {"FINISHED"}
scene = bpy.context.scene
crowd = crowd_objects(scene)[0]
assert bpy.ops.throng.levels(by="camera", near=1e5, far=1e6) == {"FINISHED"}
figure(crowd, 0).data.materials[0].diffuse_color = (0.25, 0.5, 0.75, 1.0)
copy = crowd.copy()  # shares the cast, and plays the first bake to the end
scene.collection.objects.link(copy)
copy.location.x = 500.0
shots = []
for bake in (None, many, few):
    copy.select_set(False)
    crowd.select_set(True)
    if bake:
        assert bpy.ops.throng.relink(filepath=os.path.join(bake, "bake.json")) == {"FINISHED"}
    scene.frame_set(10)
    names = Names()
    shots.append({
        "poses": sum(len(points_of(figure(crowd, number))) for number in range(8)),
        "coarse": sum(len(points_of(figure(crowd, number, 1))) for number in range(8)),
        "people": {i.persistent_id[1]: names.of(i.object.data)
                   for i in bpy.context.evaluated_depsgraph_get().object_instances
                   if i.is_instance and i.parent and i.parent.original == crowd},
        "copy": {i.persistent_id[1]: names.of(i.object.data)
                 for i in bpy.context.evaluated_depsgraph_get().object_instances
                 if i.is_instance and i.parent and i.parent.original == copy},
        "look": [(material.name, tuple(material.diffuse_color)) for material in figure(crowd, 0).data.materials]
        + [len(bpy.data.materials)]})
print("RESULT " + json.dumps({"shots": shots}))
