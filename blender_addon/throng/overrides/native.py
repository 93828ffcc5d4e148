# SPDX-License-Identifier: Apache-2.0
"""Plays overrides without Python: attributes on the crowd's points, read by modifiers that are there only while somebody is changed.

Whoever is retimed is left out of the crowd's points; instead, those of an object over point caches of its own join them before the instancer,
so that culling and all else has them, too. That object is in no scene.
"""
import math
import os

import bpy

from .. import ground, playback
from ..playback import BIGGER
from ..nodes import Maths, new_tree, own_tree, set_input, socket
from .rows import write_caches

MODIFIER = "throng overrides"
RETIMED = "throng_retimed_of"  # points to the crowd whose retimed people an object plays
STANDS = "throng_stands"  # 1 for whoever the bake has no ground for: moved, or at another time
_ATTRIBUTES = {"throng_hide": "FLOAT", "throng_swap": "FLOAT", "throng_moved": "BOOLEAN", "throng_move": "FLOAT_VECTOR", "throng_turned": "FLOAT",
               "throng_pivot": "FLOAT_VECTOR", STANDS: "FLOAT", BIGGER: "FLOAT", "throng_dyed": "FLOAT", "throng_dye": "FLOAT_VECTOR"}
_GEOMETRY = [("Geometry", "NodeSocketGeometry")]


def _state_nodes(maths, geometry):
    """Who hides is not there; who is swapped has another variation (-1: its own)."""
    separate = maths.node("ShaderNodeSeparateXYZ")
    maths.link(maths.attribute("throng_state", "FLOAT_VECTOR"), separate.inputs[0])
    swap = maths.attribute("throng_swap", "FLOAT")
    swapped = maths.math("GREATER_THAN", swap, -0.5)
    kept = maths.math("MULTIPLY", separate.outputs[1], maths.math("SUBTRACT", 1.0, swapped))
    combine = maths.node("ShaderNodeCombineXYZ")
    maths.link(maths.math("MULTIPLY", separate.outputs[0], maths.math("SUBTRACT", 1.0, maths.attribute("throng_hide", "FLOAT"))), combine.inputs[0])
    maths.link(maths.math("MULTIPLY_ADD", swap, swapped, kept), combine.inputs[1])
    maths.link(separate.outputs[2], combine.inputs[2])
    return maths.store(geometry, "throng_state", combine.outputs[0], "FLOAT_VECTOR")


def _place_nodes(maths, geometry):
    """Moved. With a selection, so that fields are worked out for those few only."""
    place = maths.node("GeometryNodeSetPosition")
    maths.link(geometry, place.inputs["Geometry"])
    maths.link(maths.attribute("throng_moved", "BOOLEAN"), place.inputs["Selection"])
    maths.link(maths.attribute("throng_move", "FLOAT_VECTOR"), place.inputs["Offset"])
    return place.outputs[0]


def _turn_nodes(maths, geometry):
    """Turned about where it entered, heading and all."""
    turn = maths.attribute("throng_turned", "FLOAT")

    def turned(vector, centre=None):
        node = maths.node("ShaderNodeVectorRotate", rotation_type="Z_AXIS")
        maths.link(vector, node.inputs["Vector"])
        maths.link(turn, node.inputs["Angle"])
        if centre:
            maths.link(centre, node.inputs["Center"])
        return node.outputs[0]

    place = maths.node("GeometryNodeSetPosition")
    maths.link(geometry, place.inputs["Geometry"])
    maths.link(maths.attribute("throng_moved", "BOOLEAN"), place.inputs["Selection"])
    maths.link(turned(maths.node("GeometryNodeInputPosition").outputs[0], maths.attribute("throng_pivot", "FLOAT_VECTOR")), place.inputs["Position"])
    return maths.store(place.outputs[0], "throng_dir", turned(maths.attribute("throng_dir", "FLOAT_VECTOR")), "FLOAT_VECTOR", only="throng_moved")


def _tree(parts):
    name = "Throng overrides: " + ", ".join(sorted(parts))
    found = own_tree(name)
    if found:
        return found
    objects = [(socket_name, "NodeSocketObject") for part, socket_name in (("retimed", "Retimed"), ("ground", "Ground")) if part in parts]
    tree, inputs, outputs = new_tree(name, _GEOMETRY + objects, _GEOMETRY)
    maths = Maths(tree)
    geometry = inputs.outputs[0]
    for part, build in (("state", _state_nodes), ("turn", _turn_nodes), ("move", _place_nodes)):
        if part in parts:
            geometry = build(maths, geometry)
    if "retimed" in parts:
        points = maths.node("GeometryNodeObjectInfo", transform_space="ORIGINAL")
        join = maths.node("GeometryNodeJoinGeometry")
        maths.link(inputs.outputs["Retimed"], points.inputs["Object"])
        maths.link(points.outputs["Geometry"], join.inputs[0])
        maths.link(geometry, join.inputs[0])
        geometry = join.outputs[0]
    if "ground" in parts:
        move = maths.node("ShaderNodeSeparateXYZ")
        maths.link(maths.attribute("throng_move", "FLOAT_VECTOR"), move.inputs[0])
        geometry = ground.stand_anew(maths, geometry, inputs.outputs["Ground"], STANDS, move.outputs[2])
    maths.link(geometry, outputs.inputs[0])
    return tree


def _move_modifier(thing, name, index):
    modifiers = thing.modifiers
    if hasattr(modifiers, "move"):
        modifiers.move(modifiers.find(name), index)
    else:
        with bpy.context.temp_override(object=thing, active_object=thing):
            bpy.ops.object.modifier_move_to_index(modifier=name, index=index)


def terrain_of(crowd):
    """The mesh of the bake's terrain, if the scene has it."""
    if "throng ground" not in crowd.modifiers:
        return None
    return next((thing for collection in crowd.users_collection for thing in collection.objects if thing.name.startswith("Throng terrain")), None)


def _add_modifier(crowd, parts, retimed):
    modifier = crowd.modifiers.new(MODIFIER, "NODES")
    modifier.node_group = _tree(parts)
    if retimed:
        set_input(modifier, "Retimed", retimed)
    if "ground" in parts:
        set_input(modifier, "Ground", terrain_of(crowd))
    _move_modifier(crowd, MODIFIER, crowd.modifiers.find("throng pos") + 1)


def linear(colour):
    """"#rrggbb" (sRGB) as three linear numbers."""
    parts = (int(colour[at:at + 2], 16) / 255.0 for at in (1, 3, 5))
    return tuple(v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4 for v in parts)


def _write_attributes(mesh, changes, pivots):
    count = len(mesh.vertices)
    values = {name: [0.0] * (count * (3 if kind == "FLOAT_VECTOR" else 1)) for name, kind in _ATTRIBUTES.items()}
    values["throng_swap"] = [-1.0] * count
    tints = {}
    for row, change in changes.items():
        three = slice(3 * row, 3 * row + 3)
        values["throng_hide"][row] = float(change.hides or change.retimes)
        values["throng_swap"][row] = -1.0 if change.character is None else float(change.character)
        values[BIGGER][row] = 0.0 if change.scale is None else change.scale - 1.0
        values[STANDS][row] = float(change.moves or change.retimes)
        if change.moves:
            values["throng_moved"][row] = True
            values["throng_move"][three], values["throng_pivot"][three] = change.move, pivots[row]
            values["throng_turned"][row] = math.radians(change.turn)
        if isinstance(change.tint, str):
            values["throng_dyed"][row], values["throng_dye"][three] = 1.0, linear(change.tint)
        elif change.tint is not None:
            tints[row] = change.tint
    for name, kind in _ATTRIBUTES.items():
        default = -1.0 if name == "throng_swap" else 0.0
        if all(value == default for value in values[name]) and name not in ("throng_swap", "throng_hide"):
            continue
        numbers = [bool(value) for value in values[name]] if kind == "BOOLEAN" else values[name]
        mesh.attributes.new(name, kind, "POINT").data.foreach_set("vector" if kind == "FLOAT_VECTOR" else "value", numbers)
    for row, tint in tints.items():
        mesh.attributes["tint"].data[row].vector = tint


def retimed_object(crowd):
    return next((thing for thing in bpy.data.objects if thing.get(RETIMED) == crowd), None)


def _remove_retimed(crowd):
    thing = retimed_object(crowd)
    if thing:
        mesh = thing.data
        bpy.data.objects.remove(thing)
        bpy.data.meshes.remove(mesh)


def clear(crowd):
    """As if nobody had ever been changed."""
    _remove_retimed(crowd)
    if MODIFIER in crowd.modifiers:
        crowd.modifiers.remove(crowd.modifiers[MODIFIER])
    mesh = crowd.data
    known = [name for name in _ATTRIBUTES if name in mesh.attributes]
    for name in known:
        mesh.attributes.remove(mesh.attributes[name])
    if known:
        playback.give_natures(mesh)  # tints as they were drawn


def _build_retimed(crowd, rows, people, changes, folder):
    """Points with the natures and looks that they have in the crowd, over caches that have the moves and swaps in them."""
    from ..importer import stored_path

    paths = write_caches(folder, rows, people, changes)
    relative = crowd.modifiers["throng pos"].filepath.startswith("//")
    order = sorted(changes)
    mesh = bpy.data.meshes.new(f"{crowd.name} retimed")
    mesh.vertices.add(len(order))
    for attribute in crowd.data.attributes:
        if attribute.domain != "POINT" or attribute.name in ("position", "throng_hide") or attribute.name.startswith("."):
            continue
        field = "vector" if attribute.data_type == "FLOAT_VECTOR" else "value"
        if attribute.data_type not in ("FLOAT", "INT", "FLOAT_VECTOR"):
            continue
        copy = mesh.attributes.new(attribute.name, attribute.data_type, "POINT")
        for index, row in enumerate(order):
            setattr(copy.data[index], field, getattr(attribute.data[row], field))
    thing = bpy.data.objects.new(mesh.name, mesh)
    thing[RETIMED] = crowd
    start = crowd.modifiers["throng pos"].frame_start
    for stream in ("state", "dir", "pos"):
        playback._add_cache(thing, f"throng retimed {stream}", stored_path(paths[stream], relative), "NONE" if stream == "state" else "LINEAR", start)
        if stream != "pos":
            store = f"throng {stream} to attribute"
            thing.modifiers.new(store, "NODES").node_group = crowd.modifiers[store].node_group
    return thing


def follow(crowd):
    """Retimed people play from the frame that the crowd does."""
    thing = retimed_object(crowd)
    if thing:
        for stream in ("state", "dir", "pos"):
            thing.modifiers[f"throng retimed {stream}"].frame_start = crowd.modifiers["throng pos"].frame_start


def play(crowd, rows, people, changes, folder):
    """Shows a crowd with the changes of some rows ({row: Change}); none takes all back. `folder` is for the caches of whoever is retimed.

    Raises BakeError, before anything is changed.
    """
    pivots = {row: rows.place(row, people[row].frame) for row, change in changes.items() if change.moves}
    retimed = {row: change for row, change in changes.items() if change.retimes and not change.hides}
    if retimed:
        write_caches(folder, rows, people, retimed)  # again below: what exists is not written twice
    clear(crowd)
    if any(isinstance(change.tint, str) for change in changes.values()):
        allow_dyes(crowd)
    if changes:
        _write_attributes(crowd.data, changes, pivots)
        every = changes.values()
        parts = {"state"} if any(c.hides or c.retimes or c.character is not None for c in every) else set()
        moved = [c for c in every if c.moves and not c.retimes]
        parts |= {part for part, there in (("turn", any(c.turn for c in moved)), ("move", any(any(c.move) for c in moved))) if there}
        joined = _build_retimed(crowd, rows, people, retimed, folder) if retimed else None
        parts |= {"retimed"} if joined else set()
        parts |= {"ground"} if (moved or joined) and terrain_of(crowd) else set()
        if parts:
            _add_modifier(crowd, parts, joined)
    crowd.update_tag()


def _cast_materials(crowd):
    """Materials of all whom the crowd can show."""
    return {slot.material for thing in crowd["throng_cast"].all_objects for slot in thing.material_slots if slot.material}


def allow_dyes(crowd):
    """Lets the materials of top garments take somebody's own colour: the instance attributes `throng_dyed` (0 or 1) and `throng_dye`."""
    for material in _cast_materials(crowd):
        if not material.name.startswith("throng top") or not material.use_nodes or "Throng dye" in material.node_tree.nodes:
            continue
        nodes, links = material.node_tree.nodes, material.node_tree.links
        shader = next((node for node in nodes if node.type == "BSDF_PRINCIPLED"), None)
        if not shader:
            continue
        base = shader.inputs["Base Color"]
        mix = nodes.new("ShaderNodeMix")
        mix.name, mix.data_type = "Throng dye", "RGBA"
        own, factor, dyed = socket(mix.inputs, "A"), socket(mix.inputs, "Factor"), socket(mix.inputs, "B")
        if base.is_linked:
            links.new(base.links[0].from_socket, own)
        else:
            own.default_value = base.default_value
        for name, output, target in (("throng_dyed", "Fac", factor), ("throng_dye", "Color", dyed)):
            attribute = nodes.new("ShaderNodeAttribute")
            attribute.attribute_type, attribute.attribute_name = "INSTANCER", name
            links.new(attribute.outputs[output], target)
        links.new(socket(mix.outputs, "Result"), base)


def folder_for(path):
    """Where the caches of retimed people go: beside the file of overrides."""
    return os.path.splitext(path)[0]
