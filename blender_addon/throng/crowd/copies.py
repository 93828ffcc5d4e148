# SPDX-License-Identifier: Apache-2.0
"""Copies of a crowd that exporters know: everybody's body as one mesh, and everybody as a small arrow that says of them
what the streams do. A crowd is left as it is; whoever makes copies throws them away (drop)."""
import bpy

from ..blender.modifiers import move_modifier
from ..blender.nodes import Maths, drop_object, drop_tree, new_tree, socket
from ..blender.vectors import combined, place, scaled, vector
from . import near
from .chosen import mark
from .names import BIGGER, COARSE, HIDDEN, INSTANCERS, LEVEL, NEAR
from .playback import add_cache
from .queries import cast_of

# What an arrow's corners say, as maps of UV, which Alembic keeps as they are: the names of two numbers each.
ARROW_MAPS = ("person_member", "activity_phase", "heading_speed", "size_there")
ARROW = ((0.0, 0.0), (-0.3, 0.12), (-0.3, -0.12))  # m: its tip is where somebody is
_CHOSEN, _NEXT, _GOES = "throng chosen", "throng next", "throng_goes"
_GEOMETRY = [("Geometry", "NodeSocketGeometry")]


def bends(crowd):
    """Whether a crowd can show people who are bent into their pose."""
    return near.MODIFIER in crowd.modifiers and bool(near.boned_members(cast_of(crowd)))


class Copy:
    """An object beside a crowd, that plays the same streams."""

    def __init__(self, crowd, name):
        self.crowd, self.made, self.trees = crowd, crowd.copy(), []
        self.made.name, self.spare = name, []
        self.made.animation_data_clear()
        for key in list(self.made.keys()):  # it is no crowd to work on, and exporters write these
            del self.made[key]

    def without(self, *names):
        for name in names:
            if name in self.made.modifiers:
                self.made.modifiers.remove(self.made.modifiers[name])

    def add(self, name, tree, before=None):
        modifier = self.made.modifiers.new(name, "NODES")
        modifier.node_group = tree
        self.trees.append(tree)
        if before:
            move_modifier(self.made, modifier.name, self.made.modifiers.find(before))
        return modifier

    def drop(self):
        bpy.data.objects.remove(self.made)
        for tree in self.trees:
            drop_tree(tree)
        for thing in self.spare:
            drop_object(thing)


def _chosen_tree(marks):
    """Who is shown, and how: by the people's own numbers, as those who are retimed have come from elsewhere."""
    tree, inputs, outputs = new_tree("Throng chosen for a file", _GEOMETRY, _GEOMETRY)
    maths = Maths(tree)
    points, told, who = inputs.outputs[0], maths.geometry_of(marks), maths.attribute("id", "INT")
    for name, said in ((HIDDEN, "hidden"), (NEAR, "near"), (LEVEL, "level")):
        node = maths.node("GeometryNodeSampleIndex", data_type="FLOAT", domain="POINT")
        maths.link(told, node.inputs["Geometry"])
        maths.link(maths.attribute(said), socket(node.inputs, "Value"))
        maths.link(who, node.inputs["Index"])
        points = maths.store(points, name, socket(node.outputs))
    nothing = maths.math("MULTIPLY", maths.attribute(NEAR), 0.0)
    maths.link(maths.store(points, COARSE, nothing), outputs.inputs[0])
    return tree


def _next_tree():
    tree, inputs, outputs = new_tree("Throng where people go next", _GEOMETRY, _GEOMETRY)
    maths = Maths(tree)
    maths.link(maths.store(inputs.outputs[0], _GOES, place(maths), "FLOAT_VECTOR"), outputs.inputs[0])
    return tree


def _going_tree(fps):
    """m/s from where people are to where they go next."""
    tree, inputs, outputs = new_tree("Throng how fast people go", _GEOMETRY, _GEOMETRY)
    maths = Maths(tree)
    way = vector(maths, "SUBTRACT", maths.attribute(_GOES, "FLOAT_VECTOR"), place(maths))
    maths.link(maths.store(inputs.outputs[0], _GOES, scaled(maths, way, float(fps)), "FLOAT_VECTOR"),
               outputs.inputs[0])
    return tree


def _started(crowd, name, rows, level, is_bent, fps):
    """A copy that shows some people only, and files away how fast they go."""
    copy = Copy(crowd, name)
    copy.without("throng levels", "throng cull", "throng cutaway", near.MODIFIER, "throng realize")
    marks = bpy.data.objects.new(f"{name} chosen", mark(f"{name} chosen", len(crowd.data.vertices), rows, level,
                                                        is_bent))
    copy.spare.append(marks)
    copy.add(_CHOSEN, _chosen_tree(marks), INSTANCERS[0])
    pos = crowd.modifiers["throng pos"]
    add_cache(copy.made, _NEXT, pos.filepath, "LINEAR", pos.frame_start - 1)
    copy.add(f"{_NEXT} to attribute", _next_tree())
    for modifier in (f"{_NEXT} to attribute", _NEXT):
        move_modifier(copy.made, modifier, 0)
    going = copy.add("throng going", _going_tree(fps))
    move_modifier(copy.made, going.name, copy.made.modifiers.find("throng pos") + 1)
    return copy


def body_copy(crowd, rows, level, is_bent, fps):
    """Everybody's body in one mesh, whose `velocity` is that of every vertex. @param level of detail, of who is not
    bent"""
    copy = _started(crowd, f"{crowd.name} bodies", rows, level, is_bent, fps)
    copy.without(INSTANCERS[1])
    copy.add("throng realize", _realised_tree(is_bent))
    return copy


def _realised_tree(is_bent):
    """Poses are instances, with a velocity of their own limbs; people who are bent come with their whole way."""
    tree, inputs, outputs = new_tree("Throng realize for a file", _GEOMETRY, _GEOMETRY)
    maths = Maths(tree)
    node = maths.node("GeometryNodeRealizeInstances")
    maths.link(inputs.outputs[0], node.inputs[0])
    mesh = node.outputs[0]
    if not is_bent:
        turned = maths.node("ShaderNodeVectorRotate", rotation_type="EULER_XYZ")
        maths.link(maths.attribute("velocity", "FLOAT_VECTOR"), turned.inputs["Vector"])
        maths.link(maths.attribute("throng_turn", "FLOAT_VECTOR"), turned.inputs["Rotation"])
        whole = vector(maths, "ADD", turned.outputs[0], maths.attribute(_GOES, "FLOAT_VECTOR"))
        mesh = maths.store(mesh, "velocity", whole, "FLOAT_VECTOR")
    maths.link(mesh, outputs.inputs[0])
    return tree


def arrow_copy(crowd, rows, fps):
    """A small arrow for each person who is there: its first corner is the person's place."""
    copy = _started(crowd, f"{crowd.name} points", rows, 0, False, fps)
    copy.without(*INSTANCERS)
    copy.add("throng arrows", _arrows_tree(_arrow(copy)))
    return copy


def _arrow(copy):
    mesh = bpy.data.meshes.new("throng arrow")
    mesh.from_pydata([(x, y, 0.0) for x, y in ARROW], [], [(0, 1, 2)])
    copy.spare.append(bpy.data.objects.new("throng arrow", mesh))
    return copy.spare[-1]


def _arrows_tree(arrow):
    tree, inputs, outputs = new_tree("Throng arrows", _GEOMETRY, _GEOMETRY)
    maths = Maths(tree)
    cosine, sine, speed = maths.components("throng_dir")
    state, variation, phase = maths.components("throng_state")
    there = maths.math("MULTIPLY", maths.math("GREATER_THAN", state, 0.5),
                       maths.math("LESS_THAN", maths.attribute(HIDDEN), 0.5))
    heading, size = maths.math("ARCTAN2", sine, cosine), maths.math("ADD", maths.attribute(BIGGER), 1.0)
    points = inputs.outputs[0]
    said = ((maths.attribute("id", "INT"), variation), (state, phase), (heading, speed), (size, there))
    for name, (one, other) in zip(ARROW_MAPS, said):
        points = maths.store(points, name, combined(maths, one, other, 0.0), "FLOAT_VECTOR")
    some = maths.node("GeometryNodeInstanceOnPoints")
    maths.link(points, some.inputs["Points"])
    maths.link(maths.math("GREATER_THAN", there, 0.5), some.inputs["Selection"])
    maths.link(maths.geometry_of(arrow), some.inputs["Instance"])
    maths.link(combined(maths, 0.0, 0.0, heading), some.inputs["Rotation"])
    whole = maths.node("GeometryNodeRealizeInstances")
    maths.link(some.outputs[0], whole.inputs[0])
    arrows = maths.store(whole.outputs[0], "velocity", maths.attribute(_GOES, "FLOAT_VECTOR"), "FLOAT_VECTOR")
    for name in ARROW_MAPS:
        arrows = _on_corners(maths, arrows, name, "FLOAT2")
    maths.link(_on_corners(maths, arrows, "tint", "BYTE_COLOR"), outputs.inputs[0])
    return tree


def _on_corners(maths, arrows, name, kind):
    """What points say, as corners say it: exporters know no other."""
    node = maths.node("GeometryNodeStoreNamedAttribute", data_type=kind, domain="CORNER")
    node.inputs["Name"].default_value = name
    maths.link(arrows, node.inputs["Geometry"])
    maths.link(maths.attribute(name, "FLOAT_VECTOR"), socket(node.inputs, "Value"))
    return node.outputs[0]
