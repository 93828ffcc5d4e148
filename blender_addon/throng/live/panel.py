# SPDX-License-Identifier: Apache-2.0
"""The live preview in the sidebar."""
import bpy

from ..blender.panels import InSidebar
from . import preview


class VIEW3D_PT_throng_live(InSidebar, bpy.types.Panel):
    bl_label = "Live Preview"
    bl_parent_id = "VIEW3D_PT_throng_bake"

    def draw(self, context):
        layout, shown = self.layout, preview.running()
        if shown is None:
            row = layout.row(align=True)
            row.operator("throng.live", icon="PLAY")
            row.operator("throng.live_bake", text="", icon="FILE_FOLDER")
            if context.scene.throng_live_message:
                layout.label(text=context.scene.throng_live_message, icon="ERROR")
            return
        row = layout.row(align=True)
        row.prop(context.scene, "throng_live_clock", expand=True)
        row.operator("throng.live_stop", text="", icon="X")
        layout.label(text=shown.status())


register, unregister = bpy.utils.register_classes_factory((VIEW3D_PT_throng_live,))
