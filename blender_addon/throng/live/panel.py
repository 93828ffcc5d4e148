# SPDX-License-Identifier: Apache-2.0
"""The live preview's part of a panel."""
from . import preview


def draw(context, layout):
    shown = preview.running()
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
