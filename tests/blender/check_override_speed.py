# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: how much processor time a change of frame takes for a crowd as it is and with overrides
of each kind, in turn."""
import json
import os
import sys
import time

import bpy

addon, bake = sys.argv[-2:]
sys.path.insert(0, addon)
import throng  # noqa: E402
from throng.crowd.queries import crowd_objects  # noqa: E402
from throng.overrides import layer, native  # noqa: E402
from throng.overrides.override_file import Change  # noqa: E402

bpy.ops.wm.read_factory_settings(use_empty=True)
throng.register()
bpy.ops.import_scene.throng(filepath=os.path.join(bake, "bake.json"), scenery=False, camera=False)
scene = bpy.context.scene
crowd = crowd_objects(scene)[0]
loaded = layer.bake_of(crowd)
KINDS = {"none": {}, "state": {5: Change(hide=True), 6: Change(character=1)}, "move": {7: Change(move=(1.0, 0.0, 0.0))},
         "turn": {9: Change(turn=20.0)}, "scale": {8: Change(scale=1.1)}}
KINDS["all"] = {**KINDS["state"], **KINDS["move"], **KINDS["turn"], **KINDS["scale"],
                **{row: Change(delay=3.0, speed=1.1, tint=(0.1, 0.2, 0.3)) for row in range(20, 40)}}
times = {kind: [] for kind in KINDS}
with layer.Rows(loaded) as rows:
    people = layer.Table(loaded, rows).people
    for _ in range(4):
        for kind, changes in KINDS.items():
            native.play(crowd, rows, people, changes, os.path.join(os.path.dirname(bake), "retimed"))
            for frame in (2, 4, 3, 5, 1, 4, 2, 5):
                start = time.process_time()
                scene.frame_set(frame)
                times[kind].append(time.process_time() - start)
ops_start = time.process_time()
assert bpy.ops.throng.hide_people(rows="100 200 300") == {"FINISHED"}
result = {kind: 1000.0 * min(values) for kind, values in times.items()}
print("RESULT " + json.dumps({**result, "operator": time.process_time() - ops_start}))
