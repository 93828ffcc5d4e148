# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: one change after another, each to a layout that was just imported, and the layout that comes of
it. ADDON LAYOUT FOLDER"""
import json
import math
import os
import sys

import bmesh
import bpy

addon, layout, folder = sys.argv[-3:]
sys.path.insert(0, addon)
import throng  # noqa: E402

bpy.ops.wm.read_factory_settings(use_empty=True)
throng.register()
things = bpy.data.objects
data = lambda: bpy.context.scene.throng_layout


def flow(name):
    return data().flows[name]


def move_wall():
    things["house"].location.x += 2.5


def turn_wall():
    things["house"].rotation_euler.z = math.pi / 2


def move_one_point():
    things["house"].data.splines[0].points[1].co.x += 1.5


def insert_a_point():
    spline = things["a:b"].data.splines[0]
    points = [tuple(point.co) for point in spline.points]
    spline.points.add(1)
    middle = [0.5 * (a + b) for a, b in zip(points[0], points[1])]
    for point, co in zip(spline.points, points[:1] + [middle] + points[1:]):
        point.co = co


def change_patch():
    patch = things["lawn"].throng_layout.patch
    patch.use_cost, patch.pace, patch.room, patch.use_ends, patch.ends = False, 0.5, 1.25, True, 30.0


def move_patch():
    things["paint"].location.x += 2.0


def change_width():
    things["a:b"].throng_layout.width = 4.3


def add_flow():
    for thing in bpy.context.selected_objects:
        thing.select_set(False)
    for name in ("square", "hall"):
        things[name].select_set(True)
        bpy.context.view_layer.objects.active = things[name]
    assert bpy.ops.throng.add_flow(count=7) == {"FINISHED"}


def rename_area():
    things["hall"].name = "foyer"


def rename_flow():
    flow("via").name = "way"


def people():
    flow("via2").people.profile = "child"


def wheelchairs():
    flow("via2").people.body = "wheelchair"


def mean_speed():
    flow("same").people.speed.a = 0.3


def unset_speed():
    flow("same").people.speed.kind = "UNSET"


def stop_longer():
    flow("via").via[4].wait.a = 5.5


def move_the_queue():
    flow("via").via[4].line.location.y += 1.0


def amount():
    flow("via").amount = "COUNT"
    flow("via").count = 12


def reorder_stops():
    flow("via").via.move(0, 1)


def move_ring():
    things["ring"].location.x -= 1.0


def scale_ring():
    things["ring"].scale = (2.0, 2.0, 2.0)


def turn_block():
    things["block"].rotation_euler.z = math.radians(45.0)


def move_a_person():
    things["list"].data.vertices[2].co.x += 0.5


def remove_a_person():
    mesh = things["list"].data
    edit = bmesh.new()
    edit.from_mesh(mesh)
    edit.verts.ensure_lookup_table()
    bmesh.ops.delete(edit, geom=[edit.verts[0], edit.verts[1]], context="VERTS")
    edit.to_mesh(mesh)
    edit.free()


def change_event():
    data().events[0].time = 2.0
    data().events[1].kind = "open"


def change_seed():
    data().simulation.seed = 5


def change_motion():
    data().motion.headway.enabled = False
    data().motion.passing_side.enabled = False
    data().motion.planted_feet.slip = 1.25


def delete_wall():
    things.remove(things["house"])


def duplicate_wall():
    copy = things["house"].copy()
    copy.data = copy.data.copy()
    copy.location.x += 100.0
    bpy.context.scene.collection.objects.link(copy)


def close_wall():
    things["gate"].data.splines[0].points.add(1)
    things["gate"].data.splines[0].points[2].co = (5.0, 0.0, 0.0, 1.0)
    things["gate"].data.splines[0].use_cyclic_u = True


def change_bar():
    next(bar for bar in data().bars if bar.figure == "flow").most = 4.0


def change_given():
    hero = data().given["hero"]
    hero.start, hero.offset, hero.people.look = 2.5, (1.5, 0.75), "business"


def give_a_file():
    hero = data().given["hero"]
    hero.source, hero.use_fps, hero.fps = "FILE", True, 12.5
    hero.file = os.path.join(os.path.dirname(os.path.abspath(layout)), "seen", "by camera.csv")


def add_given():
    assert bpy.ops.throng.list(where="given", action="ADD") == {"FINISHED"}
    data().given[1].file = "/elsewhere/walked.csv"


def nothing():
    pass


EDITS = [each for each in dict(globals()).values()
         if callable(each) and getattr(each, "__module__", "") == "__main__"
         and each.__name__ not in ("flow", "<lambda>")]
result = {}
for edit in EDITS:
    assert bpy.ops.import_scene.throng_layout(filepath=layout, replace=True) == {"FINISHED"}
    edit()
    path = os.path.join(folder, edit.__name__ + ".json")
    assert bpy.ops.export_scene.throng_layout(filepath=path) == {"FINISHED"}
    with open(path, encoding="utf-8") as file:
        result[edit.__name__] = json.load(file)
print("RESULT " + json.dumps(result))
