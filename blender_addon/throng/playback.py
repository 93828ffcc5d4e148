# SPDX-License-Identifier: Apache-2.0
"""Native playback: one object of loose vertices, a stack of modifiers, no Python at render time.

Each Mesh Cache modifier overwrites the vertices with one stream, and a node group behind it files them away as an attribute; the
last one leaves the positions. The instancer then puts a pose on every vertex that is alive. `state` is read without interpolation,
because a pose index between two others would be a third one, and must not change while the shutter is open.
"""
import random

import bpy

from . import ground
from .cast import LEVEL_BEATS, LEVEL_POSES
from .cast.library import shown_figures
from .characters.members import pick, repertoire_of
from .culling import HIDDEN
from .formats import STREAMS
from .nodes import Maths, drop_tree, get_input, new_tree, set_input, socket

STANDING_SPEED = 0.1    # m/s: slower people stand
FRAMES_A_ROUND = 80.0   # of a standing clip
NATURE = "throng_nature"
LEVEL = "throng_level"  # of detail, of each person; see levels.py
FIGURE = "throng_figure"
INSTANCERS = ("throng people", "throng people (viewport)")
BIGGER = "throng_bigger"  # how much larger than 1 somebody's scale is; nobody's where there is no such attribute
GEOMETRY = [("Geometry", "NodeSocketGeometry")]


def _store_tree(attribute):
    tree, inputs, outputs = new_tree(f"Throng store {attribute}", GEOMETRY, GEOMETRY)
    maths = Maths(tree)
    position = maths.node("GeometryNodeInputPosition").outputs[0]
    maths.link(maths.store(inputs.outputs[0], attribute, position, "FLOAT_VECTOR"), outputs.inputs[0])
    return tree


def _components(maths, attribute):
    separate = maths.node("ShaderNodeSeparateXYZ")
    maths.link(maths.attribute(attribute, "FLOAT_VECTOR"), separate.inputs[0])
    return separate.outputs


def _walking_pose(maths, state, phase, poses, first):
    """The gait is what `state` adds to the activity, in sixteenths; the pose is the phase's.

    @param first the number of the cast's first gait; nobody walks with those that it has not
    """
    gait = maths.math("ROUND", maths.math("MULTIPLY", maths.math("FRACT", state), 16.0))
    if first:
        gait = maths.math("SUBTRACT", gait, float(first))
    step = maths.math("MINIMUM", maths.math("FLOOR", maths.math("MULTIPLY", maths.math("FRACT", phase), poses)), poses - 1)
    return maths.math("MULTIPLY_ADD", gait, poses, step)


def _standing_pose(maths, state, nature, beats, walking):
    """Those who gather talk, shift their weight or look at their phones, one in four each; others who stand only shift.

    The beat follows the frame, rounded, so that it does not change while the shutter is open; everybody has their own.
    """
    gathers = maths.math("COMPARE", maths.math("FLOOR", state), 2.0, 0.1)
    clip = maths.math("MODULO", nature[0], maths.math("MULTIPLY_ADD", gathers, 2.0, 2.0))
    if beats == 1:
        return maths.math("ADD", clip, walking)
    frame = maths.math("ROUND", socket(maths.node("GeometryNodeInputSceneTime").outputs, "Frame"))
    rounds = maths.math("ADD", nature[1], maths.math("DIVIDE", frame, FRAMES_A_ROUND))
    beat = maths.math("FLOOR", maths.math("MULTIPLY", maths.math("FRACT", rounds), beats))
    return maths.math("ADD", maths.math("MULTIPLY_ADD", clip, beats, walking), beat)


def _pose_index(maths, speed, state, phase, nature, repertoire, level):
    walks = maths.math("GREATER_THAN", speed, STANDING_SPEED)
    walking = _walking_pose(maths, state, phase, LEVEL_POSES[level], repertoire.first)
    standing = _standing_pose(maths, state, nature, LEVEL_BEATS[level], repertoire.walking(level))
    return maths.math("ADD", maths.math("MULTIPLY", walking, walks), maths.math("MULTIPLY", standing, maths.math("SUBTRACT", 1.0, walks)))


def _present(maths, alive, nature, share):
    """1 for whoever is there, shown and not culled."""
    seen = maths.math("SUBTRACT", maths.math("LESS_THAN", nature[2], share), maths.attribute(HIDDEN))  # HIDDEN is zero where nothing is culled
    return maths.math("GREATER_THAN", maths.math("MULTIPLY", maths.math("GREATER_THAN", alive, 0.5), seen), 0.5)


def _chosen(maths, levels, values):
    """Of values by level those of everybody's own level."""
    if len(levels) == 1:
        return values[0]
    level, total = maths.attribute(LEVEL), 0.0
    for number, value in zip(levels, values):
        total = maths.math("MULTIPLY_ADD", value, maths.math("COMPARE", level, float(number), 0.5), total)
    return total


def _figure_number(level, member):
    """How points say which figure they show. 0 is nobody."""
    return 1 + 1000 * level + member


def _figures_and_poses(maths, state, phase, speed, variation, nature, repertoire, levels):
    """Everybody's figure (_figure_number), and which of its poses."""
    poses = [_pose_index(maths, speed, state, phase, nature, repertoire, level) for level in levels]
    figures = [maths.math("ADD", variation, float(_figure_number(level, 0))) for level in levels]
    return _chosen(maths, levels, figures), _chosen(maths, levels, poses)


def _instancer_tree(cast, repertoire, leans):
    """One Instance on Points for each figure of the cast. What it needs is filed away on the points: worked out for all at once, not by every figure.

    While a crowd is on screen, Blender notes down all attributes of what goes through a socket, those of every pose included, which takes
    longer than the work itself. From 4.0 on it does so for sockets outside of groups only, so there the figures are in a group; before for all, so
    there should be few. And later versions look up every pose among those before it, in time that grows with their square: there each figure's people
    are handed on as one instance.
    """
    figures = shown_figures(cast)
    levels = sorted({level for level, _ in figures})
    tree, inputs, outputs = new_tree("Throng instancer", GEOMETRY + [("Share", "NodeSocketFloat")], GEOMETRY)
    maths = Maths(tree)
    cosine, sine, speed = _components(maths, "throng_dir")
    state, variation, phase = _components(maths, "throng_state")
    nature = _components(maths, NATURE)
    variation = pick(maths, variation, cast["throng_drawn"], cast["throng_variations"])
    rotation = maths.node("ShaderNodeCombineXYZ")
    maths.link(maths.math("ARCTAN2", sine, cosine), rotation.inputs[2])
    figure, pose = _figures_and_poses(maths, state, phase, speed, variation, nature, repertoire, levels)
    there = _present(maths, state, nature, inputs.outputs["Share"])
    points = maths.store(inputs.outputs[0], FIGURE, maths.math("MULTIPLY", figure, there), "INT")
    points = maths.store(points, "throng_pose", pose, "INT")
    points = maths.store(points, "throng_turn", rotation.outputs[0], "FLOAT_VECTOR")
    for spare in ("throng_dir", "throng_state", NATURE):  # instances need not carry them along
        remove = maths.node("GeometryNodeRemoveAttribute")
        remove.inputs["Name"].default_value = spare
        maths.link(points, remove.inputs[0])
        points = remove.outputs[0]

    if bpy.app.version < (4, 0, 0):
        maths.link(_instances(maths, points, figures, leans, apart=False), outputs.inputs[0])
        return tree
    inside = maths.node("GeometryNodeGroup")
    inside.node_tree, inner_inputs, inner_outputs = new_tree("Throng figures", GEOMETRY, GEOMETRY)
    within = Maths(inside.node_tree)
    within.link(_instances(within, inner_inputs.outputs[0], figures, leans, apart=True), inner_outputs.inputs[0])
    maths.link(points, inside.inputs[0])
    maths.link(inside.outputs[0], outputs.inputs[0])
    return tree


def _instances(maths, points, figures, leans, apart):
    """Everybody's pose. @param apart whether the people of each figure are one instance"""
    figure, pose, turn = (maths.attribute(name, kind) for name, kind in ((FIGURE, "INT"), ("throng_pose", "INT"), ("throng_turn", "FLOAT_VECTOR")))
    size = maths.math("ADD", maths.attribute(BIGGER), 1.0)
    everybody = maths.node("GeometryNodeJoinGeometry")
    for (level, member), thing in figures.items():
        poses = maths.node("GeometryNodeObjectInfo", transform_space="ORIGINAL")
        poses.inputs["Object"].default_value = thing
        place = maths.node("GeometryNodeInstanceOnPoints")
        place.inputs["Pick Instance"].default_value = True
        maths.link(points, place.inputs["Points"])
        maths.link(maths.equal(figure, _figure_number(level, member)), place.inputs["Selection"])
        maths.link(socket(poses.outputs, "Geometry"), place.inputs["Instance"])
        maths.link(pose, place.inputs["Instance Index"])
        maths.link(size, place.inputs["Scale"])
        maths.link(turn, place.inputs["Rotation"])  # the points' other attributes go along: id, tint
        people = ground.leaning(maths, place.outputs[0]) if leans else place.outputs[0]
        if apart:
            one = maths.node("GeometryNodeGeometryToInstance")
            maths.link(people, one.inputs[0])
            people = one.outputs[0]
        maths.link(people, everybody.inputs[0])
    return everybody.outputs[0]


def set_cast(crowd, cast):
    """Lets a crowd show the figures of a cast as they are now: call it again after some have come or gone."""
    crowd["throng_cast"] = cast
    modifiers = [crowd.modifiers[name] for name in INSTANCERS]
    before = modifiers[0].node_group
    shares = [get_input(modifier, "Share") if modifier.node_group else 2.0 for modifier in modifiers]  # 2: everybody
    tree = _instancer_tree(cast, repertoire_of(crowd), ground.slopes(crowd))
    for modifier, share in zip(modifiers, shares):
        modifier.node_group = tree
        set_input(modifier, "Share", share)
    drop_tree(before)
    crowd.update_tag()


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


def build_crowd(bake, name, cast, frame_start, paths):
    """The crowd's object. `paths` are the streams' files as Blender shall store them, by stream."""
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(bake.agents)
    give_natures(mesh)
    crowd = bpy.data.objects.new(name, mesh)
    for stream in (each for each in ("state", "dir", "ground") if each in paths):
        _add_cache(crowd, f"throng {stream}", paths[stream], "NONE" if stream == "state" else "LINEAR", frame_start)
        modifier = crowd.modifiers.new(f"throng {stream} to attribute", "NODES")
        modifier.node_group = _store_tree(f"throng_{stream}")
    _add_cache(crowd, "throng pos", paths["pos"], "LINEAR", frame_start)
    for name, hidden in zip(INSTANCERS, ("show_viewport", "show_render")):
        setattr(crowd.modifiers.new(name, "NODES"), hidden, False)
    crowd["throng_strides"], cast["throng_gaits"] = list(bake.strides), list(bake.gaits)
    cast["throng_drawn"], cast["throng_shipped"] = bake.variations, cast["throng_variations"]
    crowd["throng_frame_start"], crowd["throng_offset"], crowd["throng_percent"] = frame_start, 0, 100.0
    set_cast(crowd, cast)
    return crowd


assert set(STREAMS) == {"pos", "dir", "state"}
