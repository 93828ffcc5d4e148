# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: what operators say that are not available, without a crowd, with crowds that are linked,
instanced or of another folder, and in edit mode; and that linked crowds are verified."""
import json
import os
import sys

import bpy

addon, bake, folder = sys.argv[-3:]
sys.path.insert(0, addon)
import throng  # noqa: E402
from throng.crowd.queries import bake_path, collection_of, crowd_objects  # noqa: E402
from throng.crowd.verify import verify  # noqa: E402

LIBRARY = os.path.join(folder, "assets", "deep", "library.blend")
SHOT = os.path.join(folder, "shot.blend")
os.makedirs(os.path.dirname(LIBRARY))
bpy.ops.wm.read_factory_settings(use_empty=True)
throng.register()
bpy.ops.wm.save_as_mainfile(filepath=LIBRARY)


def operators():
    """The add-on's, by name."""
    return [f"throng.{name.partition('_OT_')[2]}" for name in dir(bpy.types) if name.startswith("THRONG_OT_")]


def said():
    """{operator: what Python is told} of all that are not available."""
    words = {}
    for name in operators():
        call = getattr(bpy.ops.throng, name.partition(".")[2])
        if call.poll():
            continue
        try:
            call()
        except RuntimeError as error:
            words[name] = str(error)
    return words


result = {"operators": len(operators()), "nothing": said()}
load = lambda: bpy.ops.import_scene.throng(filepath=os.path.join(bake, "bake.json"), scenery=False, camera=False,
                                           walls=False, roads=False)
load()
crowd = crowd_objects(bpy.context.scene)[0]
name = collection_of(crowd).name
assert crowd.modifiers["throng pos"].filepath.startswith("//")
bpy.ops.wm.save_mainfile()
result["one crowd"] = said()
bpy.context.view_layer.objects.active = crowd
bpy.ops.object.mode_set(mode="EDIT")
result["edit mode"] = said()
bpy.ops.object.mode_set(mode="OBJECT")
load()
bpy.context.view_layer.objects.active = None
result["two crowds"] = said()


def linked():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.save_as_mainfile(filepath=SHOT)
    with bpy.data.libraries.load(LIBRARY, link=True, relative=True) as (_, here):
        here.collections = [name]
    return here.collections[0]


def people():
    graph = bpy.context.evaluated_depsgraph_get()
    return sum(instance.is_instance for instance in graph.object_instances)


collection = linked()
bpy.context.scene.collection.children.link(collection)
bpy.ops.wm.save_mainfile()
bpy.ops.wm.open_mainfile(filepath=SHOT)
scene = bpy.context.scene
scene.frame_set(20)
scene.render.fps, scene.render.fps_base = 24, 1.0
crowd = crowd_objects(scene)[0]
result["linked"] = {"people": people(), "verify": verify(crowd, scene), "said": said(),
                    "bake": os.path.normpath(bake_path(crowd)) == os.path.join(bake, "bake.json"),
                    "finished": bpy.ops.throng.verify() == {"FINISHED"}}
try:
    bpy.ops.throng.remove_character(member=0)
except RuntimeError as error:
    result["linked"]["character"] = str(error)
# Beside one of one's own, that is the one that is meant; a linked one that is selected is not passed over.
load()
own = next(each for each in crowd_objects(scene) if not each.library)
for each in scene.objects:
    each.select_set(False)
assert bpy.ops.throng.show(percent=50.0) == {"FINISHED"}
result["own"] = [own["throng_percent"], crowd["throng_percent"], bpy.ops.throng.hide_people.poll()]
crowd.select_set(True)
result["selected"] = said().get("throng.show", "available")

collection = linked()
empty = bpy.data.objects.new("a crowd", None)
empty.instance_type, empty.instance_collection = "COLLECTION", collection
bpy.context.scene.collection.objects.link(empty)
result["instanced"] = said()["throng.hide_people"]
throng.unregister()
print("RESULT " + json.dumps(result))
