# SPDX-License-Identifier: Apache-2.0
"""The order of an object's modifiers."""
import bpy


def move_modifier(thing, name, index):
    """Puts a modifier at a place of the stack."""
    modifiers = thing.modifiers
    if hasattr(modifiers, "move"):  # not in Blender 3.4
        modifiers.move(modifiers.find(name), index)
    else:
        with bpy.context.temp_override(object=thing, active_object=thing):
            bpy.ops.object.modifier_move_to_index(modifier=name, index=index)
