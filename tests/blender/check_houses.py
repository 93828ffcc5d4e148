# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: houses of an example's set, and the same pane seen from two sides."""
import json
import math
import os
import sys
import tempfile

import bpy

addon, layout = sys.argv[-2:]
sys.path.insert(0, addon)
from throng.environment import build_environment, rooms, walls  # noqa: E402
from throng.environment.facades import Facade  # noqa: E402
from throng.environment.shapes import UV_ROOMS, Shape  # noqa: E402

bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
with open(layout, encoding="utf-8") as file:
    geometry = json.load(file)
solids = [wall for wall in geometry["walls"] if wall.get("closed")]


def described(thing):
    """What a house is like: its materials, its faces, how much of it is panes, and its heights."""
    mesh = thing.data
    names = [material.name for material in mesh.materials]
    panes = [face.area for face in mesh.polygons if names[face.material_index].startswith("throng rooms")]
    heights = [corner.co.z for corner in mesh.vertices]
    return {"materials": names, "faces": len(mesh.polygons), "panes": len(panes), "glass": sum(panes),
            "top": max(heights), "low": min(heights), "maps": [layer.name for layer in mesh.uv_layers]}


def rooms_behind(thing):
    """The numbers of the rooms that each pane says it is in, from its UV map: one for each corner."""
    mesh, found = thing.data, []
    places = mesh.uv_layers[UV_ROOMS].data
    for face in mesh.polygons:
        name = mesh.materials[face.material_index].name
        if name.startswith("throng rooms"):
            form = rooms.FORMS[name.rsplit(" ", 1)[1]]
            found.append(sorted({(math.floor(places[i].uv[0] / form.width), math.floor(places[i].uv[1] / form.height))
                                 for i in face.loop_indices}))
    return found


result = {"houses": {}, "again": {}, "rooms": {}}
for wall in solids:
    thing = walls.build_wall(wall)
    result["houses"][wall["id"]], result["rooms"][wall["id"]] = described(thing), rooms_behind(thing)
    result["again"][wall["id"]] = described(walls.build_wall(dict(wall, id="another name")))
result["beyond"] = len({walls.house_mesh(number).name for number in range(walls.HOUSES)})

# light sets the rooms of all houses by three numbers of one group
collection = bpy.data.collections.new("Set")
scene.collection.children.link(collection)
build_environment(bpy.context, {"fps": 24.0, "geometry": geometry}, collection, camera=False)
values = bpy.data.node_groups[rooms.ROOMS].nodes
result["lit late"] = [values[name].outputs[0].default_value for name in ("Daylight", "Lamps", "Lit")]

for thing in [*bpy.data.objects]:
    bpy.data.objects.remove(thing)
scene.world = None
rooms.light_rooms(1.0, 0.0, 0.0)
shape = Shape("pane")
Facade(shape, (0.0, 0.0), (10.8, 0.0), 0).pane((5.45, 10.75), (0.3, 4.2), 0.0, "shop", (1, 0), (5.4, 0.0))
scene.collection.objects.link(shape.to_object())
group = next(node for node in bpy.data.materials["throng rooms shop"].node_tree.nodes if node.type == "GROUP")
camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
scene.collection.objects.link(camera)
scene.camera, camera.data.type, camera.data.ortho_scale = camera, "ORTHO", 5.2
scene.render.engine = "CYCLES"
scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 104, 72, 100
scene.render.image_settings.file_format = "PNG"
scene.cycles.samples, scene.cycles.use_denoising, scene.cycles.seed = 4, False, 1
MIDDLE = (8.1, 0.0, 2.25)


def seen(turn):
    """Grey values at places of the pane, as seen from so many degrees to the right of the front."""
    angle = math.radians(turn)
    camera.location = (MIDDLE[0] + 9.0 * math.sin(angle), -9.0 * math.cos(angle), MIDDLE[2])
    camera.rotation_euler = (math.pi / 2, 0.0, angle)
    with tempfile.TemporaryDirectory() as folder:
        scene.render.filepath = os.path.join(folder, "picture.png")
        bpy.ops.render.render(write_still=True)
        image = bpy.data.images.load(scene.render.filepath)
        pixels, (width, height) = list(image.pixels), image.size
        bpy.data.images.remove(image)
    found = []
    for row in range(12, 60, 4):
        for x in range(-20, 21, 4):  # tenths of a metre from the middle
            column = int(0.5 * width + 0.1 * x * math.cos(angle) * width / 5.2)
            found.append(sum(pixels[4 * (row * width + column):][:3]) / 3.0)
    assert height == 72
    return found


result["deep"] = [seen(0.0), seen(40.0)]
group.inputs["Depth"].default_value = 0.002
result["flat"] = [seen(0.0), seen(40.0)]
print("RESULT " + json.dumps(result))
