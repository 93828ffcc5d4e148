# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: imports layouts one after another and exports each. ADDON OUTPUT LAYOUT..."""
import json
import os
import sys
import time

import bpy

addon, output, *layouts = sys.argv[sys.argv.index("--") + 1:]
sys.path.insert(0, addon)
import throng  # noqa: E402

bpy.ops.wm.read_factory_settings(use_empty=True)
throng.register()
result = {}
for path in layouts:
    start = time.process_time()
    assert bpy.ops.import_scene.throng_layout(filepath=path, replace=True) == {"FINISHED"}
    middle = time.process_time()
    assert bpy.ops.export_scene.throng_layout(filepath=os.path.join(output, os.path.basename(path))) == {"FINISHED"}
    result[os.path.basename(path)] = [middle - start, time.process_time() - middle, len(bpy.data.objects)]
print("RESULT " + json.dumps(result))
