# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: two storeys and a stair that turns are drawn from nothing, baked, and played. ADDON FOLDER"""
import json
import os
import sys

import bpy

addon, folder = sys.argv[-2:]
sys.path[:0] = [addon, os.path.dirname(__file__)]
import throng  # noqa: E402
from asking import refusal  # noqa: E402
from throng.crowd.queries import terrain_of  # noqa: E402
from throng.crowd.verify import verify  # noqa: E402

bpy.ops.wm.read_factory_settings(use_empty=True)
throng.register()
ops, result, scene = bpy.ops.throng, {}, bpy.context.scene
data, thing = scene.throng_layout, lambda name: bpy.data.objects[name]


def cursor(x, y):
    scene.cursor.location = (x, y, 0.0)


def heights_of_drawing(name):
    graph = bpy.context.evaluated_depsgraph_get()
    mesh = thing(name).evaluated_get(graph).to_mesh()
    z = [(thing(name).matrix_world @ vertex.co).z for face in mesh.polygons for vertex in
         (mesh.vertices[i] for i in face.vertices)]
    return [min(z), max(z)]


def export(name):
    path = os.path.join(folder, name)
    assert bpy.ops.export_scene.throng_layout(filepath=path) == {"FINISHED"}
    return json.load(open(path, encoding="utf-8"))


result["too few"] = refusal(ops.add_link)
ops.add_level(length=24.0, depth=16.0)
cursor(0.0, 12.0)
ops.add_level(height=3.4, length=24.0, depth=8.0)
cursor(-3.0, 4.3)
ops.add_link(turn="HALF", width=1.6)
cursor(0.0, -4.0)
data.draw_on = thing("Level")
ops.add_formation(type="grid")
people = thing("Grid").throng_layout.formation
people.rows, people.columns, people.spacing = 4, 5, 1.2
cursor(6.0, 13.0)
data.draw_on = thing("Level.001")
ops.add_area(length=8.0, depth=4.0)
people.goal.place.target = thing("Area")
ops.add_wall(length=3.0)
thing("Wall").location.y -= 2.4
result["drawn at"] = [thing(name).location.z for name in ("Grid", "Area", "Wall", "Level.001")]
# The stair's path ends within the upper floor, so that it comes out there.
bpy.context.view_layer.update()
result["stairs"] = heights_of_drawing("Stairs")
stair = thing("Stairs")
stair.location.y += 2.7
data.simulation.duration, data.simulation.fps = 60.0, 24.0
bpy.context.view_layer.update()
result["layout"] = export("drawn.json")
bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, "shot.blend"))

result["check"] = refusal(ops.check)
stair.throng_layout.link.width = 0.2
result["narrow"] = [refusal(ops.bake), bpy.context.view_layer.objects.active.name]
stair.throng_layout.link.width = 1.6
thing("Level.001").location.z = 1.0
bpy.context.view_layer.update()
result["low"] = [refusal(ops.bake), sorted(each.target.name for each in data.problems if each.target)]
thing("Level.001").location.z = 3.4
bpy.context.view_layer.update()

assert ops.bake() == {"FINISHED"}, [each.message for each in data.problems]
crowd = data.crowd
result["people"] = len(crowd.data.vertices)
assert verify(crowd, scene) == []
ground = terrain_of(crowd)
result["ground"] = [round(float(ground.bound_box[corner][2]), 3) for corner in (0, 6)] if ground else None


def places(frame):
    scene.frame_set(frame)
    return [list(i.matrix_world.translation) for i in bpy.context.evaluated_depsgraph_get().object_instances
            if i.is_instance and i.parent and i.parent.original == crowd]


result["first"], result["last"] = places(scene.frame_start), places(scene.frame_end)
result["middle"] = [place[2] for frame in range(scene.frame_start, scene.frame_end, 48) for place in places(frame)]

# A level that is called otherwise takes everything along; seats, too, whose stand is drawn on it.
scene.throng_layout.draw_on = thing("Level.001")
ops.add_seats(length=6.0, rows=2)
stand = bpy.context.active_object
stand.throng_layout.seats.mouths.at = "back"
stand.throng_layout.seats.mouths.level = thing("Level")
thing("Level.001").name = "gallery"
result["renamed"] = export("renamed.json")
from throng.authoring import seat_drawing  # noqa: E402
graph = bpy.context.evaluated_depsgraph_get()
drawn = seat_drawing.stand_of(stand).data
result["stand"] = [round(value, 3) for value in (
    min((stand.matrix_world @ vertex.co).z for vertex in drawn.vertices), thing("gallery").location.z)]
assert bpy.ops.import_scene.throng_layout(filepath=os.path.join(folder, "renamed.json"), replace=True) == {"FINISHED"}
result["again"] = export("again.json") == result["renamed"]
result["heights"] = {each.name: round(each.location.z, 3) for each in scene.objects
                     if each.throng_layout.kind != "NONE"}
# What was on a level that is gone stays where it is, and nothing more is put on it.
scene.throng_layout.draw_on = gone = thing("gallery")
bpy.ops.object.select_all(action="DESELECT")
gone.select_set(True)
bpy.ops.object.delete()
ops.add_road(length=5.0)
result["after"] = scene.throng_layout.draw_on is None and "level" not in export("after.json")["roads"][-1]
print("RESULT " + json.dumps(result))
