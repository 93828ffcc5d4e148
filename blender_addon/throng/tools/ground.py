# SPDX-License-Identifier: Apache-2.0
"""Lets a crowd whose bake is flat stand on a mesh of the scene."""
import bpy
from bpy.props import PointerProperty, StringProperty

from ..blender.modifiers import move_modifier
from ..blender.nodes import set_input
from ..blender.panels import Below
from ..blender.polls import available
from ..crowd.footing import conform_tree
from ..crowd.names import CONFORM
from ..crowd.playback import set_cast
from ..crowd.queries import ChangesCrowds, cast_of, changed_crowds


def conform(crowd, ground):
    """Lets a crowd stand on a mesh of the scene, whatever its bake says about heights."""
    if CONFORM not in crowd.modifiers:
        crowd.modifiers.new(CONFORM, "NODES").node_group = conform_tree()
        move_modifier(crowd, CONFORM, crowd.modifiers.find("throng pos") + 1)
    set_input(crowd.modifiers[CONFORM], "Ground", ground)
    set_cast(crowd, cast_of(crowd))


def release(crowd):
    """Undoes conform(): the bake's own ground, or a flat one."""
    if CONFORM in crowd.modifiers:
        crowd.modifiers.remove(crowd.modifiers[CONFORM])
        set_cast(crowd, cast_of(crowd))


class THRONG_OT_conform(ChangesCrowds, bpy.types.Operator):
    bl_idname = "throng.conform"
    bl_label = "Conform to Ground"
    bl_description = ("Let the selected crowds, or all, stand on the mesh chosen above: heights and slopes come from "
                      "it in every frame, on farms too")
    bl_options = {"REGISTER", "UNDO"}

    ground: StringProperty(name="Ground",
                           description="The mesh object; by default the one chosen in the sidebar, or the active one")

    def _ground(self, context):
        if self.ground:
            return context.scene.objects.get(self.ground)
        chosen = getattr(context.scene, "throng_ground", None)
        active = context.view_layer.objects.active
        return chosen or (active if active and "throng pos" not in active.modifiers else None)

    def execute(self, context):
        ground = self._ground(context)
        crowds = changed_crowds(context)
        if not ground or ground.type not in {"MESH", "CURVE", "SURFACE"} or ground in crowds:
            self.report({"ERROR"}, f"There is no mesh `{self.ground}` to stand on" if self.ground
                                   else "Choose the mesh to stand on: in the sidebar, or make it active")
            return {"CANCELLED"}
        for crowd in crowds:
            conform(crowd, ground)
        self.report({"INFO"}, f"{len(crowds)} crowds stand on {ground.name}")
        return {"FINISHED"}


class THRONG_OT_release(ChangesCrowds, bpy.types.Operator):
    """Let the selected crowds, or all, stand where their bakes have them"""

    bl_idname = "throng.release"
    bl_label = "Back to the Bake's Ground"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return super().poll(context) and available(
            cls, "" if any(CONFORM in crowd.modifiers for crowd in changed_crowds(context))
            else "These crowds stand where their bakes have them: none has been conformed to a ground")

    def execute(self, context):
        for crowd in changed_crowds(context):
            release(crowd)
        return {"FINISHED"}


class VIEW3D_PT_throng_ground(Below, bpy.types.Panel):
    bl_label = "Ground"

    def draw(self, context):
        column = self.layout.column(align=True)
        column.prop(context.scene, "throng_ground", text="")
        column.operator(THRONG_OT_conform.bl_idname)
        column.operator(THRONG_OT_release.bl_idname)


CLASSES = (THRONG_OT_conform, THRONG_OT_release, VIEW3D_PT_throng_ground)

_register_classes, _unregister_classes = bpy.utils.register_classes_factory(CLASSES)


def register():
    _register_classes()
    bpy.types.Scene.throng_ground = PointerProperty(type=bpy.types.Object, name="Ground",
                                                    description="The mesh that crowds are to stand on",
                                                    poll=lambda _, thing: thing.type == "MESH"
                                                    and "throng pos" not in thing.modifiers)


def unregister():
    del bpy.types.Scene.throng_ground
    _unregister_classes()
