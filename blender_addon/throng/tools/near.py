# SPDX-License-Identifier: Apache-2.0
"""People near the camera are bent into their pose (crowd/near.py): which, and how many."""
import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty

from ..blender.nodes import drop_tree, set_input
from ..blender.panels import Below
from ..cast import library
from ..crowd import close, near
from ..crowd.playback import cast_changed
from ..crowd.queries import cast_of, crowds_of, repertoire_of
from . import culling, levels
from .by_camera import NO_BONES, ByCamera, Refused

REACH, MOST = 15.0, 150  # m, people


def apply(crowd, camera, reach=REACH, most=MOST, whole=False):
    """At most so many people within `reach` metres before the camera are bent. False where the crowd's cast keeps no
    bones. Raises LibraryError where the coarser meshes of all others cannot be made. @param whole whether all have the
    meshes of final pictures on the screen, too"""
    cast = cast_of(crowd)
    if not near.boned_members(cast):
        return False
    library.add_levels(cast, repertoire_of(crowd))
    modifier = crowd.modifiers.get(near.MODIFIER)
    if not modifier:
        modifier = crowd.modifiers.new(near.MODIFIER, "NODES")
        culling.put_before_instancer(crowd, modifier)
        cast_changed(crowd)
    before, modifier.node_group = modifier.node_group, near.selection_tree()  # files of old may have another
    drop_tree(before)
    set_input(modifier, "Camera", camera)
    set_input(modifier, "Reach", float(reach))
    set_input(modifier, "Most", most)
    set_input(modifier, "Whole", whole)
    crowd.update_tag()
    return True


def remove(crowd):
    """Everybody takes the poses that there are again."""
    modifier = crowd.modifiers.get(near.MODIFIER)
    if not modifier:
        return
    tree = modifier.node_group
    crowd.pop(close.MOST, None)
    crowd.modifiers.remove(modifier)
    drop_tree(tree)
    cast = cast_of(crowd)
    near.forget(cast, crowds_of(cast))  # before levels go, whose meshes it shows
    if not any(name in other.modifiers for name in (near.MODIFIER, levels.MODIFIER) for other in crowds_of(cast)):
        library.remove_levels(cast)
    cast_changed(crowd)


class THRONG_OT_near(ByCamera, bpy.types.Operator):
    """Bend people near the camera into the pose of the moment, instead of the next one that there is"""

    bl_idname = "throng.near"
    bl_label = "Near People"
    bl_options = {"REGISTER", "UNDO"}

    by: EnumProperty(name="By", items=[("camera", "Camera", "Those before the scene's camera"),
                                       ("none", "Nothing", "Nobody is bent")])
    reach: FloatProperty(name="Reach", default=REACH, min=1.0, max=200.0, subtype="DISTANCE",
                         description="How far from the camera people are bent")
    most: IntProperty(name="Most", default=MOST, min=1, max=5000,
                      description="At most so many are: where there are more, the reach shrinks. It takes time in "
                                  "every frame")
    whole: BoolProperty(name="Whole on Screen", default=False,
                        description="On the screen, too, all have the meshes of final pictures; else those beyond some "
                                    "metres have coarser ones there, which play faster")

    take_back = staticmethod(remove)

    def change(self, context, crowds):
        if not any([apply(crowd, context.scene.camera, self.reach, self.most, self.whole) for crowd in crowds]):
            raise Refused(NO_BONES)
        return f"At most {self.most} people within {self.reach:g} m are bent"


class VIEW3D_PT_throng_near(Below, bpy.types.Panel):
    bl_label = "Near People"

    def draw(self, _context):
        row = self.layout.row(align=True)
        row.operator(THRONG_OT_near.bl_idname, text="Bend").by = "camera"
        row.operator(THRONG_OT_near.bl_idname, text="Off").by = "none"


CLASSES = (THRONG_OT_near, VIEW3D_PT_throng_near)
register, unregister = bpy.utils.register_classes_factory(CLASSES)
