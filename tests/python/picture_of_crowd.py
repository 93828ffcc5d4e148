# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: whom a camera beside a road sees, as a bake that is imported or as USD. ADDON native|usd FILE
FRAME PICTURE"""
import math
import sys

import bpy

addon, kind, path, frame, picture = sys.argv[-5:]
sys.path.insert(0, addon)
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
camera.data.lens = 35.0
camera.location, camera.rotation_euler = (8.0, -11.0, 1.6), (math.radians(88.0), 0.0, 0.0)
scene.collection.objects.link(camera)
scene.camera = camera
if kind == "native":
    import throng

    throng.register()
    bpy.ops.import_scene.throng(filepath=path, walls=False, roads=False, scenery=False, camera=False)
    assert bpy.ops.throng.near(by="camera", reach=100, most=1000, whole=True) == {"FINISHED"}
else:
    bpy.ops.wm.usd_import(filepath=path, import_cameras=False, import_lights=False)
scene.camera = camera
scene.frame_set(int(frame))
scene.render.engine, scene.cycles.samples, scene.render.film_transparent = "CYCLES", 4, True
scene.render.use_motion_blur = False
scene.render.resolution_x, scene.render.resolution_y = 480, 270
scene.render.image_settings.file_format, scene.render.image_settings.color_mode = "PNG", "RGBA"
scene.render.filepath = picture
bpy.ops.render.render(write_still=True)
shown = bpy.data.images.load(picture)
alpha = list(shown.pixels)[3::4]
print("RESULT " + "".join("1" if each > 0.5 else "0" for each in alpha))
