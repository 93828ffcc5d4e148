# SPDX-License-Identifier: Apache-2.0
"""Leaves out people whom nobody sees: outside a box, or outside what the camera sees, with a margin.

Natively, as playback is: a modifier before the instancer marks whoever is out, and no Python runs when frames change.
The margin keeps those whose shadows and reflections fall into the picture.
"""
import bpy
from mathutils import Vector

from ..blender.modifiers import move_modifier
from ..blender.nodes import Maths, get_input, new_tree, own_tree, set_input
from ..crowd.names import HIDDEN
from . import cutaway

MODIFIER = "throng cull"
_INPUTS = [("Geometry", "NodeSocketGeometry"), ("Object", "NodeSocketObject"), ("Margin", "NodeSocketFloat"),
           ("Wide", "NodeSocketFloat"), ("High", "NodeSocketFloat")]


def _local(maths, inputs):
    """Positions in the object's own frame, unscaled, and the object's scale."""
    info = maths.node("GeometryNodeObjectInfo", transform_space="RELATIVE")
    maths.link(inputs.outputs["Object"], info.inputs["Object"])
    away = maths.node("ShaderNodeVectorMath", operation="SUBTRACT")
    maths.link(maths.node("GeometryNodeInputPosition").outputs[0], away.inputs[0])
    maths.link(info.outputs["Location"], away.inputs[1])
    turned = maths.node("ShaderNodeVectorRotate", rotation_type="EULER_XYZ", invert=True)
    maths.link(away.outputs[0], turned.inputs["Vector"])
    maths.link(info.outputs["Rotation"], turned.inputs["Rotation"])
    parts = []
    for source in (turned.outputs[0], info.outputs["Scale"]):
        separate = maths.node("ShaderNodeSeparateXYZ")
        maths.link(source, separate.inputs[0])
        parts.append(separate.outputs)
    return parts


def _outside_box(maths, inputs):
    local, scale = _local(maths, inputs)
    out = None
    for axis in range(3):
        most = maths.math("ADD", maths.math("ABSOLUTE", scale[axis]), inputs.outputs["Margin"])
        beyond = maths.math("GREATER_THAN", maths.math("ABSOLUTE", local[axis]), most)
        out = beyond if out is None else maths.math("MAXIMUM", out, beyond)
    return out


def _outside_view(maths, inputs):
    """`Wide` and `High` are what the camera sees at a distance of one metre, to one side."""
    local, _ = _local(maths, inputs)
    ahead = maths.math("MULTIPLY", local[2], -1.0)
    out = maths.math("LESS_THAN", maths.math("ADD", ahead, inputs.outputs["Margin"]), 0.0)
    for axis, reach in ((0, "Wide"), (1, "High")):
        half = maths.math("MULTIPLY_ADD", maths.math("MAXIMUM", ahead, 0.0), inputs.outputs[reach],
                          inputs.outputs["Margin"])
        out = maths.math("MAXIMUM", out, maths.math("GREATER_THAN", maths.math("ABSOLUTE", local[axis]), half))
    return out


def _tree(mode):
    name = f"Throng cull by {mode}"
    found = own_tree(name)
    if found:
        return found
    tree, inputs, outputs = new_tree(name, _INPUTS, [("Geometry", "NodeSocketGeometry")])
    maths = Maths(tree)
    out = _outside_box(maths, inputs) if mode == "box" else _outside_view(maths, inputs)
    maths.link(maths.store(inputs.outputs["Geometry"], HIDDEN, out), outputs.inputs[0])
    return tree


def field_of_view(camera, scene):
    """Half of what a camera sees at one metre, across and up."""
    frame = camera.data.view_frame(scene=scene)
    return max(abs(corner.x / corner.z) for corner in frame), max(abs(corner.y / corner.z) for corner in frame)


def remove(crowd):
    modifier = crowd.modifiers.get(MODIFIER)
    if modifier:
        crowd.modifiers.remove(modifier)


def put_before_instancer(crowd, modifier):
    """Where a modifier has to be that says something about people."""
    move_modifier(crowd, modifier.name, crowd.modifiers.find("throng people"))


def apply(crowd, scene, mode, target, margin):
    """@param mode "box": `target` is a cube empty (its scale is half its size, m); "camera": it is a camera"""
    remove(crowd)
    modifier = crowd.modifiers.new(MODIFIER, "NODES")
    modifier.node_group = _tree(mode)
    set_input(modifier, "Object", target)
    set_input(modifier, "Margin", float(margin))
    if mode == "camera":
        wide, high = field_of_view(target, scene)
        set_input(modifier, "Wide", float(wide))
        set_input(modifier, "High", float(high))
    put_before_instancer(crowd, modifier)
    cutaway.put_last(crowd)
    crowd.update_tag()


def _places_of_all(crowd):
    """Where everybody is in this frame, whoever is culled or left out of the viewport now."""
    shown = crowd.modifiers["throng people (viewport)"]
    share, cull = get_input(shown, "Share"), crowd.modifiers.get(MODIFIER)
    looks = cull.show_viewport if cull else False
    try:
        set_input(shown, "Share", 2.0)
        if cull:
            cull.show_viewport = False
        crowd.update_tag()
        graph = bpy.context.evaluated_depsgraph_get()
        return [i.matrix_world.translation.copy() for i in graph.object_instances
                if i.is_instance and i.parent and i.parent.original == crowd]
    finally:
        set_input(shown, "Share", share)
        if cull:
            cull.show_viewport = looks
        crowd.update_tag()


def box(scene, crowd, name="Throng box"):
    """An empty cube round everybody, to be made smaller."""
    places = _places_of_all(crowd)
    made = bpy.data.objects.new(name, None)
    made.empty_display_type = "CUBE"
    if places:
        low, high = (Vector(bound(p[axis] for p in places) for axis in range(3)) for bound in (min, max))
        made.location = (low + high) / 2
        made.scale = [max(1.0, extent / 2) for extent in high - low]
    scene.collection.objects.link(made)
    return made

