# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: a crowd seen from a crane, from the street and from afar, in every light, dry and wet."""
import json
import os
import sys
import tempfile

import bpy

addon, bake = sys.argv[-2:]
sys.path.insert(0, addon)
import throng  # noqa: E402
from bpy_extras.object_utils import world_to_camera_view  # noqa: E402
from mathutils import Vector  # noqa: E402
from throng.crowd.names import INSTANCERS  # noqa: E402

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
result["street by light"] = {}
for time in ("noon", "late"):
    assert bpy.ops.throng.light(time=time) == {"FINISHED"}
    assert bpy.ops.throng.shot(kind="street") == {"FINISHED"}
    looks = scene.camera.matrix_world.to_quaternion() @ Vector((0.0, 0.0, -1.0))
    result["street by light"][time] = {"place": list(scene.camera.location.xy), "looks": list(looks.xy)}
assert bpy.ops.throng.shot(kind="crane") == {"FINISHED"}
dressing = collection.children[f"{collection.name} dressing"]
tree = next(thing for thing in dressing.objects if thing.name.startswith("Throng lime tree"))
stood, result["tree hidden"] = tree.location.copy(), []
ahead = scene.camera.matrix_world.to_quaternion() @ Vector((0.0, 0.0, -1.0))
for place in (scene.camera.location + 6.0 * ahead, scene.camera.location - 6.0 * ahead, stood):
    tree.location = (place.x, place.y, 0.0)
    assert bpy.ops.throng.shot(kind="crane") == {"FINISHED"}
    result["tree hidden"].append([tree.hide_render, tree.hide_viewport])
for time in ("night", "noon", "overcast", "late", "night"):
    assert bpy.ops.throng.light(time=time) == {"FINISHED"}
    lights = [thing for thing in scene.objects if thing.type == "LIGHT"]
    heads = [thing for thing in scene.objects if thing.name.startswith("Throng lamp heads")]
    result["lights"].setdefault(time, []).append({
        "kinds": sorted(light.data.type for light in lights), "world": scene.world.name.split(".")[0],
        "lamps": [list(light.location.xy) for light in lights if light.data.type == "POINT"],
        "clamp": scene.cycles.sample_clamp_indirect, "heads_light": [head.visible_diffuse for head in heads]})
corners = [(corner.co.x, corner.co.y) for corner in scene.objects["Throng surroundings"].data.vertices]
result["reach"] = min(max(axis * corner[i] for corner in corners) for i in (0, 1) for axis in (-1.0, 1.0))
result["clip"] = scene.camera.data.clip_end

crowd = scene.objects[f"{collection.name} crowd"]
for name in INSTANCERS:
    crowd.modifiers.remove(crowd.modifiers[name])  # its people would be most of the work
scene.render.engine = "CYCLES"
scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 64, 36, 100
scene.render.image_settings.file_format = "PNG"
scene.cycles.samples, scene.cycles.use_denoising, scene.cycles.seed = 8, False, 1
scene.camera.data.dof.use_dof = False
scene.camera.data.lens = 20.0


def picture(place, aim):
    """Grey values, row by row from below, of what is seen from a place towards another."""
    scene.camera.constraints.clear()
    scene.camera.location = place
    scene.camera.rotation_euler = (Vector(aim) - Vector(place)).to_track_quat("-Z", "Y").to_euler()
    with tempfile.TemporaryDirectory() as folder:
        scene.render.filepath = os.path.join(folder, "picture.png")
        bpy.ops.render.render(write_still=True)
        image = bpy.data.images.load(scene.render.filepath)
        pixels = list(image.pixels)
        bpy.data.images.remove(image)
    return [sum(pixels[i:i + 3]) / 3.0 for i in range(0, len(pixels), 4)]


result["sky"], result["paving"] = {}, {}
for time in ("noon", "overcast", "late", "night"):
    assert bpy.ops.throng.light(time=time) == {"FINISHED"}
    result["sky"][time] = picture((0.0, 0.0, 60.0), (-60.0, 0.0, 90.0))
assert bpy.ops.throng.light(time="overcast") == {"FINISHED"}
for thing in dressing.objects:
    thing.hide_render = True  # what stands there may be what is seen
for amount in (0.0, 0.5, 1.0):
    assert bpy.ops.throng.rain(amount=amount) == {"FINISHED"}
    result["paving"][str(amount)] = picture((44.0, 5.0, 7.0), (44.0, 5.1, 0.0))
print("RESULT " + json.dumps(result))
