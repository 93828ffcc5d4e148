# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: what its exporters make of a crowd, as instances and realised, and what they are told to say."""
import json
import os
import sys

import addon_utils
import bpy

addon, bake, folder = sys.argv[-3:]
sys.path.insert(0, addon)
FRAME = 20


def fresh():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    for name in ("io_scene_gltf2", "throng"):
        addon_utils.enable(name, default_set=True)


def scene_with_crowd(realised):
    fresh()
    bpy.ops.import_scene.throng(filepath=os.path.join(bake, "bake.json"), scenery=False, walls=False, roads=False,
                                camera=False)
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = FRAME, FRAME + 1
    scene.frame_set(FRAME)
    if realised:
        assert bpy.ops.throng.realize() == {"FINISHED"}


def vertices_of(path, load):
    """How many vertices a file brings in, of all objects in a frame."""
    fresh()
    load(path)
    bpy.context.scene.frame_set(FRAME)
    graph = bpy.context.evaluated_depsgraph_get()
    return sum(len(thing.object.data.vertices) for thing in graph.object_instances if thing.object.type == "MESH")


def gltf_vertices(path):
    with open(path, encoding="utf-8") as file:
        document = json.load(file)
    nodes = [node for node in document.get("nodes", []) if "mesh" in node]
    return sum(document["accessors"][part["attributes"]["POSITION"]]["count"] for node in nodes
               for part in document["meshes"][node["mesh"]]["primitives"])


def exported(name, realised, save, count):
    path = os.path.join(folder, f"{realised}-{name}")
    print(f"EXPORT {realised} {name}", flush=True)
    scene_with_crowd(realised)
    save(path)
    print("END", flush=True)
    return count(path)


def there(operator):
    try:
        return set(operator.get_rna_type().properties.keys())
    except (KeyError, AttributeError):
        return set()


result = {"version": list(bpy.app.version)}
fresh()
ways = {}
if there(bpy.ops.wm.usd_export):
    ways["people.usdc"] = (lambda path: bpy.ops.wm.usd_export(filepath=path, export_animation=True),
                           lambda path: vertices_of(path, lambda path: bpy.ops.wm.usd_import(filepath=path)))
if there(bpy.ops.wm.alembic_export):
    ways["people.abc"] = (lambda path: bpy.ops.wm.alembic_export(filepath=path, as_background_job=False, start=FRAME,
                                                                 end=FRAME + 1),
                          lambda path: vertices_of(path, lambda path: bpy.ops.wm.alembic_import(
                              filepath=path, as_background_job=False)))
gltf = lambda **options: (lambda path: bpy.ops.export_scene.gltf(filepath=path, export_format="GLTF_SEPARATE",
                                                                 **options), gltf_vertices)
ways["plain.gltf"], ways["applied.gltf"] = gltf(), gltf(export_apply=True)
if "export_gn_mesh" in there(bpy.ops.export_scene.gltf):
    ways["instances.gltf"] = gltf(export_gn_mesh=True)
for name, (save, count) in ways.items():
    result[name] = [exported(name, realised, save, count) for realised in (False, True)]

# Where an exporter does not ask add-ons, its dialogue says it.
from types import SimpleNamespace  # noqa: E402
from throng.tools import export  # noqa: E402
scene_with_crowd(False)
dialogue = lambda name: export.FILEBROWSER_PT_throng_export.poll(SimpleNamespace(
    scene=bpy.context.scene, space_data=SimpleNamespace(active_operator=SimpleNamespace(bl_idname=name))))
names = ("WM_OT_usd_export", "WM_OT_alembic_export", "EXPORT_SCENE_OT_fbx", "EXPORT_SCENE_OT_gltf", "WM_OT_obj_export")
result["dialogues"] = [[name for name in names if dialogue(name)]]
result["hook"] = [export.usd_problem(bpy.context.scene)]
assert not hasattr(export, "ThrongUsdHook") or export.ThrongUsdHook.on_export(None)
bpy.ops.throng.realize()
result["hook"].append(export.usd_problem(bpy.context.scene))
result["dialogues"].append([name for name in names if dialogue(name)])
bpy.ops.throng.realize(realize=False)
graph = bpy.context.evaluated_depsgraph_get()
result["again"] = sum(instance.is_instance for instance in graph.object_instances)
result["dialogue registered"] = hasattr(bpy.types, "FILEBROWSER_PT_throng_export")
print("RESULT " + json.dumps(result))
