# SPDX-License-Identifier: Apache-2.0
"""Buttons for the live preview."""
import os

import bpy
from bpy.props import EnumProperty, StringProperty
from bpy_extras.io_utils import ImportHelper

from ..authoring.bake_operator import program_path
from ..authoring.executable import ExecutableError
from ..authoring.geometry import AuthoringError
from ..authoring.operators import refused
from ..blender.polls import available, in_object_mode
from . import preview

_CLOCKS = [("LIVE", "By Itself", "From the beginning of each new crowd, at its own pace"),
           ("TIMELINE", "Timeline", "The scene's frame, as far as the crowd has come")]


class THRONG_OT_live(bpy.types.Operator):
    """Show the crowd of the layout in the viewport while it is being changed. Nothing is baked, and bakes stay as they
    are"""

    bl_idname = "throng.live"
    bl_label = "Live Preview"

    @classmethod
    def poll(cls, context):
        return in_object_mode(cls, context)

    def execute(self, context):
        try:
            preview.start(context, program_path(context))
        except (AuthoringError, ExecutableError) as error:
            return refused(self, error)
        return {"FINISHED"}


class THRONG_OT_live_bake(bpy.types.Operator, ImportHelper):
    """Show a bake in the viewport as far as it has come, and what is baked of it from here on"""

    bl_idname = "throng.live_bake"
    bl_label = "Watch a Bake"
    filename_ext = ".json"
    filter_glob: StringProperty(default="bake.json;under-way.json", options={"HIDDEN"})

    def execute(self, context):
        try:
            preview.start(context, program_path(context), os.path.dirname(self.filepath))
        except (AuthoringError, ExecutableError) as error:
            return refused(self, error)
        return {"FINISHED"}


class THRONG_OT_live_stop(bpy.types.Operator):
    """End the live preview"""

    bl_idname = "throng.live_stop"
    bl_label = "End Preview"

    @classmethod
    def poll(cls, _context):
        return available(cls, "" if preview.running() else "There is no live preview")

    def execute(self, context):
        preview.stop()
        preview.redraw(context)
        return {"FINISHED"}


CLASSES = (THRONG_OT_live, THRONG_OT_live_bake, THRONG_OT_live_stop)

_register_classes, _unregister_classes = bpy.utils.register_classes_factory(CLASSES)


def _import_menu(self, _context):
    self.layout.operator(THRONG_OT_live_bake.bl_idname, text="Throng bake under way (under-way.json)")


def register():
    _register_classes()
    bpy.types.Scene.throng_live_clock = EnumProperty(name="Clock", items=_CLOCKS, default="LIVE")
    bpy.types.Scene.throng_live_message = StringProperty(options={"SKIP_SAVE"})
    bpy.types.TOPBAR_MT_file_import.append(_import_menu)


def unregister():
    preview.stop()
    bpy.types.TOPBAR_MT_file_import.remove(_import_menu)
    del bpy.types.Scene.throng_live_clock
    del bpy.types.Scene.throng_live_message
    _unregister_classes()
