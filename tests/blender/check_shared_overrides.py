# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: one bake imported twice, changed in both crowds and by somebody else, undone, and opened from a
file that is older than the overrides."""
import json
import os
import sys

import bpy
import numpy

addon, folder = sys.argv[-2:]
sys.path[:0] = [addon]
import throng  # noqa: E402
from throng.crowd.queries import crowd_objects  # noqa: E402
from throng.overrides import layer  # noqa: E402

FILE = os.path.join(folder, "street.overrides.json")
bpy.ops.wm.read_factory_settings(use_empty=True)
throng.register()
ops, result = bpy.ops.throng, {}


def ids():
    with open(FILE, encoding="utf-8") as file:
        return sorted(entry["id"] for entry in json.load(file)["overrides"])


def shown(crowd):
    return sorted(entry["id"] for entry in layer.entries_of(crowd))


def somebody_else_hides(row):
    with open(FILE, encoding="utf-8") as file:
        document = json.load(file)
    entry = dict(next(entry for entry in document["overrides"] if entry["id"] == 1))
    with open(os.path.join(folder, "street", "agents.csv"), encoding="utf-8") as table:
        keys, *lines = [line.rstrip("\n").split(",") for line in table]
    frame = int(lines[row][keys.index("spawn_frame")])
    with open(os.path.join(folder, "street", "bake.json"), encoding="utf-8") as file:
        origin = json.load(file)["origin"]
    place = numpy.load(os.path.join(folder, "street", "streams", "pos.npy"), mmap_mode="r")[frame, row]
    entry["id"] = row
    entry["spawn"] = {"frame": frame, "position": [float(value) for value in place + origin]}
    document["overrides"].append(entry)
    with open(FILE, "w", encoding="utf-8") as file:
        json.dump(document, file)


def crowds():
    return crowd_objects(bpy.context.scene)


def activate(crowd):
    bpy.context.view_layer.objects.active = crowd


for _ in range(2):
    assert bpy.ops.import_scene.throng(filepath=os.path.join(folder, "street", "bake.json"), scenery=False,
                                       camera=False, walls=False, roads=False) == {"FINISHED"}
for row, crowd in zip("12", crowds()):
    activate(crowd)
    assert ops.hide_people(rows=row) == {"FINISHED"}
hidden = [[crowd.data.attributes["throng_hide"].data[row].value for row in (1, 2)] for crowd in crowds()]
result["two crowds"] = {"file": ids(), "shown": [shown(crowd) for crowd in crowds()],
                        "left out": [values == [1.0, 1.0] for values in hidden]}
bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, "older.blend"))

bpy.ops.ed.undo_push(message="before")
somebody_else_hides(5)
activate(crowds()[0])
assert ops.hide_people(rows="3") == {"FINISHED"}
result["before undo"] = ids()
bpy.ops.ed.undo_push(message="hidden")
bpy.ops.ed.undo()
result["undone"] = ids()
bpy.ops.ed.redo()
result["redone"] = ids()

somebody_else_hides(7)
assert ops.reload_overrides() == {"FINISHED"}
assert shown(crowds()[1]) == ids()
bpy.ops.ed.undo_push(message="re-loaded")
bpy.ops.ed.undo()
result["undone reload"] = ids()
assert ops.hide_people(rows="8") == {"FINISHED"}
result["went on"] = ids()

bpy.ops.wm.open_mainfile(filepath=os.path.join(folder, "older.blend"))
bpy.ops.ed.undo_push(message="opened")
crowds()[0].location.x = 1.0
bpy.ops.ed.undo_push(message="moved")
bpy.ops.ed.undo()
result["opened"] = [shown(crowds()[0]), ids()]
activate(crowds()[0])
assert ops.hide_people(rows="4") == {"FINISHED"}
result["from there"] = ids()
assert all(shown(crowd) == ids() for crowd in crowds())
throng.unregister()
print("RESULT " + json.dumps(result))
