# SPDX-License-Identifier: Apache-2.0
import os

import bpy
from bpy.props import EnumProperty, FloatProperty, IntProperty, StringProperty
from bpy_extras.io_utils import ImportHelper

from ..blender.panels import Below
from ..blender.polls import in_object_mode
from ..crowd.queries import chosen_crowds, members_of, repertoire_of, why_fixed, why_no_crowd
from . import CharacterError, character, files, members
from .clips import HEADINGS, Options
from .roles import ROLES


def one_crowd(context):
    chosen = chosen_crowds(context)
    if len(chosen) != 1:
        raise CharacterError("Select one crowd: each has a cast of its own" if chosen
                             else why_no_crowd(context.scene))
    if why_fixed(chosen[0]):
        raise CharacterError(why_fixed(chosen[0]))
    return chosen[0]


def parse_clips(text, role):
    """"Walking_A, Jog: 1.9" as [(name, stride in m or 0)]."""
    found = []
    for part in (part.strip() for part in text.split(",") if part.strip()):
        name, _, stride = part.rpartition(":") if ":" in part else (part, "", "")
        try:
            metres = float(stride) if stride.strip() else 0.0
        except ValueError:
            name, metres = part, 0.0  # a name may hold a colon
        if metres < 0.0 or metres > 10.0:
            raise CharacterError(f"{role}: a stride of {metres:g} m: it should be between 0 "
                                 "(found automatically) and 10")
        found.append((name.strip(), metres))
    return found


class _AddsCharacter:
    bl_options = {"REGISTER", "UNDO"}

    character_name: StringProperty(name="Name", description="Of the character; by default the file's or the armature's")
    replace: IntProperty(name="Replace", default=-1, min=-1,
                         description="The number of the cast's member whom it replaces; -1: it joins them")
    height: FloatProperty(name="Height", default=0.0, min=0.0, max=100.0, unit="LENGTH",
                          description="0: as it is, or 1.75 m where that is not between 1.3 and 2.1 m")
    heading: EnumProperty(name="Looks Along", default="AUTO", items=[("AUTO", "Automatic", "Where its feet walk to")]
                                                              + [(axis, axis, "") for axis in HEADINGS])
    leave_out: StringProperty(name="Leave Out",
                              description="Meshes that shall not be there, by comma; * stands for anything")
    keep: StringProperty(name="Keep", description="Meshes that shall be there although hands hold them, by comma")
    feet: StringProperty(name="Feet", description="The bones of both feet, by comma, where they are not found")
    idle: StringProperty(name="Idle", description="Clips to stand with, by comma; empty: found by name, then by motion")
    walk: StringProperty(name="Walk",
                         description="Clips to walk with; a stride in metres can follow a "
                                     "colon: Stroll: 1.1, March: 1.6")
    run: StringProperty(name="Run", description="Clips to run with")
    talk: StringProperty(name="Talk", description="Clips to talk with")
    phone: StringProperty(name="Phone", description="Clips to look at a phone with")
    cheer: StringProperty(name="Cheer", description="Clips to cheer with")
    sit: StringProperty(name="Sit", description="Clips to sit with")
    look: StringProperty(name="Look", description="Clips to look at something with")

    def _options(self):
        roles = {role: parse_clips(getattr(self, role), role) for role in ROLES if getattr(self, role).strip()}
        return Options(roles=roles, leave_out=self.leave_out, keep=self.keep, height=self.height, heading=self.heading,
                       feet=tuple(part.strip() for part in self.feet.split(",") if part.strip()))

    def _add(self, crowd, armature, name):
        number = members.number_for(crowd, None if self.replace < 0 else self.replace)
        members.widen(crowd)
        made = character.make(armature, repertoire_of(crowd), name, self._options())
        try:
            files.pack_images([posed.mesh for posed in made.levels])
        except CharacterError:
            bpy.data.batch_remove([posed.mesh for posed in made.levels])
            raise
        members.put(crowd, made, number)
        for line in made.report.lines():
            self.report({"INFO"}, line)
        worst = max(gait["slide"] for gait in made.report.gaits)
        if worst > 0.02:
            self.report({"WARNING"}, f"{name}: feet slide by up to {100.0 * worst:.1f} cm a step")

    def execute(self, context):
        try:
            crowd = one_crowd(context)
            self._run(context, crowd)
        except CharacterError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


class THRONG_OT_add_character(_AddsCharacter, bpy.types.Operator, ImportHelper):
    """Make a rigged character from a glTF file a member of the crowd's cast"""

    bl_idname = "throng.add_character"
    bl_label = "Add Character"
    filename_ext = ".glb"
    filter_glob: StringProperty(default="*.glb;*.gltf", options={"HIDDEN"})

    def _run(self, context, crowd):
        with files.imported(context, self.filepath) as armature:
            self._add(crowd, armature, self.character_name or os.path.splitext(os.path.basename(self.filepath))[0])


class OfArmature:
    """What takes the active armature, and asks for its settings first."""

    @classmethod
    def poll(cls, context):
        return in_object_mode(cls, context)

    def invoke(self, context, _event):
        return context.window_manager.invoke_props_dialog(self, width=420)

    @staticmethod
    def armature(context):
        active = context.view_layer.objects.active
        if active is None or active.type != "ARMATURE":
            raise CharacterError("the active object is no armature: click the one that is meant last")
        return active


class THRONG_OT_add_armature(_AddsCharacter, OfArmature, bpy.types.Operator):
    """Make the active armature, with its meshes and actions, a member of the crowd's cast. It stays as it is"""

    bl_idname = "throng.add_armature"
    bl_label = "Add Active Armature"

    def _run(self, context, crowd):
        armature = self.armature(context)
        self._add(crowd, armature, self.character_name or armature.name)


class THRONG_OT_remove_character(bpy.types.Operator):
    """Take a character out of the cast. Whom it had replaced comes back"""

    bl_idname = "throng.remove_character"
    bl_label = "Remove Character"
    bl_options = {"REGISTER", "UNDO"}

    member: IntProperty(name="Member", min=0, description="Its number in the cast")

    def execute(self, context):
        try:
            members.remove(one_crowd(context), self.member)
        except CharacterError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


class VIEW3D_PT_throng_characters(Below, bpy.types.Panel):
    bl_label = "Characters"

    def draw(self, context):
        layout = self.layout
        layout.operator(THRONG_OT_add_character.bl_idname, icon="IMPORT")
        layout.operator(THRONG_OT_add_armature.bl_idname, icon="ARMATURE_DATA")
        try:
            crowd = one_crowd(context)
        except CharacterError as error:
            layout.label(text=str(error))
            return
        for number, (name, own) in enumerate(members_of(crowd)):
            row = layout.row()
            row.label(text=f"{number}  {name}", icon="ARMATURE_DATA" if own else "COMMUNITY")
            if own:
                row.operator(THRONG_OT_remove_character.bl_idname, text="", icon="X").member = number


CLASSES = (THRONG_OT_add_character, THRONG_OT_add_armature, THRONG_OT_remove_character, VIEW3D_PT_throng_characters)

register, unregister = bpy.utils.register_classes_factory(CLASSES)
