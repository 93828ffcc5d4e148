# SPDX-License-Identifier: Apache-2.0
"""Levels of detail: people far from a camera take coarser meshes.

Natively, as playback is: a modifier before the instancer files everybody's level away, by the distance between where
they stand and the camera, and no Python runs when frames change. A level is a function of these two places alone. While
the shutter is open it therefore changes only for those who cross one of the two distances in that time, by their own
way or the camera's (a few centimetres): these few render that frame at the level of its middle, without the blur of
their way; that of their limbs stays.
"""
import bpy
from bpy.props import EnumProperty, FloatProperty

from ..blender.nodes import Maths, drop_tree, new_tree, own_tree, set_input
from ..blender.panels import Below
from ..cast import library
from ..crowd import near
from ..crowd.names import LEVEL
from ..crowd.playback import cast_changed
from ..crowd.queries import cast_of, crowds_of, repertoire_of
from . import culling
from .by_camera import NO_CAMERA, ByCamera, Refused

MODIFIER = "throng levels"
TALL = 1.75           # m
PIXELS = (120.0, 40.0)  # who is less tall in the picture gets level 1, level 2
_TREE = "Throng levels by distance"
_INPUTS = [("Geometry", "NodeSocketGeometry"), ("Camera", "NodeSocketObject"), ("Near", "NodeSocketFloat"),
           ("Far", "NodeSocketFloat")]


def default_distances(camera, scene):
    """(near, far), m: from there on people are less than PIXELS tall in the scene's pictures."""
    _, high = culling.field_of_view(camera, scene)
    lines = scene.render.resolution_y * scene.render.resolution_percentage / 100.0
    return tuple(TALL * lines / (2.0 * high * pixels) for pixels in PIXELS)


def _tree():
    found = own_tree(_TREE)
    if found:
        return found
    tree, inputs, outputs = new_tree(_TREE, _INPUTS, [("Geometry", "NodeSocketGeometry")])
    maths = Maths(tree)
    camera = maths.node("GeometryNodeObjectInfo", transform_space="RELATIVE")
    maths.link(inputs.outputs["Camera"], camera.inputs["Object"])
    distance = maths.node("ShaderNodeVectorMath", operation="DISTANCE")
    maths.link(maths.node("GeometryNodeInputPosition").outputs[0], distance.inputs[0])
    maths.link(camera.outputs["Location"], distance.inputs[1])
    level = None
    for name in ("Near", "Far"):
        beyond = maths.math("GREATER_THAN", distance.outputs["Value"], inputs.outputs[name])
        level = beyond if level is None else maths.math("ADD", level, beyond)
    maths.link(maths.store(inputs.outputs["Geometry"], LEVEL, level), outputs.inputs[0])
    return tree


def remove(crowd):
    """Everybody at level 0; the coarser meshes go, so that files get smaller again."""
    modifier = crowd.modifiers.get(MODIFIER)
    if not modifier:
        return
    tree = modifier.node_group
    crowd.modifiers.remove(modifier)
    drop_tree(tree)
    cast = cast_of(crowd)
    if not any(name in other.modifiers for name in (MODIFIER, near.MODIFIER) for other in crowds_of(cast)):
        library.remove_levels(cast)
        cast_changed(crowd)


def apply(crowd, camera, near, far):
    """Level 1 from `near` metres from the camera on, level 2 from `far` on."""
    library.add_levels(cast_of(crowd), repertoire_of(crowd))
    cast_changed(crowd)
    modifier = crowd.modifiers.get(MODIFIER)
    if not modifier:
        modifier = crowd.modifiers.new(MODIFIER, "NODES")
        modifier.node_group = _tree()
        culling.put_before_instancer(crowd, modifier)
    set_input(modifier, "Camera", camera)
    set_input(modifier, "Near", float(near))
    set_input(modifier, "Far", float(far))
    crowd.update_tag()


class THRONG_OT_levels(ByCamera, bpy.types.Operator):
    """Give people far from the camera coarser meshes: the selected crowds', or all"""

    bl_idname = "throng.levels"
    bl_label = "Levels of Detail"
    bl_options = {"REGISTER", "UNDO"}

    by: EnumProperty(name="By", items=[("camera", "Camera", "By the distance to the scene's camera"),
                                       ("none", "Nothing", "Everybody in full detail")])
    near: FloatProperty(name="Near", min=0.0, subtype="DISTANCE",
                        description="A third of the triangles from here on. 0: where people are 120 pixels tall")
    far: FloatProperty(name="Far", min=0.0, subtype="DISTANCE",
                       description="A tenth of the triangles from here on. 0: where people are 40 pixels tall")

    take_back = staticmethod(remove)

    def change(self, context, crowds):
        camera = context.scene.camera
        if camera.type != "CAMERA":
            raise Refused(NO_CAMERA)
        if camera.data.type != "PERSP":
            raise Refused(f"{camera.name} is not a perspective camera: how far somebody is says little about how large "
                          "they are in its picture")
        defaults = default_distances(camera, context.scene)
        near, far = (given or default for given, default in zip((self.near, self.far), defaults))
        if far < near:
            raise Refused(f"Far ({far:g} m) is nearer than Near ({near:g} m)")
        for crowd in crowds:
            apply(crowd, camera, near, far)
        return f"Coarser from {near:.1f} m and {far:.1f} m on"


class VIEW3D_PT_throng_levels(Below, bpy.types.Panel):
    bl_label = "Levels of Detail"

    def draw(self, _context):
        row = self.layout.row(align=True)
        row.operator(THRONG_OT_levels.bl_idname, text="By Camera").by = "camera"
        row.operator(THRONG_OT_levels.bl_idname, text="Off").by = "none"


CLASSES = (THRONG_OT_levels, VIEW3D_PT_throng_levels)

register, unregister = bpy.utils.register_classes_factory(CLASSES)
