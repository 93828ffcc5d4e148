# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: a crowd seen from a crane, from the street and from afar, by day and by night."""
import json
import os
import sys

import bpy

addon, bake = sys.argv[-2:]
sys.path.insert(0, addon)
import throng  # noqa: E402
from bpy_extras.object_utils import world_to_camera_view  # noqa: E402

bpy.ops.wm.read_factory_settings(use_empty=True)
throng.register()
assert bpy.ops.import_scene.throng(filepath=os.path.join(bake, "bake.json")) == {"FINISHED"}
scene = bpy.context.scene
scene.render.resolution_x, scene.render.resolution_y = 1920, 1080
collection = next(c for c in bpy.data.collections if "throng_bake" in c)
result = {"shots": {}, "lights": {}}
for kind in ("street", "wide", "crane"):
    assert bpy.ops.throng.shot(kind=kind) == {"FINISHED"}
    scene.frame_set(collection["throng_camera_frame"])
    graph = bpy.context.evaluated_depsgraph_get()
    camera = scene.camera
    places = [i.matrix_world.translation.copy() for i in graph.object_instances
              if i.is_instance and not i.object.name.startswith("Throng lamp")]
    views = [world_to_camera_view(scene, camera, place) for place in places]
    result["shots"][kind] = {"people": len(places),
                             "seen": sum(v.z > 0.0 and 0.0 <= v.x <= 1.0 and 0.0 <= v.y <= 1.0 for v in views),
                             "height": camera.location.z,
                             "nearest": min((camera.location.xy - place.xy).length for place in places),
                             "cameras": sum(thing.type == "CAMERA" for thing in scene.objects)}
for time in ("night", "day", "night"):
    assert bpy.ops.throng.light(time=time) == {"FINISHED"}
    lights = [thing for thing in scene.objects if thing.type == "LIGHT"]
    heads = [thing for thing in scene.objects if thing.name.startswith("Throng lamp heads")]
    result["lights"].setdefault(time, []).append({
        "kinds": sorted(light.data.type for light in lights), "world": scene.world.name.split(".")[0],
        "lamps": [list(light.location.xy) for light in lights if light.data.type == "POINT"],
        "clamp": scene.cycles.sample_clamp_indirect, "heads_light": [head.visible_diffuse for head in heads]})
print("RESULT " + json.dumps(result))
