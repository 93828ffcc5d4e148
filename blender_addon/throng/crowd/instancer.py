# SPDX-License-Identifier: Apache-2.0
"""The instancer: nodes that put a pose of their figure on every vertex that is alive."""
import bpy

from ..blender.nodes import Maths, new_tree
from ..cast import LEVEL_BEATS, LEVEL_POSES
from ..cast.library import shown_figures
from . import footing
from .names import BIGGER, COARSE, FIGURE, HIDDEN, LEVEL, NATURE, NEAR
from .near import boned_members, near_tree
from .pose_lists import list_of
from .poses import member_in, pose_index

BUNCHES = (4, 4, 12)  # figures that share a node at each level, from 4.0 on
_COARSEST = 2  # the level of those who are far away on the screen
_GEOMETRY = [("Geometry", "NodeSocketGeometry")]
_INPUTS = _GEOMETRY + [("Share", "NodeSocketFloat"), ("Blur", "NodeSocketBool")]


def _present(maths, alive, nature, share):
    """1 for whoever is there, shown and not culled."""
    # HIDDEN is zero where nothing is culled
    seen = maths.math("SUBTRACT", maths.math("LESS_THAN", nature[2], share), maths.attribute(HIDDEN))
    return maths.math("GREATER_THAN", maths.math("MULTIPLY", maths.math("GREATER_THAN", alive, 0.5), seen), 0.5)


def _levels_of(maths, levels, member, bent, blurs):
    """Everybody's level. @param bent how many members have no poses at level 0; @param blurs false on the screen"""
    if len(levels) == 1:
        return float(levels[0])
    level = maths.attribute(LEVEL)
    if not bent:
        return level
    far = maths.math("GREATER_THAN", maths.attribute(COARSE), _COARSEST + 0.5)
    coarsest = maths.math("MULTIPLY", maths.math("MULTIPLY", far, float(_COARSEST)), maths.math("SUBTRACT", 1.0, blurs))
    level = maths.math("MAXIMUM", level, maths.math("LESS_THAN", member, bent - 0.5))
    return maths.math("MAXIMUM", level, coarsest)


def _figure_number(level, member):
    """How points say which figure they show. 0 is nobody."""
    return 1 + 1000 * level + member


def _poses(maths, level, levels, pose_at):
    """Everybody's pose at their level. @param pose_at (level), which is worked out once for levels with the same"""
    alike = {}
    for each in levels:
        alike.setdefault((LEVEL_POSES[each], LEVEL_BEATS[each]), each)
    first, *others = alike.values()
    pose = pose_at(first)
    for each in others:  # it is of the coarser ones from there on
        change = maths.math("SUBTRACT", pose_at(each), pose)
        pose = maths.math("MULTIPLY_ADD", maths.math("GREATER_THAN", level, each - 0.5), change, pose)
    return pose


def instancer_tree(cast, repertoire, leans, near=None, streams=(), most_close=0):
    """An Instance on Points for each bunch of the cast's figures; those who are near are made by a group of their own
    (near.py), the object `near` has the bones of its members, which then need no poses at level 0. What is needed is
    filed away on the points: worked out for all at once, not by every bunch. `streams` are those that the
    points have beside those of every bake, `most_close` is of near.near_tree().

    Each bunch picks from a list of poses that is there once and for all (pose_lists.py).

    While a crowd is on screen, Blender notes down all attributes of what goes through a socket, those of every pose
    included, which takes longer than the work itself. From 4.0 on it does so for sockets outside of groups only, so
    there all is in a group; before for all, so there should be few. And later versions look up every pose among those
    before it, in time that grows with their square: there bunches are small, and the people of each are handed on as
    one instance. Who is far away on the screen takes the few poses of the coarsest level (near.py).
    """
    bent = len(boned_members(cast)) if near else 0
    figures = {(level, member): thing for (level, member), thing in shown_figures(cast).items()
               if level > 0 or member >= bent}
    levels = sorted({level for level, _ in figures})
    tree, inputs, outputs = new_tree("Throng instancer", _INPUTS, _GEOMETRY)
    maths, blurs = Maths(tree), inputs.outputs["Blur"]
    cosine, sine, speed = maths.components("throng_dir")
    state, variation, phase = maths.components("throng_state")
    nature = maths.components(NATURE)
    points, people, share = inputs.outputs[0], [], inputs.outputs["Share"]
    member, there = member_in(maths, cast, variation), _present(maths, state, nature, share)
    if near:
        near_ones = maths.math("MULTIPLY", maths.math("GREATER_THAN", maths.attribute(NEAR), 0.5), there)
        if bent < cast["throng_variations"]:  # others who joined have poses only
            near_ones = maths.math("MULTIPLY", near_ones, maths.math("LESS_THAN", member, bent - 0.5))
        apart = maths.node("GeometryNodeSeparateGeometry", domain="POINT")
        maths.link(points, apart.inputs["Geometry"])
        maths.link(maths.greater(near_ones, 0.5), apart.inputs["Selection"])
        group = maths.node("GeometryNodeGroup")
        group.node_tree = near_tree(cast, repertoire, near, streams, most_close)
        maths.link(apart.outputs["Selection"], group.inputs[0])
        maths.link(blurs, group.inputs["Blur"])
        people = [maths.where(maths.any_of(points, near_ones), group.outputs[0], None)]
        there = maths.math("SUBTRACT", there, near_ones)
    rotation = maths.node("ShaderNodeCombineXYZ")
    maths.link(maths.math("ARCTAN2", sine, cosine), rotation.inputs[2])
    level = _levels_of(maths, levels, member, bent, blurs)
    figure = maths.math("ADD", 1.0, maths.math("MULTIPLY_ADD", level, 1000.0, member))  # _figure_number
    pose = _poses(maths, level, levels, lambda each: pose_index(maths, speed, state, phase, nature, repertoire, each))
    points = maths.store(points, FIGURE, maths.math("MULTIPLY", figure, there), "INT")
    points = maths.store(points, "throng_pose", pose, "INT")
    points = maths.store(points, "throng_turn", rotation.outputs[0], "FLOAT_VECTOR")
    # instances need not carry them along
    for spare in ("throng_dir", "throng_state", NATURE, *(f"throng_{each}" for each in streams)):
        remove = maths.node("GeometryNodeRemoveAttribute")
        remove.inputs["Name"].default_value = spare
        maths.link(points, remove.inputs[0])
        points = remove.outputs[0]

    apart = bpy.app.version >= (4, 0, 0)
    people += _instances(maths, points, cast, figures, leans, apart, repertoire)
    maths.link(_together(maths, people), outputs.inputs[0])
    return _wrapped(tree) if apart else tree


def _wrapped(tree):
    """A tree that is nothing but another as a group."""
    outer, inputs, outputs = new_tree("Throng crowd", _INPUTS, _GEOMETRY)
    inside = outer.nodes.new("GeometryNodeGroup")
    inside.node_tree = tree
    for given, slot in zip(inputs.outputs, inside.inputs):
        outer.links.new(given, slot)
    outer.links.new(inside.outputs[0], outputs.inputs[0])
    return outer


def _together(maths, geometries):
    if len(geometries) == 1:
        return geometries[0]
    join = maths.node("GeometryNodeJoinGeometry")
    for geometry in geometries:
        maths.link(geometry, join.inputs[0])
    return join.outputs[0]


def _instances(maths, points, cast, figures, leans, apart, repertoire):
    """Everybody's pose, as one geometry for each level. @param apart whether the people of each bunch are one
    instance"""
    levels = sorted({level for level, _ in figures})
    if len(levels) == 1:
        return [_instances_of(maths, points, cast, figures, leans, apart, repertoire)]
    found, figure = [], maths.attribute(FIGURE, "INT")
    for number in levels:
        own = {(level, member): thing for (level, member), thing in figures.items() if level == number}
        last = max(member for _, member in own)
        some = maths.between(figure, _figure_number(number, 0), _figure_number(number, last))
        people = _instances_of(maths, points, cast, own, leans, apart, repertoire)
        found.append(maths.where(maths.any_of(points, some), people, None))
    return found


def _bunches(figures):
    """Figures of one level whose numbers follow each other, so many at a time."""
    level = next(iter(figures))[0]
    most = BUNCHES[level] if bpy.app.version >= (4, 0, 0) else len(figures)
    found = []
    for (level, member), thing in sorted(figures.items()):
        if not found or len(found[-1]) == most or (level, member - 1) != found[-1][-1][0]:
            found.append([])
        found[-1].append(((level, member), thing))
    return found


def _instances_of(maths, points, cast, figures, leans, apart, repertoire):
    """The people of some figures, a bunch of these at a time."""
    figure, pose, turn = (maths.attribute(name, kind)
                          for name, kind in ((FIGURE, "INT"), ("throng_pose", "INT"), ("throng_turn", "FLOAT_VECTOR")))
    size, everybody = maths.math("ADD", maths.attribute(BIGGER), 1.0), []
    for bunch in _bunches(figures):
        (level, first), (_, last) = bunch[0][0], bunch[-1][0]
        place = maths.node("GeometryNodeInstanceOnPoints")
        place.inputs["Pick Instance"].default_value = True
        maths.link(points, place.inputs["Points"])
        maths.link(maths.between(figure, _figure_number(level, first), _figure_number(level, last)),
                   place.inputs["Selection"])
        maths.link(maths.geometry_of(list_of(cast, [thing for _, thing in bunch])), place.inputs["Instance"])
        before = maths.math("SUBTRACT", figure, float(_figure_number(level, first)))
        maths.link(maths.math("MULTIPLY_ADD", before, float(repertoire.poses(level)), pose),
                   place.inputs["Instance Index"])
        maths.link(size, place.inputs["Scale"])
        maths.link(turn, place.inputs["Rotation"])  # the points' other attributes go along: id, tint
        people = footing.leaning(maths, place.outputs[0]) if leans else place.outputs[0]
        if apart:
            one = maths.node("GeometryNodeGeometryToInstance")
            maths.link(people, one.inputs[0])
            people = one.outputs[0]
        everybody.append(people)
    return _together(maths, everybody)
