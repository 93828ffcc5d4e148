# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: each storey's cells on its own floor, seen by rays: what colour the image has where they hit."""
import importlib
import json
import os
import sys

import bpy
import numpy
from mathutils import Vector

addon, bake, folder = sys.argv[sys.argv.index("--") + 1:]
sys.path.insert(0, addon)
bpy.ops.wm.read_factory_settings(use_empty=True)
throng = importlib.import_module("throng")
throng.register()
storey_cells = importlib.import_module("throng.tools.storey_cells")
result = {}
assert bpy.ops.import_scene.throng(filepath=os.path.join(bake, "bake.json")) == {"FINISHED"}
names = {thing.name for thing in bpy.data.objects}
people = json.load(open(os.path.join(folder, "people.json")))
scene = bpy.context.scene


def overlay():
    return next((thing for thing in scene.objects if "throng_cells" in thing), None)


def hit_below(thing, place):
    """Where a ray down from a person's knees meets the cells: the corners' places in the image, weighed."""
    mesh = thing.data
    begin = Vector((place[0], place[1], place[2] + 0.5))
    hit, at, _, face = thing.ray_cast(begin, Vector((0.0, 0.0, -1.0)), distance=1.2)
    if not hit:
        return None
    corners = list(mesh.polygons[face].vertices)
    a, b, c = (numpy.array(mesh.vertices[number].co[:2]) for number in corners)
    u, v = numpy.linalg.solve(numpy.stack([b - a, c - a], axis=1), numpy.array(at[:2]) - a)
    values = [numpy.array(mesh.attributes[storey_cells.AT].data[number].vector[:2]) for number in corners]
    return [float(x) for x in values[0] + u * (values[1] - values[0]) + v * (values[2] - values[0])]


def picture(name):
    camera = bpy.data.objects.new("side", bpy.data.cameras.new("side"))
    camera.data.type, camera.data.ortho_scale = "ORTHO", 30.0
    camera.location = (12.0, 7.0, 40.0)
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 2, False
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 240, 160, 100
    settings = scene.render.image_settings
    if hasattr(settings, "media_type"):
        settings.media_type = "IMAGE"
    settings.file_format, settings.color_mode, settings.color_depth = "OPEN_EXR", "RGB", "32"
    scene.frame_set(25)
    scene.render.filepath = os.path.join(folder, name)
    bpy.ops.render.render(write_still=True)


only_floors = [thing for thing in scene.objects if thing.type in ("MESH", "LIGHT")
               and not thing.name.startswith("Throng terrain")]
for thing in only_floors:
    thing.hide_render = True
world = bpy.data.worlds.new("white")
world.use_nodes = True
next(node for node in world.node_tree.nodes if node.type == "BACKGROUND").inputs[0].default_value = (1, 1, 1, 1)
scene.world = world
picture("bare.exr")
assert bpy.ops.throng.cells(kind="overlay", strength=1.0) == {"FINISHED"}
cells = overlay()
result["hits"] = [hit_below(cells, place) for place in people]
ground = next(thing for thing in scene.objects if thing.name.startswith("Throng terrain"))
result["area"] = sum(face.area for face in cells.data.polygons)
result["longest"] = max((cells.data.vertices[a].co.xy - cells.data.vertices[b].co.xy).length
                        for a, b in (edge.vertices for edge in cells.data.edges))
picture("overlay.exr")
assert bpy.ops.throng.cells(kind="mask", strength=1.0) == {"FINISHED"}
picture("mask.exr")
assert bpy.ops.throng.cells(kind="none") == {"FINISHED"}
result["left"] = sorted({thing.name for thing in bpy.data.objects} - names - {"side"} -
                        {f"side.{number:03d}" for number in range(1, 9)})
result["nodes"] = [tree.name for tree in bpy.data.node_groups if tree.name.endswith(" cells")]
picture("none.exr")
bpy.data.objects.remove(ground)
try:
    bpy.ops.throng.cells(kind="overlay")
    result["without ground"] = "accepted"
except RuntimeError as error:
    result["without ground"] = str(error)
print("RESULT " + json.dumps(result))
