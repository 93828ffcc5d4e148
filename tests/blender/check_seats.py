# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: imports a bake with seats and says which poses people are in, at all levels of detail."""
import json
import os
import sys

from types import SimpleNamespace

import bpy

addon, bake = sys.argv[-2:]
sys.path[:0] = [addon, os.path.dirname(os.path.abspath(__file__))]
import throng  # noqa: E402
from pose_names import Names  # noqa: E402
from throng.crowd.queries import crowd_objects, repertoire_of  # noqa: E402
from throng.overrides import hero  # noqa: E402

bpy.ops.wm.read_factory_settings(use_empty=True)
throng.register()
assert bpy.ops.import_scene.throng(filepath=os.path.join(bake, "bake.json"), scenery=False) == {"FINISHED"}
scene = bpy.context.scene
crowd = crowd_objects(scene)[0]


def people():
    names = Names()
    return {i.persistent_id[1]: names.of(i.object.data) for i in bpy.context.evaluated_depsgraph_get().object_instances
            if i.is_instance and i.parent and i.parent.original == crowd}


shots = []
for frame in (1, 9, 17, 25):
    scene.frame_set(frame)
    shots.append({"frame": frame, "level": 0, "people": people()})
assert bpy.ops.throng.levels(by="camera", near=1e-3, far=2e-3) == {"FINISHED"}
scene.frame_set(17)
shots.append({"frame": 17, "level": 2, "people": people()})
who = hero.shipped_person(crowd, 0)
hips = [hero._bones_at(who, SimpleNamespace(state=(activity, 0.0, phase), direction=(1.0, 0.0, 0.0)), 1, (1.0,),
                       (0, 0.0))["hips"].head[2]
        for activity, phase in ((5.0, 0.0), (8.0, 0.5), (9.0, 3.0), (2.0, 0.0))]
stands = {thing.name: {"faces": len(thing.data.polygons), "top": max(v.co.z for v in thing.data.vertices)}
          for thing in bpy.data.objects if thing.name.startswith("Throng stand")}
walls = [thing.name for thing in bpy.data.objects if thing.name.startswith("Throng wall")]
print("RESULT " + json.dumps({"shots": shots, "stands": stands, "walls": walls, "hips": hips,
                               "count": repertoire_of(crowd).count}))
