# SPDX-License-Identifier: Apache-2.0
"""Runs a script as `blender -b [BLEND] -P SCRIPT -- ARGUMENTS` does, in the Python that has the module bpy.

run_in_bpy.py BLEND|"" SCRIPT ARGUMENTS...
"""
import runpy
import sys

import bpy

blend, script, *arguments = sys.argv[1:]
bpy.ops.wm.read_factory_settings()
if blend:
    bpy.ops.wm.open_mainfile(filepath=blend)
sys.argv = ["blender", "--", *arguments]
runpy.run_path(script, run_name="__main__")
