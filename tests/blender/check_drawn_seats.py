# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: the plans of blocks that are imported; one change after another to them; and an audience that is
drawn from nothing, mistaken, mended and baked. ADDON LAYOUT FOLDER OTHER_LAYOUTS..."""
import json
import math
import os
import sys

import bpy

addon, layout, folder, *others = sys.argv[sys.argv.index("--") + 1:]
sys.path[:0] = [addon, os.path.dirname(__file__)]
import throng  # noqa: E402
from asking import refusal  # noqa: E402
from throng.authoring import seat_drawing, seat_plan  # noqa: E402
from throng.crowd.queries import crowd_objects  # noqa: E402
from throng.crowd.verify import verify  # noqa: E402

bpy.ops.wm.read_factory_settings(use_empty=True)
throng.register()
ops, result = bpy.ops.throng, {}
named = lambda name: bpy.data.objects[name]
data = lambda: bpy.context.scene.throng_layout
seats = lambda name: named(name).throng_layout.seats


def load(path):
    assert bpy.ops.import_scene.throng_layout(filepath=path, replace=True) == {"FINISHED"}


def export(name):
    path = os.path.join(folder, f"{name}.json")
    assert bpy.ops.export_scene.throng_layout(filepath=path) == {"FINISHED"}
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def blocks():
    found = [thing for thing in bpy.context.scene.objects if thing.throng_layout.kind == "SEATS"]
    return sorted(found, key=lambda thing: thing.throng_layout.order)


def drawn(thing):
    """[x, y, z] of all corners that are seen of a block, in the world."""
    bpy.context.view_layer.update()
    evaluated = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    corners = [list(thing.matrix_world @ vertex.co) for vertex in mesh.vertices]
    evaluated.to_mesh_clear()
    return corners


def box(thing):
    return [[min(values), max(values)] for values in zip(*drawn(thing))]


def plans(path):
    """What is drawn of each block, as a bake would tell it, and how many seats the panel says."""
    load(path)
    bpy.context.view_layer.update()
    found = []
    for thing in blocks():
        scene = bpy.context.scene
        made, _ = seat_plan.plan_of(seat_drawing.block_of(scene, thing, seat_drawing.walked_in(scene)))
        found.append([made, seat_drawing.stand_of(thing)["throng_seats"], box(thing)])
    return found


result["plans"] = {os.path.basename(path): plans(path) for path in (layout, *others)}


# Changes.
def nothing():
    pass


def move():
    named("south").location.x += 2.5


def move_a_point():
    named("south").data.splines[0].points[2].co.y += 1.0


def turn_arc():
    named("bow").rotation_euler.z = math.radians(30.0)


def scale_arc():
    named("bow").scale = (2.0, 2.0, 2.0)


def mirror_arc():
    named("bow").scale = (-1.0, 1.0, 1.0)


def rename():
    named("goal").name = "stalls"
    named("south").name = "stand"


def numbers():
    part = seats("ends")
    part.rows, part.pitch, part.width, part.rise, part.height = 4, 0.85, 0.45, 0.25, 1.5
    part.aisles, part.aisle_width, part.occupancy = 1, 0.9, 0.6


def mouths_to_the_front():
    seats("bow").mouths.at = "front"


def mouths_to_the_back():
    seats("south").mouths.at = "back"


def mouths_on_a_row():
    part = seats("goal").mouths
    part.at, part.row, part.level = "row", 2, named("pitch")


def nobody_leaves():
    seats("south").use_leave = False


def somebody_leaves():
    part = seats("goal")
    part.use_leave = True
    part.leave_to.place.target = named("gate")


def other_people():
    seats("south").people.profile = "child"


def into_an_arc():
    part = seats("one")
    part.shape, part.radius, part.ends = "ARC", 7.5, 45.0


def into_a_line():
    seats("whole").shape = "LINE"
    bpy.context.view_layer.update()
    curve = named("whole").data
    curve.splines.clear()
    curve.splines.new("POLY").points.add(1)
    curve.splines[0].points.foreach_set("co", [0.0, 0.0, 0.0, 1.0, 3.0, 0.0, 0.0, 1.0])


def look_there():
    point = bpy.data.objects.new("Point", None)
    point.throng_layout.kind = "POINT"
    point.location = (3.5, 70.0, 0.0)
    bpy.context.scene.collection.objects.link(point)
    seats("goal").facing = point


def clap_in_stead_of_a_wave():
    data().shows[1].do = "clap"


def add_a_show():
    assert ops.list(where="shows", action="ADD") == {"FINISHED"}
    show = data().shows[-1]
    show.do, show.time.a, show.share = "wave", 3.5, 0.75
    for name in ("bow", "goal"):
        named(name).select_set(True)
        bpy.context.view_layer.objects.active = named(name)
        assert ops.list(where="shows[4].who", action="ADD") == {"FINISHED"}


def go_to_other_seats():
    goal = data().flows[0].to
    goal.seats.add().target = named("ends")


def flee_from_others():
    data().behaviours[0].states["run"].followed.name = "more"


def rename_who_is_fled_from():
    data().flows["guests"].name = "crowd"


def near_others_by_name():
    """What is typed becomes the object of that name, which may get another one."""
    who = data().behaviours[0].states["see"].until[0].conditions[0].who
    who[0].target = None
    who[0].name = "class"
    assert who[0].target == named("class") and who[0].name == ""
    named("class").name = "pupils"


def delete():
    bpy.data.objects.remove(named("one"))


EDITS = (nothing, move, move_a_point, turn_arc, scale_arc, mirror_arc, rename, numbers, mouths_to_the_front,
         mouths_to_the_back, mouths_on_a_row, nobody_leaves, somebody_leaves, other_people, into_an_arc, into_a_line,
         look_there, clap_in_stead_of_a_wave, add_a_show, go_to_other_seats, flee_from_others, rename_who_is_fled_from,
         near_others_by_name, delete)
result["edits"] = {}
for edit in EDITS:
    load(layout)
    edit()
    result["edits"][edit.__name__] = export(edit.__name__)

# Whatever is changed is seen at once, where the object is.
load(layout)
seen = result["seen"] = {}
one = named("one")
seen["one"] = box(one)
one.location.x, one.rotation_euler.z = 50.0, math.pi / 2.0
seen["moved"] = box(one)
one.location.x, one.rotation_euler.z = 0.25, 0.0
seats("one").rows, seats("one").rise, seats("one").height = 3, 0.5, 2.0
seen["higher"] = box(one)
one.scale = (3.0, 1.0, 1.0)
seen["longer"] = [box(one), seat_drawing.stand_of(one)["throng_seats"]]
one.scale = (1.0, 1.0, 1.0)
bpy.context.view_layer.objects.active = one
bpy.ops.object.mode_set(mode="EDIT")
one.data.splines[0].points[1].co.x += 5.0
one.data.update_tag()
seen["in edit mode"] = box(one)
bpy.ops.object.mode_set(mode="OBJECT")
for each in bpy.context.selected_objects:
    each.select_set(False)
one.select_set(True)
bpy.context.view_layer.objects.active = one
assert bpy.ops.object.duplicate() == {"FINISHED"}
copy = bpy.context.view_layer.objects.active
seats(copy.name).rows = 1
seen["copied"] = [box(one)[2], box(copy)[2]]
named("bow").data.splines[0].points[0].co.x += 100.0  # an arc stays one
bpy.context.view_layer.update()
bpy.context.view_layer.update()
reach = max(math.hypot(*point.co[:2]) for point in named("bow").data.splines[0].points)
seen["arc"] = reach
named("goal").throng_layout.kind = "ROAD"
seen["unmarked"] = seat_drawing.stand_of(named("goal")) is None
wild = {"rows": -3, "pitch": 0.0, "width": 0.0, "aisles": 1000, "aisle_width": -1.0, "rise": -2.0}
for name, value in wild.items():
    setattr(seats("one"), name, value)
    assert len(drawn(one)) < 10**6
for name in ("front", "back", "row"):
    seats("one").mouths.at, seats("one").mouths.row = name, 99
    drawn(one)

# From nothing.
bpy.ops.wm.read_factory_settings(use_empty=True)
throng.unregister()
throng.register()
bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, "shot.blend"))
assert ops.add_seats(length=12.0, rows=4, rise=0.3, aisles=1) == {"FINISHED"}
seats("Seats").pitch, seats("Seats").occupancy = 0.9, 0.5
bpy.context.scene.cursor.location = (0.0, 8.0, 0.0)
assert ops.add_seats(shape="ARC", radius=9.0, span=math.radians(60.0), angle=math.radians(90.0), rows=2, aisles=0,
                     rise=0.5) == {"FINISHED"}
bpy.context.scene.cursor.location = (0.0, 9.0, 0.0)
assert ops.add_area() == {"FINISHED"}
named("Area").select_set(True)
assert ops.add_flow(count=6) == {"FINISHED"}
flow = data().flows[0]
flow.source.target, flow.to.mode = named("Area"), "SEATS"
data().simulation.duration, data().simulation.fps = 2.0, 24.0
wrong = result["wrong"] = {}


def mistaken(name):
    said = refusal(ops.bake)
    problem = next(each for each in data().problems if each.is_error)
    wrong[name] = [said, problem.message, problem.hint, problem.pointer, problem.target.name if problem.target else ""]


mistaken("no seats chosen")
flow.to.seats.add().target = named("Seats")
part = seats("Seats")
for name, value, good in (("rows", 0, 4), ("pitch", 0.2, 0.9), ("width", 20.0, 0.5), ("aisles", 61, 1),
                          ("occupancy", 1.5, 0.5), ("height", 2000.0, 0.0)):
    setattr(part, name, value)
    mistaken(name)
    setattr(part, name, good)
part.mouths.at, part.mouths.row = "row", 9
mistaken("no such row")
part.mouths.row, part.height = 2, 5.0
mistaken("steep passage")
part.mouths.at, part.height = "front", 0.0
part.use_leave = True
mistaken("nowhere to go")
part.use_leave = False
arc = seats("Seats.001")
arc.ends = arc.begins
mistaken("no arc")
arc.ends = arc.begins + 60.0
named("Seats").data.splines[0].use_cyclic_u = True
mistaken("cyclic")
named("Seats").data.splines[0].use_cyclic_u = False
named("Seats").data.splines[0].points.add(1)
named("Seats").data.splines[0].points[2].co = (-6.0, 0.5, 0.0, 1.0)
named("Seats").data.update_tag()
mistaken("bends sharply")
result["told"] = [seat_drawing.stand_of(named("Seats"))["throng_problem"], len(drawn(named("Seats")))]
curve = named("Seats").data
curve.splines.clear()
curve.splines.new("POLY").points.add(1)
curve.splines[0].points.foreach_set("co", [-6.0, 0.0, 0.0, 1.0, 6.0, 0.0, 0.0, 1.0])
assert ops.list(where="shows", action="ADD") == {"FINISHED"}
data().shows[0].do, data().shows[0].time.a = "cheer", 0.5
result["drawn"] = export("drawn")
seen["before"] = [box(named(name)) for name in ("Seats", "Seats.001")]
assert ops.check() == {"FINISHED"}
assert ops.bake() == {"FINISHED"}
crowd = data().crowd
stands = {thing.name: [[min(values), max(values)] for values in zip(*[thing.matrix_world @ vertex.co
                                                                      for vertex in thing.data.vertices])]
          for thing in data().built.objects if thing.name.startswith("Throng stand")}
result["bake"] = {"people": len(crowd.data.vertices), "crowds": len(crowd_objects(bpy.context.scene)),
                  "verify": verify(crowd, bpy.context.scene), "stands": stands,
                  "walls": [thing.name for thing in data().built.objects if "wall" in thing.name]}
bpy.ops.ed.undo_push(message="before")
assert ops.add_seats() == {"FINISHED"}
bpy.ops.ed.undo_push(message="add_seats")
bpy.ops.ed.undo()
result["undone"] = len(blocks())
bpy.ops.wm.save_mainfile()
bpy.ops.wm.open_mainfile(filepath=os.path.join(folder, "shot.blend"))
result["again"] = export("again") == result["drawn"]
seen["again"] = [box(named(name)) for name in ("Seats", "Seats.001")]
seats("Seats").rows = 5
seen["grown"] = box(named("Seats"))
stand = seat_drawing.stand_of(named("Seats")).name
bpy.data.objects.remove(named("Seats"))
bpy.ops.wm.save_mainfile()
bpy.ops.wm.open_mainfile(filepath=os.path.join(folder, "shot.blend"))
result["gone"] = stand not in bpy.data.objects
throng.unregister()
assert seat_drawing.follow not in bpy.app.handlers.depsgraph_update_post
print("RESULT " + json.dumps(result))
