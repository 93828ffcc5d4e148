# SPDX-License-Identifier: Apache-2.0
"""Runs a script as `blender -b [BLEND] -P SCRIPT -- ARGUMENTS` does, in the Python that has the module bpy.

run_in_bpy.py BLEND|"" SCRIPT ARGUMENTS...
"""
import os
import runpy
import sys
import traceback

import bpy

blend, script, *arguments = sys.argv[1:]
bpy.ops.wm.read_factory_settings()
if blend:
    bpy.ops.wm.open_mainfile(filepath=blend)
sys.argv = ["blender", "--", *arguments]
try:
    runpy.run_path(script, run_name="__main__")
    status = 0
except SystemExit as ending:
    status = ending.code if isinstance(ending.code, int) else 0 if ending.code is None else 1
    if status and not isinstance(ending.code, int):
        print(ending.code, file=sys.stderr)
except BaseException:
    traceback.print_exc()
    status = 1
sys.stdout.flush()
sys.stderr.flush()
os._exit(status)  # the module of 4.5 never comes to an end of itself
