# SPDX-License-Identifier: Apache-2.0
"""People whose ways are given, in the sidebar."""
import bpy

from ..blender.panels import InSidebar
from .panel_parts import list_of, optional, people, problems_of


class THRONG_UL_given(bpy.types.UIList):
    def draw_item(self, context, layout, _data, item, _icon, _active, _property, index):
        problems = context.scene.throng_layout.problems
        wrong = any(each.where == "given" and each.index == index and each.is_error for each in problems)
        layout.prop(item, "name", text="", emboss=False, icon="ERROR" if wrong else "TRACKING")


class VIEW3D_PT_throng_given(InSidebar, bpy.types.Panel):
    bl_label = "Given People"
    bl_parent_id = "VIEW3D_PT_throng"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout, data = self.layout, context.scene.throng_layout
        given = list_of(layout, data, "given", "active_given", "THRONG_UL_given")
        if given is None:
            return
        problems_of(context, layout, lambda problem: problem.where == "given" and problem.index == data.active_given)
        layout.prop(given, "source")
        if given.source == "FILE":
            layout.prop(given, "file")
            optional(layout, given, "fps")
        layout.prop(given, "start")
        layout.prop(given, "offset")
        people(layout.box().column(), given.people)


CLASSES = (THRONG_UL_given, VIEW3D_PT_throng_given)

register, unregister = bpy.utils.register_classes_factory(CLASSES)
