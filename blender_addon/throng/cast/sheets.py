# SPDX-License-Identifier: Apache-2.0
"""How a cast keeps its poses: a figure is somebody's mesh at a level of detail, and a sheet is where its
vertices are in every pose.

The sheet is a mesh of loose points: all vertices of the figure in the first pose, then all in the second, and so on;
its attribute `velocity` says how fast they move in the poses that walk. The figure's one modifier makes an instance of
each pose from the two, in order, and a crowd's instancer picks among them. Figure and sheet are in no scene and are
worked out once, when a file is opened.

Why a pose is no object of its own: a crowd has more than a thousand, and Blender's dependency graph goes over all
operations of every object that something refers to in every frame, whether anything has changed or not. With objects
that took as long as all people together. The price: people are geometry of one object, the crowd, so mattes go by crowd
and by material, and exports want Realize Instances (docs/blender.md).
"""
import zlib
from dataclasses import dataclass

import bpy
import numpy

from ..blender.nodes import Maths, drop_tree, get_input, new_tree, own_tree, set_input, socket
from . import bones

MODIFIER = "throng poses"
MOST_POINTS = 1 << 24  # numbers of points go through nodes as floats, which count no further
_GEOMETRY = [("Geometry", "NodeSocketGeometry")]


@dataclass
class Posed:
    """A mesh, and where its V vertices are in P poses, of which the first W walk."""
    mesh: bpy.types.Mesh
    points: numpy.ndarray             # (P, V, 3) m
    velocities: numpy.ndarray = None  # (W, V, 3) m/s in the walker's own frame, where limbs blur
    cycles: tuple = ()                # or, of each gait, how many poses and the seconds between two: velocities then
                                      # are worked out from the poses before and after, and take no room in files


def drop_spare_attributes(mesh, keep_sharp=False):
    """What editing left in a mesh, and marks of sharp faces where there are none: Blender goes over the attributes of
    all poses in every frame."""
    for name in [each.name for each in mesh.attributes
                 if each.name.startswith((".select_", ".uv_select_"))
                 or (each.name == "sharp_face" and not keep_sharp)]:
        mesh.attributes.remove(mesh.attributes[name])


def make_figure(name, posed, sheet=None):
    """The object of somebody at a level of detail. The mesh becomes its own.

    @param posed Posed, or Boned; @param sheet of bones that there is already
    """
    if isinstance(posed, bones.Boned):
        return _boned_figure(name, posed, sheet)
    poses, vertices, _ = posed.points.shape
    assert posed.velocities is None or not posed.cycles
    sheet = bpy.data.objects.new(f"{name} poses", bpy.data.meshes.new(f"{name} poses"))
    sheet.data.vertices.add(poses * vertices)
    sheet.data.vertices.foreach_set("co", numpy.ascontiguousarray(posed.points, numpy.float32).ravel())
    blurring = 0
    if posed.velocities is not None:
        blurring = len(posed.velocities)
        whole = numpy.zeros((poses, vertices, 3), numpy.float32)
        whole[:blurring] = posed.velocities
        sheet.data.attributes.new("velocity", "FLOAT_VECTOR", "POINT").data.foreach_set("vector", whole.ravel())
    sheet.data.update()
    posed.mesh.name = name
    figure = bpy.data.objects.new(name, posed.mesh)
    modifier = figure.modifiers.new(MODIFIER, "NODES")
    modifier.node_group = _poses_tree(poses, blurring, posed.cycles)
    set_input(modifier, "Sheet", sheet)
    return figure


def _boned_figure(name, boned, sheet):
    bones.hang(boned.mesh, boned.hangs)
    boned.mesh.name = name
    figure = bpy.data.objects.new(name, boned.mesh)
    figure["throng_sources"] = list(boned.sources)
    modifier = figure.modifiers.new(MODIFIER, "NODES")
    modifier.node_group = _poses_tree(len(boned.sources), 0, boned.cycles, boned)
    set_input(modifier, "Sheet", sheet or bones.make_sheet(f"{name} bones", boned.matrices(), boned.limbs))
    return figure


def sheet_of(figure):
    return get_input(figure.modifiers[MODIFIER], "Sheet")


def points_of(figure, values="points"):
    """(P, V, 3): where a figure's vertices are in each pose, or their "velocity"."""
    if bones.has_bones(sheet_of(figure)):
        return bones.posed_points(figure, sheet_of(figure), figure["throng_sources"])
    mesh = sheet_of(figure).data
    flat = numpy.empty(3 * len(mesh.vertices), numpy.float32)
    if values == "points":
        mesh.vertices.foreach_get("co", flat)
    else:
        mesh.attributes[values].data.foreach_get("vector", flat)
    return flat.reshape(-1, len(figure.data.vertices), 3)


def pose_mesh(figure, pose):
    """A mesh of one pose alone, with the figure's materials."""
    mesh = figure.data.copy()
    if bones.HANGS in mesh.attributes:
        mesh.attributes.remove(mesh.attributes[bones.HANGS])
    mesh.vertices.foreach_set("co", points_of(figure)[pose].ravel())
    mesh.update()
    return mesh


def remove_figures(figures):
    """With their sheets, and with the meshes and nodes that nobody else uses. Materials stay."""
    gone = set(figures)
    shared = {sheet_of(thing) for thing in bpy.data.objects if MODIFIER in thing.modifiers and thing not in gone}
    sheets = list({sheet_of(figure) for figure in figures} - shared)
    trees = {figure.modifiers[MODIFIER].node_group for figure in figures}
    meshes = [thing.data for thing in (*figures, *sheets)]
    bpy.data.batch_remove([*figures, *sheets])
    bpy.data.batch_remove([mesh for mesh in meshes if mesh.users == 0])
    for tree in trees:
        drop_tree(tree)


_POSE_TREES = {"": "Throng pose", "stored": "Throng pose that blurs", "worked out": "Throng pose that blurs by others"}


def _pose_tree(blurs):
    """One pose: the figure's mesh with its vertices where the sheet has them.

    @param blurs by velocities that are "stored" in the sheet, or "worked out" from two other poses of it, or not ("")
    """
    found = own_tree(_POSE_TREES[blurs])
    if found:
        return found
    others = [("Before", "NodeSocketInt"), ("After", "NodeSocketInt"), ("Rate", "NodeSocketFloat")]
    tree, inputs, outputs = new_tree(_POSE_TREES[blurs], [
        ("Figure", "NodeSocketGeometry"), ("Sheet", "NodeSocketGeometry"), ("First", "NodeSocketInt"),
        *(others if blurs == "worked out" else [])], _GEOMETRY)
    maths = Maths(tree)
    index = maths.node("GeometryNodeInputIndex").outputs[0]

    def from_sheet(value, first="First"):
        place = maths.math("ADD", index, inputs.outputs[first])
        sample = maths.node("GeometryNodeSampleIndex", data_type="FLOAT_VECTOR", domain="POINT")
        maths.link(inputs.outputs["Sheet"], sample.inputs["Geometry"])
        maths.link(value, socket(sample.inputs, "Value"))
        maths.link(place, sample.inputs["Index"])
        return socket(sample.outputs, "Value")

    moved = maths.node("GeometryNodeSetPosition")
    maths.link(inputs.outputs["Figure"], moved.inputs["Geometry"])
    position = maths.node("GeometryNodeInputPosition").outputs[0]
    maths.link(from_sheet(position), moved.inputs["Position"])
    posed = moved.outputs[0]
    if blurs == "worked out":
        way, velocity = (maths.node("ShaderNodeVectorMath", operation=each) for each in ("SUBTRACT", "SCALE"))
        maths.link(from_sheet(position, "After"), way.inputs[0])
        maths.link(from_sheet(position, "Before"), way.inputs[1])
        maths.link(way.outputs[0], velocity.inputs[0])
        maths.link(inputs.outputs["Rate"], velocity.inputs["Scale"])
        posed = maths.store(posed, "velocity", velocity.outputs[0], "FLOAT_VECTOR")
    if blurs == "stored":
        posed = maths.store(posed, "velocity", from_sheet(maths.attribute("velocity", "FLOAT_VECTOR")), "FLOAT_VECTOR")
    instance = maths.node("GeometryNodeGeometryToInstance")
    maths.link(posed, instance.inputs[0])
    maths.link(instance.outputs[0], outputs.inputs[0])
    return tree


def _neighbours(cycles):
    """For each pose that walks: the ones before and after it, and 1 / s between these."""
    found, first = [], 0
    for count, seconds in cycles:
        found += [(first + (pose - 1) % count, first + (pose + 1) % count, 0.5 / seconds) for pose in range(count)]
        first += count
    return found


def _poses_tree(poses, blurring, cycles, boned=None):
    """An instance of each pose, in order; the first ones blur. The sheet is one of points, or of bones."""
    neighbours = _neighbours(cycles)
    name = f"Throng {poses} poses, {blurring} blur"
    if cycles or boned:  # names have room for 63 letters
        which = (cycles, boned and (tuple(boned.sources), boned.count))
        name = f"Throng {poses} poses{' of bones' if boned else ''}, blur {zlib.crc32(repr(which).encode()):08x}"
    found = own_tree(name)
    if found:
        return found
    tree, inputs, outputs = new_tree(name, _GEOMETRY + [("Sheet", "NodeSocketObject")], _GEOMETRY)
    maths = Maths(tree)
    sheet = maths.node("GeometryNodeObjectInfo", transform_space="ORIGINAL")
    maths.link(inputs.outputs["Sheet"], sheet.inputs["Object"])
    size = maths.node("GeometryNodeAttributeDomainSize")
    figure, points = inputs.outputs["Geometry"], socket(sheet.outputs, "Geometry")
    if boned:
        figure, points = bones.skinned(maths, figure, points, boned)
    maths.link(figure, size.inputs[0])
    everything = maths.node("GeometryNodeJoinGeometry")
    for pose in reversed(range(poses)):  # what is linked to a Join Geometry last comes out first
        one = maths.node("GeometryNodeGroup")
        by_others = pose < len(neighbours)
        one.node_tree = _pose_tree("worked out" if by_others else "stored" if pose < blurring else "")
        if by_others:
            before, after, rate = neighbours[pose]
            for each, number in (("Before", before), ("After", after)):
                maths.link(maths.math("MULTIPLY", socket(size.outputs, "Point Count"), float(number)), one.inputs[each])
            one.inputs["Rate"].default_value = rate
        maths.link(figure, one.inputs["Figure"])
        maths.link(points, one.inputs["Sheet"])
        maths.link(maths.math("MULTIPLY", socket(size.outputs, "Point Count"), float(pose)), one.inputs["First"])
        maths.link(one.outputs[0], everything.inputs[0])
    maths.link(everything.outputs[0], outputs.inputs[0])
    return tree
