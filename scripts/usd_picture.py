# SPDX-License-Identifier: Apache-2.0
"""Renders a USD file as Blender imports it, with a sky and a sun of its own. Runs inside Blender:

    blender -b -P scripts/usd_picture.py -- FILE FRAME PICTURE X Y Z X Y Z

The first place is the camera's, the second what it looks at.
"""
import sys

import bpy
from mathutils import Vector

SKY, SUN, TURNED = (0.62, 0.74, 0.92, 1.0), 4.0, (0.12, 0.8, 0.0)


def lit(scene):
    world = bpy.data.worlds.new("sky")
    world.use_nodes = True
    kinds = {node.type: node for node in world.node_tree.nodes}
    sky = kinds.get("BACKGROUND") or world.node_tree.nodes.new("ShaderNodeBackground")
    output = kinds.get("OUTPUT_WORLD") or world.node_tree.nodes.new("ShaderNodeOutputWorld")
    world.node_tree.links.new(sky.outputs[0], output.inputs[0])
    sky.inputs[0].default_value = SKY
    scene.world = world
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    sun.data.energy, sun.rotation_euler = SUN, TURNED
    scene.collection.objects.link(sun)


def main(path, frame, picture, *places):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.usd_import(filepath=path, import_cameras=False, import_lights=False)
    scene = bpy.context.scene
    lit(scene)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    scene.collection.objects.link(camera)
    scene.camera, camera.data.lens = camera, 40.0
    where, at = (Vector(map(float, places[first:first + 3])) for first in (0, 3))
    camera.location, camera.rotation_euler = where, (at - where).to_track_quat("-Z", "Y").to_euler()
    scene.frame_set(int(frame))
    scene.render.engine, scene.cycles.samples, scene.cycles.max_bounces = "CYCLES", 8, 2
    scene.render.resolution_x, scene.render.resolution_y = 1280, 720
    scene.render.image_settings.file_format = "JPEG"
    scene.render.filepath = picture
    bpy.ops.render.render(write_still=True)


if __name__ == "__main__":
    main(*sys.argv[-9:])
