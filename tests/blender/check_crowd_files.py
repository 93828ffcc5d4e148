# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: crowds as Alembic and USD, read back by Blender's importers into an empty scene."""
import json
import os
import sys

import addon_utils
import bpy
import numpy

sys.path.insert(0, os.path.dirname(__file__))
os.environ.pop("THRONG_BODIES", None)  # people who are made without a library come in a tenth of the time
from asking import refused  # noqa: E402

addon, bake, folder = sys.argv[-3:]
sys.path.insert(0, addon)
FIRST, LAST, FRAMES = 4, 32, (4, 9, 20, 27, 32)


def fresh():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    addon_utils.enable("throng", default_set=True)


def scene_with_crowd():
    fresh()
    bpy.ops.import_scene.throng(filepath=os.path.join(bake, "bake.json"), dressing=False, roads=False)
    bpy.context.scene.frame_set(7)
    bpy.ops.throng.cull(by="box")
    bpy.ops.throng.cull(by="none")


def holds():
    """All that a scene is, by name."""
    scene = bpy.context.scene
    kinds = ("objects", "meshes", "scenes", "node_groups", "collections", "materials", "cameras")
    return [{kind: sorted(each.name for each in getattr(bpy.data, kind)) for kind in kinds},
            {thing.name: [thing.select_get(), *(modifier.name for modifier in thing.modifiers)]
             for thing in scene.objects}, scene.name, scene.frame_current, scene.frame_start, scene.frame_end,
            sorted(os.listdir(folder))]


def read(path, load):
    """{frame: {object: what it has}} of a file."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    load(path)
    found = {}
    for frame in FRAMES:
        bpy.context.scene.frame_set(frame)
        graph = bpy.context.evaluated_depsgraph_get()
        found[frame] = {thing.name: mesh_of(thing.evaluated_get(graph)) for thing in bpy.data.objects
                        if thing.type == "MESH"}
    return found


def mesh_of(thing):
    mesh = thing.data
    places, velocities = numpy.empty(3 * len(mesh.vertices)), numpy.zeros(3 * len(mesh.vertices))
    mesh.vertices.foreach_get("co", places)
    places = places.reshape(-1, 3) @ numpy.array(thing.matrix_world.to_3x3()).T + thing.matrix_world.translation
    if "velocity" in mesh.attributes:
        mesh.attributes["velocity"].data.foreach_get("vector", velocities)
    maps = {}
    for each in mesh.uv_layers:
        values = numpy.empty(2 * len(mesh.loops), numpy.float32)
        each.data.foreach_get("uv", values)
        maps[each.name] = values.reshape(-1, 2)[::3].tolist()
    colours = {each.name: [tuple(entry.color) for entry in each.data][::3] for each in mesh.color_attributes}
    return {"places": numpy.round(places, 5).tolist(), "velocities": velocities.reshape(-1, 3).tolist(), "maps": maps,
            "colours": colours, "turns": [list(row)[:3] for row in thing.matrix_world][:3]}


class Layout:
    """What a dialog shows."""

    def __init__(self):
        self.lines, self.fields = [], []

    def prop(self, _owner, name):
        self.fields.append(name)

    def label(self, text, icon):
        self.lines.append(f"{icon}: {text}")


def dialogue(**changes):
    """What the dialog of an exporter says."""
    shown = type("Dialogue", (export_operators.ExportsCrowds,), {})()
    for name, value in {"frame_start": FIRST, "bodies": True, "points": True, "setting": False, "most": 1000,
                        "detail": "fine", "layout": Layout(), **changes}.items():
        setattr(shown, name, value)
    shown.draw(bpy.context)
    return [shown.layout.lines, shown.layout.fields]


fresh()
from throng.crowd.chosen import View  # noqa: E402
from throng.tools import export_files, export_operators  # noqa: E402
result = {"there": {operator.format_name: export_files.there(operator.exporter())
                    for operator in export_operators.CLASSES}}
view = View((0.0, -10.0, 1.0), ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, -1.0, 0.0)), (0.5, 0.3))  # along y
result["away"] = view.away(numpy.array([[0.0, 0, 0], [4.0, 0, 0], [0.0, -20, 0], [8.0, 0, 0], [0.0, 0, 9]])).tolist()
scene_with_crowd()
alembic, usd = bpy.ops.throng.export_alembic, bpy.ops.throng.export_usd
result["asked"] = {"Alembic": alembic.poll(), "USD": usd.poll()}
wanted = {"frame_start": FIRST, "frame_end": LAST, "most": 1000}
if result["there"]["Alembic"]:
    before = holds()
    path = os.path.join(folder, "people.abc")
    plan = export_files.Plan([thing for thing in bpy.context.scene.objects if "throng_cast" in thing], FIRST, LAST,
                             export_files.Wanted())
    result["told"] = list(plan.lines())
    result["dialogue"] = [dialogue(frame_end=LAST), dialogue(frame_end=FIRST - 1)]
    open(path, "w").close()
    result["refused"] = [refused(alembic, filepath=os.path.join(folder, "none", "people.abc"), **wanted),
                         refused(alembic, filepath=folder, **wanted),
                         refused(alembic, filepath=path, frame_start=9, frame_end=8),
                         refused(alembic, filepath=path, frame_start=9, frame_end=9, detail="far"),
                         refused(alembic, filepath=path, bodies=False, points=False)]

    def fails(path, _plan):
        with open(path, "w", encoding="utf-8") as file:
            file.write("half")
        raise RuntimeError("Error: the disk is full")

    written_by = export_operators.THRONG_OT_export_alembic
    save, written_by.save = written_by.save, staticmethod(fails)
    result["refused"].append(refused(alembic, filepath=path, **wanted))
    written_by.save = staticmethod(save)
    result["kept"] = os.path.getsize(path) == 0
    os.unlink(path)
    result["same after refusals"] = holds() == before
    assert alembic(filepath=path, **wanted) == {"FINISHED"}
    few = os.path.join(folder, "few.abc")
    assert alembic(filepath=few, frame_start=FIRST, frame_end=LAST, most=3, bodies=False, setting=True) == {"FINISHED"}
    after = holds()
    result["same"] = before[:-1] == after[:-1] and set(after[-1]) - set(before[-1]) == {"people.abc", "few.abc"}
    result["size"] = [plan.bytes, os.path.getsize(path)]
    result["alembic"] = read(path, lambda path: bpy.ops.wm.alembic_import(filepath=path, as_background_job=False))
    result["few"] = read(few, lambda path: bpy.ops.wm.alembic_import(filepath=path, as_background_job=False))
if result["there"]["USD"]:
    scene_with_crowd()
    before, path = holds(), os.path.join(folder, "people.usdc")
    assert usd(filepath=path, **wanted) == {"FINISHED"}
    result["same with USD"] = before[:-1] == holds()[:-1]
    result["usd"] = read(path, lambda path: bpy.ops.wm.usd_import(filepath=path))
with open(os.path.join(folder, "result.json"), "w", encoding="utf-8") as file:
    json.dump(result, file)
print("RESULT true")
