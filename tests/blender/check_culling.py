# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: who is left when a crowd is culled by a box and by a camera that moves."""
import json
import os
import sys

import bpy
from bpy_extras.object_utils import world_to_camera_view

addon, bake = sys.argv[-2:]
sys.path[:0] = [addon, os.path.dirname(os.path.abspath(__file__))]
import throng  # noqa: E402
from pose_names import Names  # noqa: E402
from throng.crowd.queries import crowd_objects  # noqa: E402

bpy.ops.wm.read_factory_settings(use_empty=True)
throng.register()
bpy.ops.import_scene.throng(filepath=os.path.join(bake, "bake.json"), scenery=False)
scene = bpy.context.scene
crowd = crowd_objects(scene)[0]
names = Names()


def people():
    graph = bpy.context.evaluated_depsgraph_get()
    return {i.persistent_id[1]: (names.of(i.object.data), *(round(v, 4) for v in i.matrix_world.translation))
            for i in graph.object_instances if i.is_instance and i.parent and i.parent.original == crowd}


scene.frame_set(20)
everybody = people()
result = {"all": len(everybody)}

box = bpy.data.objects.new("box", None)
scene.collection.objects.link(box)
box.location, box.rotation_euler, box.scale = (3.0, -2.0, 0.0), (0.0, 0.0, 0.5), (6.0, 4.0, 5.0)
bpy.context.view_layer.objects.active = box
bpy.ops.throng.cull(by="box", margin=1.0)
bpy.context.view_layer.update()
inverse = box.matrix_world.to_quaternion().inverted()
from mathutils import Vector  # noqa: E402


def in_box(place):
    local = inverse @ (Vector(place[1:]) - box.location)
    return abs(local.x) <= 7.0 and abs(local.y) <= 5.0


left = people()
result["box"] = [len(left), set(left) == {row for row, place in everybody.items() if in_box(place)},
                 all(everybody[row] == left[row] for row in left)]

camera = scene.camera
camera.location, camera.rotation_euler = (-16.0, -6.0, 3.0), (1.35, 0.0, -1.2)
camera.keyframe_insert("location", frame=20)
camera.location = (0.0, 9.0, 3.0)
camera.keyframe_insert("location", frame=30)
bpy.ops.throng.cull(by="camera", margin=0.0)
result["camera"] = []
for frame in (20, 25, 30):
    scene.frame_set(frame)
    bpy.ops.throng.cull(by="none")
    everybody = people()
    bpy.ops.throng.cull(by="camera", margin=0.0)
    scene.frame_set(frame)
    expected, borderline = set(), set()
    for row, place in everybody.items():
        view = world_to_camera_view(scene, camera, Vector(place[1:]))
        inside = [view.x, 1.0 - view.x, view.y, 1.0 - view.y, view.z]
        if min(inside) >= 0.0:
            expected.add(row)
        if abs(min(inside)) < 1e-3:
            borderline.add(row)
    left = set(people())
    result["camera"].append([len(left), len(everybody), sorted((left ^ expected) - borderline)])

# A new box is round everybody, whoever was culled or not shown before.
scene.frame_set(20)
bpy.ops.throng.cull(by="none")
everybody = people()
bpy.ops.throng.cull(by="camera", margin=0.0)
bpy.ops.throng.show(percent=30.0)
bpy.context.view_layer.objects.active = crowd
before = len(people())
bpy.ops.throng.cull(by="box", margin=0.1)
part = people()
bpy.ops.throng.show(percent=100.0)
result["new box"] = [before, len(everybody), len(part), len(people())]
bpy.ops.throng.cull(by="none")
result["again"] = len(people()) == len(everybody)
print("RESULT " + json.dumps(result))
