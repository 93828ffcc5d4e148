# SPDX-License-Identifier: Apache-2.0
"""Figures that keep bones instead of poses (sheets.py): the mesh is at rest, says of each vertex which bones it hangs
on, and nodes work out where all vertices are in every pose when a file is opened.

The sheet then is a mesh of loose points, one for each bone of the first pose, then of the second, and so on. A point's
place is how far its bone has moved, and the attribute TURN how it has turned: about that axis, by as many radians as
the axis is long. One sheet does for all levels of somebody. The attribute HANGS of the figure's mesh has four numbers a
vertex, one for each bone that it hangs on: the bone's number and, behind the point, its share. The first bone has what
the others leave of it.
"""
from dataclasses import dataclass

import bpy
import numpy

from ..blender.nodes import Maths, new_tree, own_tree, socket
from ..blender.vectors import rotated, scaled, vector
from .skinning import MOST, matrices_of, turns_of, within_half_a_round

HANGS, TURN = "throng_bones", "throng_turned"
LIMBS, JOINTS = "throng_limbs", "throng_joints"  # of a sheet; LIMBS are thigh, calf, foot and toes of the left leg,
                                                 # those of the right one, neck and head
TRUNK = "throng_trunk"  # of a sheet: for each bone, the share of it in how the trunk turns and leans
_FINE = 8192.0         # steps a metre of what bones move
_TURNS = 16384.0       # steps a radian
_GEOMETRY = [("Geometry", "NodeSocketGeometry")]


@dataclass
class Boned:
    """A mesh at rest on B bones."""
    mesh: bpy.types.Mesh
    hangs: numpy.ndarray      # (V, MOST) as HANGS has them (skinning.hangs_of)
    count: int                # B
    matrices: object          # () gives (P, B, 3, 4), of the bones in all poses of level 0: one level of somebody asks
    sources: tuple            # for each pose of this level the one of level 0 that it is
    cycles: tuple = ()        # as those of sheets.Posed
    limbs: object = None      # (bones, joints, trunk): the numbers of what LIMBS lists, (10,); where joints are at
                              # rest: hip, knee and ankle of both legs, the neck's lower and its upper end, (8, 3);
                              # and TRUNK, (B,)


def make_sheet(name, matrices, limbs=None):
    """The object of a sheet of bones. @param limbs as Boned has them"""
    poses, bones = matrices.shape[:2]
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(poses * bones)
    mesh.attributes.new(TURN, "FLOAT_VECTOR", "POINT")
    _set_points(mesh, _rounded(matrices[..., 3], _FINE), _rounded(turns_of(matrices[..., :3]), _TURNS))
    sheet = bpy.data.objects.new(name, mesh)
    sheet["throng_bones"] = bones
    if limbs:
        sheet[LIMBS], sheet[JOINTS], sheet[TRUNK] = (numpy.asarray(each).ravel().tolist() for each in limbs)
    return sheet


def _rounded(values, steps):
    return (numpy.rint(values * steps) / steps + 0.0).astype(numpy.float32)


def _set_points(mesh, moves, turns):
    mesh.vertices.foreach_set("co", moves.ravel())
    mesh.attributes[TURN].data.foreach_set("vector", turns.ravel())
    mesh.update()


def _points(sheet):
    """(how far, how) the bones of all poses have moved and turned, each (P, B, 3)."""
    moves, turns = (numpy.empty(3 * len(sheet.data.vertices), numpy.float32) for _ in range(2))
    sheet.data.vertices.foreach_get("co", moves)
    sheet.data.attributes[TURN].data.foreach_get("vector", turns)
    return (each.reshape(-1, sheet["throng_bones"], 3) for each in (moves, turns))


def put_poses(sheet, poses):
    """Writes over poses of a sheet. @param poses {number: (B, 3, 4)}"""
    moves, turns = _points(sheet)
    for number, matrices in poses.items():
        moves[number] = _rounded(matrices[..., 3], _FINE)
        turns[number] = _rounded(turns_of(within_half_a_round(matrices[..., :3])), _TURNS)
    _set_points(sheet.data, moves, turns)
    sheet.update_tag()
    sheet.data.update_tag()


def has_bones(sheet):
    return "throng_bones" in sheet


def bones_of(sheet):
    """(P, B, 3, 4) of a sheet."""
    moves, turns = _points(sheet)
    return matrices_of(turns.astype(float), moves.astype(float))


def hang(mesh, hangs):
    """Writes down which bones the vertices of a mesh hang on. @param hangs as Boned has them"""
    made = mesh.attributes.new(HANGS, "FLOAT_COLOR", "POINT")
    made.data.foreach_set("color", numpy.ascontiguousarray(hangs, numpy.float32).ravel())


def posed_points(figure, sheet, sources):
    """(P, V, 3) of a figure that hangs on bones."""
    mesh = figure.data
    rest, hangs = numpy.empty(3 * len(mesh.vertices), numpy.float32), numpy.empty(4 * len(mesh.vertices), numpy.float32)
    mesh.vertices.foreach_get("co", rest)
    mesh.attributes[HANGS].data.foreach_get("color", hangs)
    hangs = hangs.reshape(-1, MOST).astype(float)
    bones = hangs.astype(int)
    shares = hangs - bones
    shares[:, 0] = 1.0 - shares[:, 1:].sum(axis=1)
    whole = numpy.concatenate([rest.reshape(-1, 3), numpy.ones((len(mesh.vertices), 1))], axis=1)
    matrices = bones_of(sheet)[list(sources)]
    points = sum(numpy.einsum("pvij,vj,v->pvi", matrices[:, bones[:, slot]], whole, shares[:, slot], optimize=True)
                 for slot in range(MOST))
    return points.astype(numpy.float32)


def _columns(maths, bones):
    """A sheet's points with what they turn x and y into filed away on them: once, not for every vertex."""
    turn = maths.attribute(TURN, "FLOAT_VECTOR")
    length = vector(maths, "LENGTH", turn)
    for name, axis in (("x", (1.0, 0.0, 0.0)), ("y", (0.0, 1.0, 0.0))):
        bones = maths.store(bones, name, rotated(maths, axis, turn, length), "FLOAT_VECTOR")
    return bones


def sample(maths, geometry, value, index, kind="FLOAT_VECTOR"):
    node = maths.node("GeometryNodeSampleIndex", data_type=kind, domain="POINT")
    maths.link(geometry, node.inputs["Geometry"])
    maths.link(value, socket(node.inputs, "Value"))
    maths.link(index, node.inputs["Index"])
    return socket(node.outputs, "Value")


def _hung(maths, bones, first, hang, place):
    """Where a bone takes a place. `hang` has the bone's number, `first` is that of the pose's first bone."""
    index = maths.math("ADD", first, maths.math("FLOOR", hang))
    x, y = (sample(maths, bones, maths.attribute(name, "FLOAT_VECTOR"), index) for name in "xy")
    moved = sample(maths, bones, maths.node("GeometryNodeInputPosition").outputs[0], index)
    z = vector(maths, "CROSS_PRODUCT", x, y)
    for column, along in zip((x, y, z), place):
        moved = vector(maths, "ADD", moved, scaled(maths, column, along))
    return moved


def runs_of(sources):
    """Poses as two even runs: (where the second begins, the first's first and step, the second's first and step)."""
    steps = [later - earlier for earlier, later in zip(sources, sources[1:])]
    turn = next((number for number, step in enumerate(steps, 1) if step != steps[0]), len(sources))
    second = sources[turn:] or (0,)
    runs = (turn, sources[0], steps[0] if steps else 1, second[0], second[1] - second[0] if len(second) > 1 else 1)
    assert tuple(sources) == tuple(runs[1] + runs[2] * pose if pose < turn else runs[3] + runs[4] * (pose - turn)
                                   for pose in range(len(sources)))
    return runs


_RUNS = ("Turn", "First", "Step", "Then First", "Then Step")


def skinned(maths, figure, sheet, boned):
    """Nodes for (the figure without what it says of bones, its sheet of points) of a figure and a sheet of bones."""
    group = maths.node("GeometryNodeGroup")
    group.node_tree = _skin_tree()
    maths.link(figure, group.inputs["Figure"])
    maths.link(sheet, group.inputs["Sheet"])
    for name, number in (("Poses", len(boned.sources)), ("Bones", boned.count),
                         *zip(_RUNS, runs_of(tuple(boned.sources)))):
        group.inputs[name].default_value = number
    remove = maths.node("GeometryNodeRemoveAttribute")
    remove.inputs["Name"].default_value = HANGS
    maths.link(figure, remove.inputs[0])
    return remove.outputs[0], group.outputs[0]


def _source(maths, given, pose):
    """Which pose of the sheet a figure's pose is."""
    turn = given["Turn"]
    after = maths.math("GREATER_THAN", pose, maths.math("SUBTRACT", turn, 0.5))
    first = maths.math("MULTIPLY_ADD", pose, given["Step"], given["First"])
    second = maths.math("MULTIPLY_ADD", maths.math("SUBTRACT", pose, turn), given["Then Step"], given["Then First"])
    return maths.math("MULTIPLY_ADD", after, maths.math("SUBTRACT", second, first), first)


def _skin_tree():
    """Where all vertices of a figure are in all of its poses, as loose points: a sheet like those that are stored."""
    name = "Throng skin"
    found = own_tree(name)
    if found:
        return found
    tree, inputs, outputs = new_tree(name, [("Figure", "NodeSocketGeometry"), ("Sheet", "NodeSocketGeometry"),
                                            *((each, "NodeSocketInt") for each in ("Poses", "Bones", *_RUNS))],
                                     _GEOMETRY)
    maths, given = Maths(tree), inputs.outputs
    size = maths.node("GeometryNodeAttributeDomainSize")
    maths.link(given["Figure"], size.inputs[0])
    vertices = socket(size.outputs, "Point Count")
    line = maths.node("GeometryNodeMeshLine")
    maths.link(maths.math("MULTIPLY", vertices, given["Poses"]), line.inputs["Count"])
    index = maths.node("GeometryNodeInputIndex").outputs[0]
    pose = maths.math("FLOOR", maths.math("DIVIDE", maths.math("ADD", index, 0.5), vertices))
    vertex = maths.math("SUBTRACT", index, maths.math("MULTIPLY", pose, vertices))
    first = maths.math("MULTIPLY", _source(maths, given, pose), given["Bones"])
    moved = maths.node("GeometryNodeSetPosition")
    maths.link(line.outputs[0], moved.inputs["Geometry"])
    maths.link(_place(maths, given, vertex, first), moved.inputs["Position"])
    maths.link(moved.outputs[0], outputs.inputs[0])
    return tree


def _place(maths, given, vertex, first):
    """Where a vertex is in the pose whose first bone is the sheet's point `first`."""
    parts = maths.node("ShaderNodeSeparateXYZ")
    maths.link(sample(maths, given["Figure"], maths.node("GeometryNodeInputPosition").outputs[0], vertex),
               parts.inputs[0])
    hangs = maths.node("FunctionNodeSeparateColor")
    maths.link(sample(maths, given["Figure"], maths.attribute(HANGS, "FLOAT_COLOR"), vertex, "FLOAT_COLOR"),
               hangs.inputs[0])
    bones = _columns(maths, given["Sheet"])
    shares = [maths.math("FRACT", each) for each in hangs.outputs[1:MOST]]
    left = maths.math("SUBTRACT", 1.0, maths.math("ADD", shares[0], maths.math("ADD", shares[1], shares[2])))
    place = None
    for bone, share in zip(hangs.outputs, (left, *shares)):
        part = scaled(maths, _hung(maths, bones, first, bone, parts.outputs), share)
        place = part if place is None else vector(maths, "ADD", place, part)
    return place


def told_of(sheets, what):
    """LIMBS or TRUNK, where all sheets tell the same of them; or None."""
    found = [list(sheet.get(what, ())) for sheet in sheets]
    return found[0] if found[0] and all(each == found[0] for each in found) else None


def joints_of(name, sheets):
    """The object of several people's joints, one behind the other: those of their limbs, where they are at rest."""
    joints = numpy.concatenate([numpy.array(sheet.get(JOINTS, ()), numpy.float32) for sheet in sheets])
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(len(joints) // 3)
    mesh.vertices.foreach_set("co", joints)
    return bpy.data.objects.new(name, mesh)


def join_sheets(name, sheets):
    """The object of several people's sheets, one behind the other, with the columns x and y worked out."""
    joined = bpy.data.objects.new(name, bpy.data.meshes.new(name))
    tree, _, outputs = new_tree(f"{name} of all", _GEOMETRY, _GEOMETRY)
    maths = Maths(tree)
    maths.link(_columns(maths, maths.joined(sheets)), outputs.inputs[0])
    joined.modifiers.new("throng bones", "NODES").node_group = tree
    return joined
