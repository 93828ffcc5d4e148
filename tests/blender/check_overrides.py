# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: people are hidden, swapped, tinted, scaled, moved, retimed and promoted; undone, saved, cleared,
and kept over a retake."""
import json
import math
import os
import shutil
import sys

import bpy

addon, folder = sys.argv[-2:]
sys.path[:0] = [addon, os.path.dirname(os.path.abspath(__file__))]
import throng  # noqa: E402
from asking import refused  # noqa: E402
from throng.cast import gait, people as cast_people  # noqa: E402
from pose_names import Names  # noqa: E402
from throng.crowd.queries import crowd_objects, figure  # noqa: E402
from throng.crowd.verify import verify  # noqa: E402
from throng.overrides import hero, layer, native, picking, skeleton  # noqa: E402

BAKE, FILE = os.path.join(folder, "street"), os.path.join(folder, "street.overrides.json")
FRAMES = (1, 30, 63, 100, 120)
bpy.ops.wm.read_factory_settings(use_empty=True)
throng.register()
bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, "scene.blend"))
load = lambda path: bpy.ops.import_scene.throng(filepath=os.path.join(path, "bake.json"), scenery=False, camera=False)
assert load(BAKE) == {"FINISHED"}
scene = bpy.context.scene
crowd = crowd_objects(scene)[0]
result = {"version": list(bpy.app.version), "modifiers": [m.name for m in crowd.modifiers]}
entries = lambda: json.load(open(FILE, encoding="utf-8"))["overrides"] if os.path.exists(FILE) else None


def people(of=None):
    """{row: [pose, x, y, z, heading, scale]} as the scene shows them now."""
    of = of or crowd
    graph, names = bpy.context.evaluated_depsgraph_get(), Names()
    return {i.persistent_id[1]: [names.of(i.object.data), *i.matrix_world.translation,
                                 math.atan2(i.matrix_world[1][0], i.matrix_world[0][0]), i.matrix_world.to_scale().x]
            for i in graph.object_instances if i.is_instance and i.parent and i.parent.original == of}


def shots(of=None):
    shown = {}
    for frame in FRAMES:
        scene.frame_set(frame)
        shown[frame] = people(of)
    return shown


result["before"] = shots()
tints = lambda of=None: [list(point.vector) for point in (of or crowd).data.attributes["tint"].data]
result["tints_before"] = tints()
ops = bpy.ops.throng
bpy.ops.ed.undo_push(message="imported")

# --- who is meant ----------------------------------------------------------------------------------------------------
scene.frame_set(100)
now, graph = people(), bpy.context.evaluated_depsgraph_get()
row = max(now, key=lambda r: now[r][1])  # the foremost: nobody is in front of it
x, y = now[row][1:3]
at = lambda origin, direction: picking.person_at_ray(crowd, graph, origin, direction)
result["ray"] = {"row": row, "ahead": at((x + 20.0, y, 1.2), (-1, 0, 0)), "above": at((x + 0.05, y, 9), (0, 0, -1)),
                 "beside": at((x + 1.2, y, 9), (0, 0, -1)), "nobody": at((x, y, 500.0), (0, 0, 1)),
                 "far": at((x + 60.0, y, 9), (0, 0, -1))}
picking.pick_at(bpy.context, (x, y, 9), (0, 0, -1))
other = next(r for r in now if r != row)
picking.pick_at(bpy.context, (now[other][1], now[other][2], 9), (0, 0, -1), extend=True)
result["picked"] = [sorted([row, other]), picking.picked(crowd)]
picking.pick(crowd, [])
result["nobody"] = refused(ops.hide_people)
result["stranger"] = refused(ops.hide_people, rows="999")
result["words"] = refused(ops.hide_people, rows="three")
assert entries() is None and len(crowd.throng_overrides) == 0
assert [m.name for m in crowd.modifiers] == result["modifiers"]
bpy.context.view_layer.objects.active = crowd
bpy.ops.object.mode_set(mode="OBJECT")
for vertex in crowd.data.vertices:
    vertex.select = vertex.index == 12
bpy.ops.object.mode_set(mode="EDIT")
assert ops.hide_people() == {"FINISHED"} and crowd.mode == "EDIT"
bpy.ops.object.mode_set(mode="OBJECT")
result["by_points"] = [entry["id"] for entry in entries()]
assert ops.clear_people(rows="12") == {"FINISHED"}
result["cleared"] = [entries(), [m.name for m in crowd.modifiers], shots() == result["before"],
                     tints() == result["tints_before"]]

# --- undo ------------------------------------------------------------------------------------------------------------
bpy.ops.ed.undo_push(message="before")
ops.hide_people(rows="4")
bpy.ops.ed.undo_push(message="hidden")
hidden = [len(entries()), 4 in people()]
bpy.ops.ed.undo()
crowd = crowd_objects(bpy.context.scene)[0]
scene = bpy.context.scene
result["undo"] = [hidden, [len(entries()), 4 in people(), len(crowd.throng_overrides)]]
bpy.ops.ed.redo()
crowd, scene = crowd_objects(bpy.context.scene)[0], bpy.context.scene
result["redo"] = [len(entries()), 4 in people(), len(crowd.throng_overrides)]
ops.clear_override(index=0)

# --- every kind of change, and the same as `throng apply` has it -----------------------------------------------------
ops.hide_people(rows="3")
ops.move_people(rows="6", by=(1.5, -2.0, 0.25), turn=math.radians(30.0))
ops.retime_people(rows="7", offset=-9.5, speed=1.3)
ops.move_people(rows="7", by=(0.0, 1.0, 0.0))
ops.swap_people(rows="9 7", character=5)
ops.tint_people(rows="9 7", by="draws", draws=(0.1, 0.2, 0.3))
ops.tint_people(rows="15", by="colour", colour=(0.627451, 0.062745, 0.12549))
ops.scale_people(rows="9 7", scale=1.2)
scene.frame_set(100)
scene.cursor.location = (-3.0, 4.0, 0.5)
ops.move_people(rows="11 13", to_cursor=True, turn=0.5)
result["at_cursor"] = people()[11][1:4]
result["after"], result["entries"], result["tints"] = shots(), entries(), tints()
dyed = crowd.data.attributes["throng_dyed"].data
result["dye"] = [list(crowd.data.attributes["throng_dye"].data[15].vector), dyed[15].value, dyed[14].value]
result["dyed_materials"] = sorted(m.name for m in bpy.data.materials
                                  if m.use_nodes and "Throng dye" in m.node_tree.nodes)
result["list"] = [[item.name, item.status] for item in crowd.throng_overrides]
result["verify"] = verify(crowd, scene)
retimed = native.retimed_object(crowd)
result["sidecar"] = [retimed.modifiers["throng retimed pos"].filepath, len(retimed.data.vertices)]
ops.show(percent=100.0, offset=5)
scene.frame_set(105)
late = people()
ops.show(percent=100.0, offset=0)
result["later"] = max(abs(a - b) for r in (6, 7) for a, b in zip(late[r][1:], result["after"][100][r][1:]))

# --- somebody else's file is never lost ------------------------------------------------------------------------------
content = open(FILE, encoding="utf-8").read()
theirs = json.loads(content)
theirs["overrides"] = theirs["overrides"][1:]
with open(FILE, "w", encoding="utf-8") as file:
    json.dump(theirs, file)
assert refused(ops.hide_people, rows="20") == "no error"
result["merged"] = [entry["id"] for entry in entries()] == [entry["id"] for entry in theirs["overrides"]] + [20]
result["theirs"] = 3 in people() and len(crowd.throng_overrides) == len(entries())
ops.clear_people(rows="20")
theirs = {"throng_overrides": 1, "overrides": entries()}
next(entry for entry in theirs["overrides"] if entry["id"] == 15)["tint"] = "#00ff00"
with open(FILE, "w", encoding="utf-8") as file:
    json.dump(theirs, file)
result["conflict"] = refused(ops.tint_people, rows="15", by="colour", colour=(0.0, 0.0, 1.0))
result["cleared by both"] = refused(ops.clear_people, rows="15")
assert entries() == theirs["overrides"]
ops.reload_overrides()
result["reloaded"] = [json.loads(item.text) for item in crowd.throng_overrides] == theirs["overrides"]
ops.tint_people(rows="15", by="colour", colour=(0.627451, 0.062745, 0.12549))
ops.hide_people(rows="3")

# --- heroes ----------------------------------------------------------------------------------------------------------
ops.promote_person(rows="10", hero="Anna")
crowd.name = "Somebody's crowd"
result["twice"] = refused(ops.promote_person, rows="11", hero="Anna")
ops.promote_person(rows="16")  # enters later

holder = figure(crowd, layer.variation_of(crowd, 18))
number = holder["throng_person"]
del holder["throng_person"]  # as if somebody had brought this member along
result["brought"] = refused(ops.promote_person, rows="18")
holder["throng_person"] = number
anna, late_hero = hero.heroes_of(crowd)["Anna"], hero.heroes_of(crowd)["Hero 16"]
body = next(thing for thing in bpy.data.objects if thing.parent == anna)
with layer.Rows(layer.bake_of(crowd)) as rows:
    bake = layer.bake_of(crowd)
    first = layer.Table(bake, rows).people[10].frame
    worst_root, errors = 0.0, []
    for frame in (first + 1, first + 9, 63, 64, 100, bake.frames):
        scene.frame_set(frame)
        sample = rows.whole(10, frame - 1)
        matrix = anna.matrix_world
        worst_root = max(worst_root, *(abs(a - b) for a, b in zip(matrix.translation, sample.position)),
                         abs(math.remainder(math.atan2(matrix[1][0], matrix[0][0])
                                            - math.atan2(sample.direction[1], sample.direction[0]), 2 * math.pi)))
        person = cast_people.CAST[int(sample.state[1]) % crowd["throng_cast"]["throng_variations"]]
        stride = gait.gait_of(bake.strides[round((sample.state[0] % 1.0) * 16)])
        pose = gait.walk_pose(sample.state[2] % 1.0, cast_people.build_of(person), stride)
        expected = skeleton.vertices_of(person, pose)
        mesh = body.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
        off = sorted(math.dist(vertex.co, place) for vertex, place in zip(mesh.vertices, expected))
        errors.append([sum(off) / len(off), off[int(0.99 * len(off))], off[-1], sample.direction[2],
                       len(expected) == len(mesh.vertices)])
materials = list(body.data.materials)
result["hero"] = {"root": worst_root, "errors": errors, "in_crowd": [10 in people(), 16 in people()],
                  "bones": len(anna.data.bones), "tint": list(body["tint"]),
                  "materials": all(materials) and len(materials) == len(cast_people.MATERIALS)}
late_body = next(thing for thing in bpy.data.objects if thing.parent == late_hero)
presence = {}
for frame in (1, 120):
    scene.frame_set(frame)
    presence[frame] = [late_body.hide_render, body.hide_render]
result["presence"] = presence

# --- saved and opened again ------------------------------------------------------------------------------------------
final = shots()
bpy.ops.wm.save_mainfile()
bpy.ops.wm.open_mainfile(filepath=os.path.join(folder, "scene.blend"))
scene = bpy.context.scene
crowd = crowd_objects(scene)[0]
result["reopened"] = [shots() == final, len(crowd.throng_overrides) == len(entries()), sorted(hero.heroes_of(crowd))]
result["final"] = final
shutil.copy(os.path.join(folder, "scene.blend"), os.path.join(folder, "farm.blend"))

# --- a retake in the bake's place, then one that lacks people --------------------------------------------------------
for take in ("take2", "take3"):
    shutil.rmtree(BAKE)
    shutil.copytree(os.path.join(folder, take), BAKE)
    assert ops.reload() == {"FINISHED"}
    scene.frame_set(100)
    items = crowd.throng_overrides
    result[take] = {"matches": [[json.loads(item.text)["id"], item.status, item.row] for item in items],
                    "details": [item.detail for item in items], "entries": entries(), "people": people(),
                    "heroes": sorted(hero.heroes_of(crowd)), "frame": 99, "verify": verify(crowd, scene)}

# --- an import finds the file, damage is told before anything changes ------------------------------------------------
shutil.rmtree(BAKE)
shutil.copytree(os.path.join(folder, "take1"), BAKE)
count = len(bpy.data.objects)
content = open(FILE, encoding="utf-8").read()
with open(FILE, "w", encoding="utf-8") as file:
    file.write(content.replace('"hide": true', '"hide": 3', 1))
result["damaged"] = [refused(load, path=BAKE), refused(ops.reload), len(bpy.data.objects) - count]
with open(FILE, "w", encoding="utf-8") as file:
    file.write(content)
bpy.ops.wm.read_factory_settings(use_empty=True)
assert load(BAKE) == {"FINISHED"}
scene = bpy.context.scene
crowd = crowd_objects(scene)[0]
result["imported"] = [shots() == {f: result["final"][f] for f in FRAMES}, sorted(hero.heroes_of(crowd))]
for name in ("Anna", "Hero 16"):
    index = next(i for i, item in enumerate(crowd.throng_overrides) if json.loads(item.text).get("hero") == name)
    assert bpy.ops.throng.clear_override(index=index) == {"FINISHED"}
result["demoted"] = [sorted(hero.heroes_of(crowd)), len(bpy.data.armatures), len(bpy.data.actions),
                     [r in people() for r in (10, 16)]]

content = open(FILE, encoding="utf-8").read()
with open(FILE, "w", encoding="utf-8") as file:
    file.write('{"throng_overrides": 1, "overrides": []}')
assert bpy.ops.throng.reload_overrides() == {"FINISHED"}
result["emptied"] = [len(crowd.throng_overrides), [m.name for m in crowd.modifiers], shots() == result["before"]]
picking.pick(crowd, [6, 7])
graph = bpy.context.evaluated_depsgraph_get()
result["rings"] = [len(picking._rings_of(crowd, 120, graph)),
                   picking._rings_of(crowd, 120, graph) is picking._rings_of(crowd, 120, graph)]
with open(FILE, "w", encoding="utf-8") as file:
    file.write(content)
assert bpy.ops.throng.reload_overrides() == {"FINISHED"}

# --- the command line's bake of the same overrides, beside the natively changed crowd --------------------------------
native_shots = shots()
native_tints = tints()
for thing in list(bpy.data.objects):
    bpy.data.objects.remove(thing)
assert load(os.path.join(folder, "applied")) == {"FINISHED"}
crowd = crowd_objects(bpy.context.scene)[0]
scene = bpy.context.scene
result["native"], result["applied"] = native_shots, shots()
result["applied_tints"] = max(abs(a - b) for one, two in zip(native_tints, tints()) for a, b in zip(one, two))
result["applied_dye"] = crowd.data.attributes["throng_dyed"].data[15].value
throng.unregister()
print("RESULT " + json.dumps(result))
