# SPDX-License-Identifier: Apache-2.0
"""People near the camera are bent into their pose (crowd/near.py): which, and how many."""
import bpy
from bpy.props import EnumProperty, FloatProperty, IntProperty

from ..blender.nodes import drop_tree, set_input
from ..blender.panels import Below
from ..cast import library
from ..crowd import near
from ..crowd.playback import cast_changed
from ..crowd.queries import ChangesCrowds, cast_of, changed_crowds, repertoire_of
from . import culling

REACH, MOST = 15.0, 150  # m, people


def apply(crowd, camera, reach=REACH, most=MOST):
    """At most so many people within `reach` metres before the camera are bent. False where the crowd's cast keeps no
    bones."""
    if not near.boned_members(cast_of(crowd)):
        return False
    library.add_levels(cast_of(crowd), repertoire_of(crowd))  # all others take those
    modifier = crowd.modifiers.get(near.MODIFIER)
    if not modifier:
        modifier = crowd.modifiers.new(near.MODIFIER, "NODES")
        modifier.node_group = near.selection_tree()
        culling.put_before_instancer(crowd, modifier)
        cast_changed(crowd)
    set_input(modifier, "Camera", camera)
    set_input(modifier, "Reach", float(reach))
    set_input(modifier, "Most", most)
    crowd.update_tag()
    return True


def remove(crowd):
    modifier = crowd.modifiers.get(near.MODIFIER)
    if modifier:
        tree = modifier.node_group
        crowd.modifiers.remove(modifier)
        drop_tree(tree)
        cast_changed(crowd)


CLASSES = ()
