# SPDX-License-Identifier: Apache-2.0
"""Native playback: one object of loose vertices, a stack of modifiers, no Python at render time.

Each Mesh Cache modifier overwrites the vertices with one stream, and a node group behind it files them away as an
attribute; the last one leaves the positions. The instancer then puts a pose on every vertex that is alive. `state` is
read without interpolation, because a pose index between two others would be a third one, and must not change while the
shutter is open.
"""
import random

import bpy

from ..blender.modifiers import move_modifier
from ..blender.nodes import Maths, drop_tree, get_input, new_tree, set_input
from ..cast import sitting
from ..formats import FEET, POSE, STREAMS
from . import close, footing, near, own, pose_lists
from .instancer import instancer_tree
from .names import INSTANCERS, NATURE, SEATS
from .queries import cast_of, crowds_of, repertoire_of

_GEOMETRY = [("Geometry", "NodeSocketGeometry")]


def _store_tree(attribute):
    tree, inputs, outputs = new_tree(f"Throng store {attribute}", _GEOMETRY, _GEOMETRY)
    maths = Maths(tree)
    position = maths.node("GeometryNodeInputPosition").outputs[0]
    maths.link(maths.store(inputs.outputs[0], attribute, position, "FLOAT_VECTOR"), outputs.inputs[0])
    return tree


def set_cast(crowd, cast):
    """Lets a crowd show the figures of a cast as they are now: call it again after some have come or gone."""
    crowd["throng_cast"] = cast
    modifiers = [crowd.modifiers[name] for name in INSTANCERS]
    before = modifiers[0].node_group
    shares = [get_input(modifier, "Share") if modifier.node_group else 2.0 for modifier in modifiers]  # 2: everybody
    streams = [stream for stream in POSE if f"throng {stream}" in crowd.modifiers]
    tree = instancer_tree(cast, repertoire_of(crowd), footing.slopes(crowd), near.bones_for(crowd, cast), streams,
                          crowd.get(close.MOST, 0))
    for modifier, share in zip(modifiers, shares):
        modifier.node_group = tree
        set_input(modifier, "Share", share)
        set_input(modifier, "Blur", modifier.name == INSTANCERS[0])  # nothing blurs on the screen
    drop_tree(before)
    pose_lists.drop_unused(cast)
    crowd.update_tag()


def cast_changed(crowd):
    """To be called when figures of a crowd's cast have come or gone."""
    shown = cast_of(crowd)
    for each in crowds_of(shown):
        set_cast(each, shown)


def add_cache(target, name, path, interpolation, frame_start):
    cache = target.modifiers.new(name, "MESH_CACHE")
    cache.cache_format = "PC2"
    cache.filepath = path
    cache.interpolation = interpolation
    cache.time_mode, cache.play_mode = "FRAME", "SCENE"
    cache.frame_start, cache.frame_scale = frame_start, 1.0
    cache.forward_axis, cache.up_axis = "POS_Y", "POS_Z"
    cache.deform_mode = "OVERWRITE"
    return cache


def give_natures(mesh):
    """What never changes about people, as attributes of their points: it need not be worked out in every frame.

    `id`, so that instances keep theirs when others come and go; `tint`, three random numbers for colours;
    NATURE: which standing clip they take (0 to 3), when its beats fall (0 to 1), and a draw that decides who
    is shown when not all are.
    """
    count = len(mesh.vertices)
    draw = random.Random(7)
    for name, kind in (("id", "INT"), ("tint", "FLOAT_VECTOR"), (NATURE, "FLOAT_VECTOR")):
        if name in mesh.attributes:
            mesh.attributes.remove(mesh.attributes[name])
        mesh.attributes.new(name, kind, "POINT")
    mesh.attributes["id"].data.foreach_set("value", range(count))
    mesh.attributes["tint"].data.foreach_set("vector", [draw.random() for _ in range(3 * count)])
    mesh.attributes[NATURE].data.foreach_set("vector", [value for row in range(count)
                                                        for value in (row % 4, row * 0.618034 % 1.0, draw.random())])


def _add_stream(crowd, stream, path, frame_start):
    add_cache(crowd, f"throng {stream}", path, "NONE" if stream in ("state", *FEET) else "LINEAR", frame_start)
    crowd.modifiers.new(_filed(stream), "NODES").node_group = _store_tree(f"throng_{stream}")


def _filed(stream):
    return f"throng {stream} to attribute"


def follow_pose(crowd, paths):
    """Plays the streams of feet and heads, or no more, as the bake has them: another time it may be baked without."""
    for stream in POSE:
        played = f"throng {stream}" in crowd.modifiers
        if played and stream not in paths:
            tree = crowd.modifiers[_filed(stream)].node_group
            for name in (f"throng {stream}", _filed(stream)):
                crowd.modifiers.remove(crowd.modifiers[name])
            drop_tree(tree)
        elif stream in paths and not played:
            _add_stream(crowd, stream, paths[stream], crowd.modifiers["throng pos"].frame_start)
            for name in (_filed(stream), f"throng {stream}"):
                move_modifier(crowd, name, 0)
    set_cast(crowd, cast_of(crowd))


def build_crowd(bake, name, cast, frame_start, paths):
    """The crowd's object. `paths` are the streams' files as Blender shall store them, by stream."""
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(bake.agents)
    give_natures(mesh)
    crowd = bpy.data.objects.new(name, mesh)
    for stream in (each for each in ("state", "dir", "ground", *POSE) if each in paths):
        _add_stream(crowd, stream, paths[stream], frame_start)
    add_cache(crowd, "throng pos", paths["pos"], "LINEAR", frame_start)
    for name, hidden in zip(INSTANCERS, ("show_viewport", "show_render")):
        setattr(crowd.modifiers.new(name, "NODES"), hidden, False)
    crowd["throng_strides"], cast["throng_gaits"] = list(bake.strides), list(bake.gaits)
    cast[SEATS] = sitting.clips_for(bake.poses)
    cast["throng_drawn"], cast["throng_shipped"] = bake.variations, cast["throng_variations"]
    crowd["throng_frame_start"], crowd["throng_offset"], crowd["throng_percent"] = frame_start, 0, 100.0
    own.give(crowd, cast, bake.folder)
    set_cast(crowd, cast)
    return crowd


assert set(STREAMS) == {"pos", "dir", "state"}
