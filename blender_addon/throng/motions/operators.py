# SPDX-License-Identifier: Apache-2.0
import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, StringProperty
from bpy_extras.io_utils import ImportHelper

from ..blender.panels import Below
from ..characters import CharacterError, roles
from ..characters.operators import OfArmature, one_crowd
from ..crowd.queries import cast_of
from ..people.library import LibraryError
from . import adding, members, sources

_ROLES = [("AUTO", "Automatic", "By the clip's name, else by what it does"),
          (roles.WALK.upper(), "Walk", "To walk or to run with, by its stride"),
          (roles.IDLE.upper(), "Idle", "To stand with"), (roles.TALK.upper(), "Talk", "To talk with, in gatherings"),
          (roles.PHONE.upper(), "Phone", "To look at a phone with")]


class _AddsMotion:
    bl_options = {"REGISTER", "UNDO"}

    role: EnumProperty(name="For", items=_ROLES, default="AUTO")
    clip: StringProperty(name="Clip", description="Which one, where there are several; empty: by their names")
    members: StringProperty(name="Members", description="Numbers of those in the cast who shall move so: 0, 3-5; "
                                                        "empty: all who are shaped from bodies")
    every: BoolProperty(name="All Strides", default=False,
                        description="Take it for all strides that are walked, or run, as it is; else for those near "
                                    "its own")
    feet: StringProperty(name="Feet", description="The bones of both feet, by comma, where they are not found")
    height: FloatProperty(name="Height", default=0.0, min=0.0, max=3.0, unit="LENGTH",
                          description="Of who was recorded; 0: by the skeleton")

    def _options(self):
        feet = tuple(part.strip() for part in self.feet.split(",") if part.strip())
        role = "" if self.role == "AUTO" else self.role.lower()
        return adding.Options(role, self.clip, self.members, self.every, feet, self.height)

    def _add(self, context, crowd, source):
        window = context.window_manager
        window.progress_begin(0.0, 1.0)
        try:
            lines, warnings = adding.add(crowd, source, self._options(), window.progress_update)
        finally:
            window.progress_end()
        for line in lines:
            self.report({"INFO"}, line)
        for line in warnings:
            self.report({"WARNING"}, line)

    def execute(self, context):
        try:
            self._run(context, one_crowd(context))
        except (CharacterError, LibraryError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


class THRONG_OT_add_motion(_AddsMotion, bpy.types.Operator, ImportHelper):
    """Let members of the crowd's cast walk or stand as a clip does: a .bvh or glTF file of any humanoid skeleton"""

    bl_idname = "throng.add_motion"
    bl_label = "Add Motion"
    filename_ext = ".bvh"
    filter_glob: StringProperty(default="*.bvh;*.glb;*.gltf", options={"HIDDEN"})

    def _run(self, context, crowd):
        with sources.of_file(context, self.filepath) as source:
            self._add(context, crowd, source)


class THRONG_OT_add_armature_motion(_AddsMotion, OfArmature, bpy.types.Operator):
    """Let members of the crowd's cast walk or stand as the active armature does in its action. It stays as it is"""

    bl_idname = "throng.add_armature_motion"
    bl_label = "Add Motion of Active Armature"

    def _run(self, context, crowd):
        self._add(context, crowd, sources.of_armature(context, self.armature(context)))


class THRONG_OT_remove_motion(bpy.types.Operator):
    """Let members of the cast move as they did before a motion was brought"""

    bl_idname = "throng.remove_motion"
    bl_label = "Remove Motion"
    bl_options = {"REGISTER", "UNDO"}

    motion: StringProperty(name="Motion", description="Its name; empty: all of them")
    members: StringProperty(name="Members", description="Numbers of those who shall not move so any more: 0, 3-5; "
                                                        "empty: all")

    def execute(self, context):
        try:
            gone = members.remove(one_crowd(context), (self.motion,) if self.motion else (),
                                  adding.numbers_of(self.members))
        except (CharacterError, LibraryError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self.report({"INFO"}, f"Removed: {', '.join(gone)}")
        return {"FINISHED"}


class VIEW3D_PT_throng_motions(Below, bpy.types.Panel):
    bl_label = "Motions"

    def draw(self, context):
        layout = self.layout
        layout.operator(THRONG_OT_add_motion.bl_idname, icon="IMPORT")
        layout.operator(THRONG_OT_add_armature_motion.bl_idname, icon="ARMATURE_DATA")
        try:
            crowd = one_crowd(context)
        except CharacterError as error:
            layout.label(text=str(error))
            return
        for name, lines in members.said(cast_of(crowd)):
            row = layout.row()
            row.label(text=name, icon="ACTION")
            row.operator(THRONG_OT_remove_motion.bl_idname, text="", icon="X").motion = name
            for line in lines[2:3]:
                layout.label(text=line)


CLASSES = (THRONG_OT_add_motion, THRONG_OT_add_armature_motion, THRONG_OT_remove_motion, VIEW3D_PT_throng_motions)

register, unregister = bpy.utils.register_classes_factory(CLASSES)
