# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: the film look's presets, and a tiny plate as multilayer EXR."""
import array
import json
import os
import sys

import bpy
from bpy_extras.object_utils import world_to_camera_view
from mathutils import Vector

addon, bake, folder = sys.argv[-3:]
sys.path.insert(0, addon)
import throng  # noqa: E402

bpy.ops.wm.read_factory_settings(use_empty=True)
throng.register()
assert bpy.ops.import_scene.throng(filepath=os.path.join(bake, "bake.json")) == {"FINISHED"}
scene = bpy.context.scene
scene.frame_end = 40
result = {"version": bpy.app.version}
for preset in ("preview", "plate", "final"):
    assert bpy.ops.throng.film_look(preset=preset) == {"FINISHED"}
    scene.frame_set(scene.frame_start)
    start = list(scene.camera.matrix_world.translation)
    scene.frame_set(scene.frame_end)
    end = list(scene.camera.matrix_world.translation)
    result[preset] = {"engine": scene.render.engine, "size": [scene.render.resolution_x, scene.render.resolution_y],
                      "samples": scene.cycles.samples, "format": scene.render.image_settings.file_format,
                      "blur": [scene.render.use_motion_blur, scene.render.motion_blur_shutter],
                      "transform": scene.view_settings.view_transform, "focus": scene.camera.data.dof.use_dof,
                      "start": start, "end": end, "denoising": scene.cycles.use_denoising}
assert bpy.ops.throng.film_look(preset="plate") == {"FINISHED"}
scene.render.resolution_x, scene.render.resolution_y = 240, 135
scene.cycles.samples, scene.cycles.use_denoising = 4, False
scene.camera.data.dof.use_dof = False
people = throng.formats.load_bake(os.path.join(bake, "bake.json"))
result["seen"] = {}


def hips(frame):
    """Where in the picture everybody's hips are, {row: (x, y)} in pixels from the upper left; of who is in front."""
    with open(people.stream_path("pos"), "rb") as file:
        file.seek(32 + (frame - 1) * people.agents * 12)
        places = array.array("f")
        places.fromfile(file, 3 * people.agents)
    views = [world_to_camera_view(scene, scene.camera, Vector((*places[3 * row:3 * row + 2], 0.95)))
             for row in range(people.agents)]
    return {row: [240.0 * v.x, 135.0 * (1.0 - v.y)] for row, v in enumerate(views) if v.z > 0.5}


for frame in (20, 21):
    scene.frame_set(frame)
    scene.render.filepath = os.path.join(folder, f"plate.{frame:04d}.exr")
    bpy.ops.render.render(write_still=True)
    result["seen"][frame] = hips(frame)
print("RESULT " + json.dumps(result))
