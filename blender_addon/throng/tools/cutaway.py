# SPDX-License-Identifier: Apache-2.0
"""Takes storeys off, to look into those below: people, floors and all that stands higher than a height.

Natively: modifiers leave out people and faces of the terrain, which has all floors, and no Python runs when frames
change. Walls, stands and the like that begin above are hidden whole; what begins below stays, however high it is.
"""
import numpy

from ..blender.modifiers import move_modifier
from ..blender.nodes import Maths, new_tree, own_tree, set_input
from ..crowd.names import HIDDEN
from ..crowd.queries import bake_path, terrain_of
from ..formats import BakeError, load_bake

MODIFIER = "throng cutaway"
_HID = "throng_cutaway"  # of objects that it has hidden: whether (screen, pictures) were before
_SLAB = 0.25             # m: floors are so thick (authoring/storeys/chart_mesh.cpp)
_LEAST = 0.05            # m: what begins less below the height goes, too
_GEOMETRY = [("Geometry", "NodeSocketGeometry")]


def _tree(name, build):
    found = own_tree(name)
    if found:
        return found
    tree, inputs, outputs = new_tree(name, [*_GEOMETRY, ("Height", "NodeSocketFloat")], _GEOMETRY)
    maths = Maths(tree)
    split = maths.node("ShaderNodeSeparateXYZ")
    maths.link(maths.node("GeometryNodeInputPosition").outputs[0], split.inputs[0])
    above = maths.math("GREATER_THAN", split.outputs[2], inputs.outputs["Height"])
    maths.link(build(maths, inputs.outputs["Geometry"], above), outputs.inputs[0])
    return tree


def _without_people(maths, points, above):
    return maths.store(points, HIDDEN, maths.math("MAXIMUM", maths.attribute(HIDDEN), above))


def _without_faces(maths, mesh, above):
    cut = maths.node("GeometryNodeDeleteGeometry", domain="FACE", mode="ALL")
    maths.link(mesh, cut.inputs["Geometry"])
    maths.link(above, cut.inputs["Selection"])
    return cut.outputs[0]


def floor_of(crowd, level):
    """m: where a level's floor begins, from below. Raises formats.BakeError."""
    levels = {each["id"]: float(each["height"]) for each in load_bake(bake_path(crowd)).manifest.get("levels", ())}
    if level in levels:
        return levels[level] - _SLAB
    known = f"it has {', '.join(f'`{each}`' for each in levels)}" if levels else "it has none"
    raise BakeError(f"the bake of {crowd.name} has no level `{level}`: {known}")


def _add(thing, name, build, height):
    modifier = thing.modifiers.new(MODIFIER, "NODES")
    modifier.node_group = _tree(name, build)
    set_input(modifier, "Height", float(height) - _LEAST)


def put_last(crowd):
    """What else leaves people out begins anew, so this comes after it, just before the instancer."""
    if MODIFIER in crowd.modifiers:
        own, instancer = (crowd.modifiers.find(name) for name in (MODIFIER, "throng people"))
        move_modifier(crowd, MODIFIER, instancer - int(own < instancer))


def apply(crowd, height):
    """@param height m, as people's places"""
    remove(crowd)
    _add(crowd, "Throng cutaway of people", _without_people, height)
    put_last(crowd)
    terrain = terrain_of(crowd)
    if terrain:
        _add(terrain, "Throng cutaway of faces", _without_faces, height)
    for thing in _set_of(crowd):
        if thing != terrain and _lowest(thing) > crowd.matrix_world.translation.z + height - _LEAST:
            thing[_HID] = [int(thing.hide_viewport), int(thing.hide_render)]
            thing.hide_viewport = thing.hide_render = True
    crowd.update_tag()


def remove(crowd):
    """Shows everything again."""
    for thing in {crowd, terrain_of(crowd)} - {None}:
        modifier = thing.modifiers.get(MODIFIER)
        if modifier:
            thing.modifiers.remove(modifier)
    for thing in _set_of(crowd):
        if _HID in thing:
            thing.hide_viewport, thing.hide_render = (bool(value) for value in thing[_HID])
            del thing[_HID]
    crowd.update_tag()


def _set_of(crowd):
    """Meshes of the bake's set that are not keyed: who moves, moves on."""
    return [thing for collection in crowd.users_collection if "throng_bake" in collection
            for thing in collection.all_objects
            if thing.type == "MESH" and thing != crowd and not thing.animation_data and not thing.parent]


def _lowest(thing):
    """m, of the world."""
    corners = numpy.array(thing.bound_box) @ numpy.array(thing.matrix_world)[:3, :3].T
    return float(corners[:, 2].min()) + thing.matrix_world.translation.z
