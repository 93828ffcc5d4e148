# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: a scene is drawn with the operators, checked, baked, broken, mended, baked again, cancelled,
undone, saved. ADDON FOLDER"""
import json
import os
import sys
import threading

import bpy

addon, folder = sys.argv[-2:]
sys.path[:0] = [addon, os.path.dirname(__file__)]
import throng  # noqa: E402
from asking import refusal  # noqa: E402
from throng.authoring import bake_operator  # noqa: E402
from throng.crowd.queries import crowd_objects  # noqa: E402
from throng.crowd.verify import verify  # noqa: E402

bpy.ops.wm.read_factory_settings(use_empty=True)
throng.register()
ops, result = bpy.ops.throng, {}
data = lambda: bpy.context.scene.throng_layout
thing = lambda name: bpy.data.objects[name]


def select(*names):
    for other in bpy.context.selected_objects:
        other.select_set(False)
    for name in names:
        thing(name).select_set(True)
        bpy.context.view_layer.objects.active = thing(name)


def export(name="out.json"):
    path = os.path.join(folder, name)
    assert bpy.ops.export_scene.throng_layout(filepath=path) == {"FINISHED"}
    with open(path, "rb") as file:
        return file.read()


def cursor(x, y):
    bpy.context.scene.cursor.location = (x, y, 0.0)


def box(name):
    graph = bpy.context.evaluated_depsgraph_get()
    mesh = thing(name).evaluated_get(graph).to_mesh()
    faces = [polygon for polygon in mesh.polygons if len(polygon.vertices) > 2]
    used = {i for polygon in faces for i in polygon.vertices}
    points = [mesh.vertices[i].co for i in used]
    return [max(values) - min(values) for values in zip(*points)]


# Drawing.
ops.add_road(length=40.0, width=8.0)
cursor(0.0, 10.0)
ops.add_road(length=40.0, width=6.0, one_way=True)
bow = thing("Road.001").data.splines[0]
curve = thing("Road.001").data
curve.splines.remove(bow)
bow = curve.splines.new("BEZIER")
bow.bezier_points.add(1)
for point, x, handle in zip(bow.bezier_points, (-20.0, 20.0), ((0.0, 40.0 / 3.0), (0.0, 40.0 / 3.0))):
    point.handle_left_type = point.handle_right_type = "FREE"
    point.co = (x, 0.0, 0.0)
    point.handle_left = point.handle_right = (x + handle[0], handle[1], 0.0)
cursor(0.0, -6.0)
ops.add_wall(length=10.0, thickness=0.4, height=2.5)
cursor(30.0, 30.0)
ops.add_wall(length=6.0, depth=4.0, height=9.0, closed=True)
cursor(-30.0, -4.0)
ops.add_area(length=6.0, depth=6.0)
cursor(-40.0, -30.0)
ops.add_formation(type="grid")
people = thing("Grid").throng_layout.formation
people.rows, people.columns, people.goal.place.target = 3, 4, thing("Area")
mesh = bpy.data.meshes.new("kiosk")  # an L of two boxes that lean on each other, subdivided where they meet
floor = [(0, 0), (4, 0), (4, 2), (2, 2), (2, 4), (0, 4)]
mesh.from_pydata([(x, y, z) for z in (0.0, 4.0) for x, y in floor], [],
                 [[5, 4, 3, 2, 1, 0], [6, 7, 8, 9, 10, 11]]
                 + [[i, (i + 1) % 6, 6 + (i + 1) % 6, 6 + i] for i in range(6)])
kiosk = bpy.data.objects.new("Kiosk", mesh)
kiosk.location = (-2.0, -14.0, 0.0)
bpy.context.scene.collection.objects.link(kiosk)
select("Kiosk")
ops.mark(kind="WALL")
select("Road")
ops.add_flow(count=20)
select("Area", "Road")
ops.add_flow(count=10)
data().flows[1].to.place.end = "start"
data().simulation.duration, data().simulation.fps = 2.0, 30.0
bpy.context.view_layer.update()
result["boxes"] = {"road": box("Road"), "wall": box("Wall"), "solid": box("Wall.001")}
result["layout"] = json.loads(export())
result["twice"] = export() == export("again.json")

# Baking.
result["unsaved"] = refusal(ops.bake)
bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, "shot.blend"))
assert ops.check() == {"FINISHED"}
assert ops.bake() == {"FINISHED"}
crowd = data().crowd
names = [each.name for each in data().built.objects]
result["first"] = {"people": len(crowd.data.vertices), "crowds": len(crowd_objects(bpy.context.scene)),
                   "bake": os.listdir(os.path.join(folder, "throng")), "streets": "Throng road Road" in names,
                   "kiosk": sum("Kiosk" in name for name in names)}
assert verify(crowd, bpy.context.scene) == []

# What is wrong is shown at what is wrong.
result["errors"], result["words"] = {}, {}


def wrong(name, shown):
    result["words"][name] = refusal(ops.bake)
    problem = next(each for each in data().problems if each.is_error)
    result["errors"][name] = [shown(), problem.pointer, problem.target.name if problem.target else ""]


active = lambda: bpy.context.view_layer.objects.active.name
thing("Road").throng_layout.width = 0.0
wrong("width", active)
thing("Road").throng_layout.width = 8.0
thing("Wall").throng_layout.height = -1.0
wrong("wall", active)
thing("Wall").throng_layout.height = 2.5
data().active_flow = 0
data().flows[1].to.place.target = None
wrong("flow", lambda: data().active_flow)
data().flows[1].to.place.target = thing("Road")
thing("Area").data.splines[0].type = "NURBS"
wrong("nurbs", active)
thing("Area").data.splines[0].type = "POLY"

# Again, with another road and more people.
data().flows[0].count = 25
thing("Road").throng_layout.width = 6.0
assert ops.bake() == {"FINISHED"}
assert not any(each.is_error for each in data().problems)
road = bpy.data.objects["Throng road Road"]
half = max(round(abs(vertex.co.y), 2) for vertex in road.data.vertices if abs(vertex.co.z) < 1e-3)
result["second"] = {"people": len(crowd.data.vertices), "crowds": len(crowd_objects(bpy.context.scene)),
                    "same": data().crowd == crowd, "width": half * 2.0}
thing("Road").throng_layout.width = 11.0
bpy.context.view_layer.update()
result["boxes"]["wider"] = box("Road")

# The program's own troubles.
addon_entry = bpy.context.preferences.addons.new()
addon_entry.module = "throng"
for name, path in (("program", os.path.join(folder, "absent")), ("other", "/bin/ls")):
    addon_entry.preferences.program = path
    result["words"][name] = refusal(ops.bake)
addon_entry.preferences.program = ""
manifest = os.path.join(folder, "throng", "shot", "bake.json")
before = open(manifest, "rb").read()
result["kept"] = [len(crowd.data.vertices), verify(crowd, bpy.context.scene) == []]

# Cancelled from another thread, as a button would.
data().simulation.duration = 3000.0


def press():
    job = bake_operator.running()
    if job and job.job.frame > 5:
        job.cancel()
    else:
        threading.Timer(0.05, press).start()


threading.Timer(0.2, press).start()
files = set(os.listdir(os.path.join(folder, "throng")))
assert ops.bake() == {"CANCELLED"}
left = sorted(set(os.listdir(os.path.join(folder, "throng"))) - files)
result["cancelled"] = ["cancelled" if bake_operator.running() is None else "running",
                       open(manifest, "rb").read() == before, len(crowd.data.vertices), left]
data().simulation.duration = 2.0

# Undo of what adds.
result["undone"] = {}
for name in ("add_road", "add_wall", "add_area", "add_formation", "add_flow"):
    bpy.ops.ed.undo_push(message="before")
    counts = lambda: (len(bpy.data.objects), len(bpy.context.scene.throng_layout.flows))
    start = counts()
    assert getattr(ops, name)() == {"FINISHED"}
    more = counts() != start
    bpy.ops.ed.undo_push(message=name)
    bpy.ops.ed.undo()
    result["undone"][name] = more and counts() == start

# Saved and opened again.
text = export()
bpy.ops.wm.save_mainfile()
bpy.ops.wm.open_mainfile(filepath=os.path.join(folder, "shot.blend"))
result["again"] = export() == text and data().crowd is not None

# A layout in UTM coordinates: the crowd comes to what was imported.
assert bpy.ops.import_scene.throng_layout(filepath=os.path.join(folder, "far.json"), replace=True) == {"FINISHED"}
assert data().crowd is None
assert ops.bake() == {"FINISHED"}
bpy.context.view_layer.update()
road, built = thing("far road"), next(each for each in data().built.objects if each.name.startswith("Throng road"))
xs = [(built.matrix_world @ v.co).x for v in built.data.vertices]
result["far"] = [road.location.x, 0.5 * (min(xs) + max(xs)), [round(value, 6) for value in json.loads(data().origin)],
                 len(crowd_objects(bpy.context.scene))]
bpy.context.scene.frame_set(bpy.context.scene.frame_end)
graph = bpy.context.evaluated_depsgraph_get()
where = [each.matrix_world.translation.copy() for each in graph.object_instances
         if each.is_instance and each.parent and each.parent.original == data().crowd]
result["far people"] = [len(where), max(abs(each.y) for each in where), min(each.x for each in where),
                        max(each.x for each in where)]
throng.unregister()
result["types"] = [name for name in dir(bpy.types) if "throng" in name.lower()]
assert not hasattr(bpy.types.Object, "throng_layout")
print("RESULT " + json.dumps(result))
