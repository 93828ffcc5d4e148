# SPDX-License-Identifier: Apache-2.0
"""The add-on's preferences: where the program is."""
import bpy
from bpy.props import StringProperty

from .executable import ExecutableError, check_version, find_executable

_ADDON = __package__.rpartition(".")[0]  # as Blender knows it


class ThrongPreferences(bpy.types.AddonPreferences):
    bl_idname = _ADDON

    program: StringProperty(name="Program", subtype="FILE_PATH",
                            description="The program `throng`; by default the one on the PATH")

    def draw(self, _context):
        self.layout.prop(self, "program")
        try:
            path = find_executable(self.program)
            self.layout.label(text=f"{path}, version {check_version(path)}", icon="CHECKMARK")
        except ExecutableError as error:
            self.layout.label(text=str(error), icon="ERROR")


def program(context):
    """The program chosen in the preferences; empty when none was."""
    addon = context.preferences.addons.get(_ADDON)
    return addon.preferences.program if addon and addon.preferences else ""


def register():
    bpy.utils.register_class(ThrongPreferences)


def unregister():
    bpy.utils.unregister_class(ThrongPreferences)
