# SPDX-License-Identifier: Apache-2.0
"""Native playback: one object of loose vertices, a stack of modifiers, no Python at render time.

Each Mesh Cache modifier overwrites the vertices with one stream, and a node group behind it files them away as an attribute; the
last one leaves the positions. The instancer then puts a pose on every vertex that is alive. `state` is read without interpolation,
because a pose index between two others would be a third one, and must not change while the shutter is open.
"""
import random

import bpy

from .cast import BEATS, POSES
from .culling import HIDDEN
from .formats import STREAMS
from .nodes import Maths, new_tree, set_input, socket

STANDING_SPEED = 0.1    # m/s: slower people stand
FRAMES_A_ROUND = 80.0   # of a standing clip
NATURE = "throng_nature"
GEOMETRY = [("Geometry", "NodeSocketGeometry")]


def _store_tree(attribute):
    tree, inputs, outputs = new_tree(f"Throng store {attribute}", GEOMETRY, GEOMETRY)
    maths = Maths(tree)
    store = maths.node("GeometryNodeStoreNamedAttribute", data_type="FLOAT_VECTOR", domain="POINT")
    store.inputs["Name"].default_value = attribute
    maths.link(inputs.outputs[0], store.inputs["Geometry"])
    maths.link(maths.node("GeometryNodeInputPosition").outputs[0], socket(store.inputs, "Value"))
    maths.link(store.outputs[0], outputs.inputs[0])
    return tree


def _components(maths, attribute):
    named = maths.node("GeometryNodeInputNamedAttribute", data_type="FLOAT_VECTOR")
    named.inputs["Name"].default_value = attribute
    separate = maths.node("ShaderNodeSeparateXYZ")
    maths.link(socket(named.outputs, "Attribute"), separate.inputs[0])
    return separate.outputs


def _walking_pose(maths, state, phase):
    """The gait is what `state` adds to the activity, in sixteenths; the pose is the phase's."""
    gait = maths.math("ROUND", maths.math("MULTIPLY", maths.math("FRACT", state), 16.0))
    step = maths.math("MINIMUM", maths.math("FLOOR", maths.math("MULTIPLY", maths.math("FRACT", phase), POSES)), POSES - 1)
    return maths.math("MULTIPLY_ADD", gait, POSES, step)


def _standing_pose(maths, state, nature, repertoire):
    """Those who gather talk, shift their weight or look at their phones, one in four each; others who stand only shift.

    The beat follows the frame, rounded, so that it does not change while the shutter is open; everybody has their own.
    """
    gathers = maths.math("COMPARE", maths.math("FLOOR", state), 2.0, 0.1)
    clip = maths.math("MODULO", nature[0], maths.math("MULTIPLY_ADD", gathers, 2.0, 2.0))
    frame = maths.math("ROUND", socket(maths.node("GeometryNodeInputSceneTime").outputs, "Frame"))
    rounds = maths.math("ADD", nature[1], maths.math("DIVIDE", frame, FRAMES_A_ROUND))
    beat = maths.math("FLOOR", maths.math("MULTIPLY", maths.math("FRACT", rounds), BEATS))
    return maths.math("ADD", maths.math("MULTIPLY_ADD", clip, BEATS, repertoire.walking), beat)


def _pose_index(maths, speed, state, variation, phase, nature, repertoire, variations):
    walking = maths.math("GREATER_THAN", speed, STANDING_SPEED)
    pose = maths.math("ADD", maths.math("MULTIPLY", _walking_pose(maths, state, phase), walking),
                      maths.math("MULTIPLY", maths.math("SUBTRACT", 1.0, walking), _standing_pose(maths, state, nature, repertoire)))
    variation = maths.math("MODULO", variation, variations)
    return maths.math("MULTIPLY_ADD", variation, repertoire.count, pose)


def _instancer_tree(collection, repertoire, variations):
    tree, inputs, outputs = new_tree("Throng instancer", GEOMETRY + [("Share", "NodeSocketFloat")], GEOMETRY)
    maths = Maths(tree)
    cosine, sine, _ = _components(maths, "throng_dir")
    alive, variation, phase = _components(maths, "throng_state")
    speed = _components(maths, "throng_dir")[2]
    heading = maths.math("ARCTAN2", sine, cosine)
    rotation = maths.node("ShaderNodeCombineXYZ")
    maths.link(heading, rotation.inputs[2])

    nature = _components(maths, NATURE)

    people = maths.node("GeometryNodeCollectionInfo", transform_space="ORIGINAL")
    people.inputs["Collection"].default_value = collection
    people.inputs["Separate Children"].default_value = True
    people.inputs["Reset Children"].default_value = True
    place = maths.node("GeometryNodeInstanceOnPoints")
    place.inputs["Pick Instance"].default_value = True
    maths.link(inputs.outputs[0], place.inputs["Points"])
    shown = maths.math("LESS_THAN", nature[2], inputs.outputs["Share"])
    hidden = maths.node("GeometryNodeInputNamedAttribute", data_type="FLOAT")  # zero where nothing is culled
    hidden.inputs["Name"].default_value = HIDDEN
    seen = maths.math("SUBTRACT", shown, socket(hidden.outputs, "Attribute"))
    present = maths.math("MULTIPLY", maths.math("GREATER_THAN", alive, 0.5), seen)
    maths.link(maths.greater(present, 0.5), place.inputs["Selection"])
    maths.link(people.outputs[0], place.inputs["Instance"])
    maths.link(_pose_index(maths, speed, alive, variation, phase, nature, repertoire, variations), place.inputs["Instance Index"])
    maths.link(rotation.outputs[0], place.inputs["Rotation"])

    maths.link(place.outputs[0], outputs.inputs[0])  # the points' attributes go along: id, tint
    return tree


def _add_cache(target, name, path, interpolation, frame_start):
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

    `id`, so that instances keep theirs when others come and go; `tint`, three random numbers for colours; NATURE: which standing clip
    they take (0 to 3), when its beats fall (0 to 1), and a draw that decides who is shown when not all are.
    """
    count = len(mesh.vertices)
    draw = random.Random(7)
    for name, kind in (("id", "INT"), ("tint", "FLOAT_VECTOR"), (NATURE, "FLOAT_VECTOR")):
        if name in mesh.attributes:
            mesh.attributes.remove(mesh.attributes[name])
        mesh.attributes.new(name, kind, "POINT")
    mesh.attributes["id"].data.foreach_set("value", range(count))
    mesh.attributes["tint"].data.foreach_set("vector", [draw.random() for _ in range(3 * count)])
    mesh.attributes[NATURE].data.foreach_set("vector", [value for row in range(count) for value in (row % 4, row * 0.618034 % 1.0, draw.random())])


def build_crowd(bake, name, cast, repertoire, variations, frame_start, paths):
    """The crowd's object. `paths` are the streams' files as Blender shall store them, by stream."""
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(bake.agents)
    give_natures(mesh)
    crowd = bpy.data.objects.new(name, mesh)
    for stream in ("state", "dir"):
        _add_cache(crowd, f"throng {stream}", paths[stream], "NONE" if stream == "state" else "LINEAR", frame_start)
        modifier = crowd.modifiers.new(f"throng {stream} to attribute", "NODES")
        modifier.node_group = _store_tree(f"throng_{stream}")
    _add_cache(crowd, "throng pos", paths["pos"], "LINEAR", frame_start)
    instancer = _instancer_tree(cast, repertoire, variations)
    for name, hidden in (("throng people", "show_viewport"), ("throng people (viewport)", "show_render")):
        modifier = crowd.modifiers.new(name, "NODES")
        modifier.node_group = instancer
        set_input(modifier, "Share", 2.0)  # everybody
        setattr(modifier, hidden, False)
    crowd["throng_strides"] = list(bake.strides)
    crowd["throng_frame_start"], crowd["throng_offset"], crowd["throng_percent"] = frame_start, 0, 100.0
    return crowd


assert set(STREAMS) == {"pos", "dir", "state"}
