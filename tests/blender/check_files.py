# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: crowds that come from other files by link and append, copies that share a cast, an
artist's own use of a figure."""
import json
import os
import shutil
import sys

import bpy

addon, bake, folder = sys.argv[-3:]
sys.path[:0] = [addon, os.path.dirname(os.path.abspath(__file__))]
import throng  # noqa: E402
from pose_names import Names  # noqa: E402
from throng.crowd.queries import collection_of, crowd_objects, earlier_crowds, figure  # noqa: E402

LIBRARY = os.path.join(folder, "library.blend")
result = {}


def fresh():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    if not hasattr(bpy.types, "THRONG_OT_levels"):
        throng.register()


def imported():
    assert bpy.ops.import_scene.throng(filepath=os.path.join(bake, "bake.json"), scenery=False, walls=False,
                                       roads=False, relative=False) == {"FINISHED"}
    bpy.context.scene.frame_set(20)
    return crowd_objects(bpy.context.scene)[-1]


def shown(crowd=None):
    """How many people there are, each in a pose that is somebody's; of all crowds unless told."""
    names, graph = Names(), bpy.context.evaluated_depsgraph_get()
    return sum(bool(names.of(i.object.data)) for i in graph.object_instances
               if i.is_instance and i.object.data and (crowd is None or i.parent and i.parent.original == crowd))


fresh()
crowd = imported()
result["alone"] = shown()
name = collection_of(crowd).name
bpy.ops.wm.save_as_mainfile(filepath=LIBRARY)

# Appended by hand, the cast does not come into the picture.
fresh()
bpy.ops.wm.append(filepath=os.path.join(LIBRARY, "Collection", name), directory=os.path.join(LIBRARY, "Collection"),
                  filename=name)
bpy.context.scene.frame_set(20)
graph = bpy.context.evaluated_depsgraph_get()
result["appended"] = [shown(), sum(i.is_instance for i in graph.object_instances),
                      sum("throng_member" in i.object for i in graph.object_instances if not i.is_instance)]
bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, "appended.blend"))
bpy.ops.wm.open_mainfile(filepath=os.path.join(folder, "appended.blend"))
bpy.context.scene.frame_set(20)
result["appended"].append(shown())

# A crowd beside a linked one needs nothing of the library, which then goes away.
fresh()
with bpy.data.libraries.load(LIBRARY, link=True) as (there, here):
    here.collections = [name]
bpy.context.scene.collection.children.link(here.collections[0])
own = imported()
result["linked"] = [shown(), shown(own)]
bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, "beside.blend"))
shutil.move(LIBRARY, LIBRARY + ".away")
bpy.ops.wm.open_mainfile(filepath=os.path.join(folder, "beside.blend"))
bpy.context.scene.frame_set(20)
own = next(thing for thing in bpy.context.scene.objects if "throng pos" in thing.modifiers and not thing.library)
result["beside"] = shown(own)

# Copies share a cast: what one of them does not need any more, another may.
fresh()
crowd = imported()
other = crowd.copy()
bpy.context.scene.collection.objects.link(other)
far = {"by": "camera", "near": 1.0, "far": 2.0}

for step, (chosen, options) in enumerate((((crowd, other), far), ((crowd,), {"by": "none"}), ((crowd,), far),
                                          ((crowd, other), {"by": "none"}))):
    for thing in (crowd, other):
        thing.select_set(thing in chosen)
    assert bpy.ops.throng.levels(**options) == {"FINISHED"}
    result[f"copies {step}"] = [shown(crowd), shown(other),
                                len([thing for thing in bpy.data.objects if "throng_member" in thing])]
    if step == 0:  # somebody takes a coarse mesh for a thing of their own
        mine = bpy.data.objects.new("mine", figure(crowd, 1, 2).data)
        bpy.context.scene.collection.objects.link(mine)
result["mine"] = "mine" in bpy.data.objects and len(bpy.data.objects["mine"].data.vertices) > 0

# A crowd of an earlier version plays on; nothing works on it, and the panel says why.
del crowd["throng_cast"]["throng_levels"]
result["earlier"] = [shown(crowd), len(crowd_objects(bpy.context.scene)), len(earlier_crowds(bpy.context.scene)),
                     bpy.ops.throng.levels.poll()]
print("RESULT " + json.dumps(result))
