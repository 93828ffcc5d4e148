# SPDX-License-Identifier: Apache-2.0
"""Plays overrides without Python: attributes on the crowd's points, read by modifiers that are there only
while somebody is changed.

Whoever is retimed is left out of the crowd's points; instead, those of an object over point caches of its own join them
before the instancer, so that culling and all else has them, too. That object is in no scene.
"""
import math
import os

import bpy

from ..blender.modifiers import move_modifier
from ..blender.nodes import set_input
from ..blender.paths import stored_path
from ..crowd import own
from ..crowd.names import BIGGER
from ..crowd.playback import add_cache, give_natures
from ..crowd.queries import terrain_of
from .dyes import allow_dyes, linear
from .nodes import STANDS, overrides_tree
from .rows import write_caches

MODIFIER = "throng overrides"
RETIMED = "throng_retimed_of"  # points to the crowd whose retimed people an object plays
_ATTRIBUTES = {"throng_hide": "FLOAT", "throng_swap": "FLOAT", "throng_moved": "BOOLEAN", "throng_move": "FLOAT_VECTOR",
               "throng_turned": "FLOAT", "throng_pivot": "FLOAT_VECTOR", STANDS: "FLOAT", BIGGER: "FLOAT",
               "throng_dyed": "FLOAT", "throng_dye": "FLOAT_VECTOR"}


def _add_modifier(crowd, parts, retimed):
    modifier = crowd.modifiers.new(MODIFIER, "NODES")
    modifier.node_group = overrides_tree(parts)
    if retimed:
        set_input(modifier, "Retimed", retimed)
    if "ground" in parts:
        set_input(modifier, "Ground", terrain_of(crowd))
    move_modifier(crowd, MODIFIER, crowd.modifiers.find("throng pos") + 1)


def _said_of(change, pivot):
    """{attribute: value} of a change. What is not there is as it was."""
    said = {"throng_hide": float(change.hides or change.retimes), STANDS: float(change.moves or change.retimes)}
    if change.character is not None:
        said["throng_swap"] = float(change.character)
    if change.scale is not None:
        said[BIGGER] = change.scale - 1.0
    if change.moves:
        said.update({"throng_moved": True, "throng_move": change.move, "throng_pivot": pivot,
                     "throng_turned": math.radians(change.turn)})
    if isinstance(change.tint, str):
        said.update({"throng_dyed": 1.0, "throng_dye": linear(change.tint)})
    return said


def _write_attribute(mesh, name, kind, by_row):
    """One attribute. Where it says nothing of anybody it is left out, but for two that nodes always read."""
    default = -1.0 if name == "throng_swap" else 0.0
    size = 3 if kind == "FLOAT_VECTOR" else 1
    values = [default] * (size * len(mesh.vertices))
    for row, value in by_row.items():
        values[size * row:size * row + size] = value if size == 3 else [value]
    if name not in ("throng_swap", "throng_hide") and all(value == default for value in values):
        return
    numbers = [bool(value) for value in values] if kind == "BOOLEAN" else values
    mesh.attributes.new(name, kind, "POINT").data.foreach_set("vector" if size == 3 else "value", numbers)


def _write_attributes(mesh, changes, pivots):
    said = {row: _said_of(change, pivots.get(row)) for row, change in changes.items()}
    for name, kind in _ATTRIBUTES.items():
        _write_attribute(mesh, name, kind, {row: values[name] for row, values in said.items() if name in values})
    own.let_swap(mesh, [row for row, change in changes.items() if change.character is not None])
    for row, change in changes.items():
        if change.tint is not None and not isinstance(change.tint, str):
            mesh.attributes["tint"].data[row].vector = change.tint


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
    own.let_swap(mesh, ())
    if known:
        give_natures(mesh)  # tints as they were drawn


def _copy_attributes(source, rows, mesh):
    """What some of the points of one mesh have, to the points of another."""
    for attribute in source.attributes:
        if attribute.domain != "POINT" or attribute.data_type not in ("FLOAT", "INT", "FLOAT_VECTOR"):
            continue
        if attribute.name in ("position", "throng_hide") or attribute.name.startswith("."):
            continue
        field = "vector" if attribute.data_type == "FLOAT_VECTOR" else "value"
        copy = mesh.attributes.new(attribute.name, attribute.data_type, "POINT")
        for index, row in enumerate(rows):
            setattr(copy.data[index], field, getattr(attribute.data[row], field))


def _build_retimed(crowd, rows, people, changes, folder):
    """Points with the natures and looks that they have in the crowd, over caches with the moves and swaps in them."""
    paths = write_caches(folder, rows, people, changes)
    relative = crowd.modifiers["throng pos"].filepath.startswith("//")
    order = sorted(changes)
    mesh = bpy.data.meshes.new(f"{crowd.name} retimed")
    mesh.vertices.add(len(order))
    _copy_attributes(crowd.data, order, mesh)
    thing = bpy.data.objects.new(mesh.name, mesh)
    thing[RETIMED] = crowd
    start = crowd.modifiers["throng pos"].frame_start
    for stream in ("state", "dir", "pos"):
        add_cache(thing, f"throng retimed {stream}", stored_path(paths[stream], relative),
                  "NONE" if stream == "state" else "LINEAR", start)
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


def _parts_for(changes, retimed, terrain):
    """What of overrides_tree() changes need. @param retimed whether people are played by an object of their own"""
    moved = [change for change in changes if change.moves and not change.retimes]
    needed = {"state": any(change.hides or change.retimes or change.character is not None for change in changes),
              "turn": any(change.turn for change in moved),
              "move": any(any(change.move) for change in moved),
              "retimed": retimed,
              "ground": terrain and (retimed or bool(moved))}
    return {part for part, there in needed.items() if there}


def play(crowd, rows, people, changes, folder):
    """Shows a crowd with the changes of some rows ({row: Change}); none takes all back. `folder` is for the
    caches of whoever is retimed.

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
        joined = _build_retimed(crowd, rows, people, retimed, folder) if retimed else None
        parts = _parts_for(changes.values(), bool(retimed), terrain_of(crowd) is not None)
        if parts:
            _add_modifier(crowd, parts, joined)
    crowd.update_tag()


def folder_for(path):
    """Where the caches of retimed people go: beside the file of overrides."""
    return os.path.splitext(path)[0]
