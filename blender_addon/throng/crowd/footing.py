# SPDX-License-Identifier: Apache-2.0
"""Crowds on ground that is not flat. Natively, as playback is: modifiers only, no Python when frames change.

Poses are made for flat ground. Where it slopes, people are sheared: whatever is at (x, y) of a person goes up by
slope_x x + slope_y y, so that feet follow the ground and bodies stay upright. Instances can only be turned and scaled,
but along the axes of the scene as well as their own, and every shear is a turn, a scale along the axes, and another
turn (its singular value decomposition).

The slopes are the attribute GROUND of everybody's point: along the heading, to the left of it, and the height of
the ground. A bake with a terrain brings them in its stream `ground`; for others, a modifier looks for the ground
below (tools/ground.py).
"""
from ..blender.nodes import Maths, new_tree, own_tree
from .names import CONFORM, GROUND

REACH = 0.3                       # m before and behind the body: about where planted feet are
HIGH = 1000.0                     # m over the point: where rays come from; they reach as far below
STEEPEST = 1.2
_GEOMETRY = [("Geometry", "NodeSocketGeometry")]


def _vector(maths, x=0.0, y=0.0, z=0.0):
    node = maths.node("ShaderNodeCombineXYZ")
    for slot, value in zip(node.inputs, (x, y, z)):
        if isinstance(value, (int, float)):
            slot.default_value = value
        else:
            maths.link(value, slot)
    return node.outputs[0]


def _lean_tree():
    name = "Throng ground lean"
    found = own_tree(name)
    if found:
        return found
    tree, inputs, outputs = new_tree(name, _GEOMETRY, _GEOMETRY)
    maths = Maths(tree)
    along, across, _ = maths.components(GROUND)
    heading = maths.components("throng_turn")[2]
    uphill = maths.math("ADD", heading, maths.math("ARCTAN2", across, along))
    slope = maths.math("SQRT", maths.math("MULTIPLY_ADD", along, along, maths.math("MULTIPLY", across, across)))
    # In the plane of uphill and up, the shear is [1 0; k 1] = turn(out) scale(large, 1 / large) turn(-into).
    half = maths.math("MULTIPLY", slope, 0.5)
    root = maths.math("SQRT", maths.math("MULTIPLY_ADD", half, half, 1.0))
    into = maths.math("MULTIPLY", maths.math("ARCTAN2", 2.0, slope), 0.5)
    out = maths.math("MULTIPLY", maths.math("ARCTAN2", 2.0, maths.math("MULTIPLY", slope, -1.0)), 0.5)

    place = maths.node("GeometryNodeInputPosition").outputs[0]
    geometry = inputs.outputs[0]

    def turn(geometry, x=0.0, y=0.0, z=0.0):
        node = maths.node("GeometryNodeRotateInstances")
        node.inputs["Local Space"].default_value = False
        maths.link(geometry, node.inputs["Instances"])
        maths.link(_vector(maths, x, y, z), node.inputs["Rotation"])
        maths.link(place, node.inputs["Pivot Point"])
        return node.outputs[0]

    geometry = turn(geometry, z=maths.math("MULTIPLY", uphill, -1.0))
    geometry = turn(geometry, y=into)
    scale = maths.node("GeometryNodeScaleInstances")
    scale.inputs["Local Space"].default_value = False
    maths.link(geometry, scale.inputs["Instances"])
    maths.link(_vector(maths, maths.math("ADD", root, half), 1.0, maths.math("SUBTRACT", root, half)),
               scale.inputs["Scale"])
    maths.link(place, scale.inputs["Center"])
    geometry = turn(scale.outputs[0], y=maths.math("MULTIPLY", out, -1.0), z=uphill)
    maths.link(geometry, outputs.inputs[0])
    return tree


def slopes(crowd):
    """Whether a crowd's ground slopes: flat ones are spared the work."""
    return "throng ground" in crowd.modifiers or CONFORM in crowd.modifiers


def leaning(maths, instances):
    """Nodes that let instances follow the slopes in the attribute GROUND; they are turned by `throng_turn`."""
    group = maths.node("GeometryNodeGroup")
    group.node_tree = _lean_tree()
    maths.link(instances, group.inputs[0])
    return group.outputs[0]


def _ray(maths, target, origin, offset=None):
    """What lies below a place: (whether there is anything, its height, its normal)."""
    if offset is not None:
        add = maths.node("ShaderNodeVectorMath", operation="ADD")
        maths.link(origin, add.inputs[0])
        maths.link(offset, add.inputs[1])
        origin = add.outputs[0]
    ray = maths.node("GeometryNodeRaycast")
    maths.link(target, ray.inputs["Target Geometry"])
    maths.link(origin, ray.inputs["Source Position"])
    maths.link(_vector(maths, z=-1.0), ray.inputs["Ray Direction"])
    ray.inputs["Ray Length"].default_value = 2.0 * HIGH
    height = maths.node("ShaderNodeSeparateXYZ")
    maths.link(ray.outputs["Hit Position"], height.inputs[0])
    return ray.outputs["Is Hit"], height.outputs[2], ray.outputs["Hit Normal"]


def _either(maths, hit, value, otherwise):
    """`value` where something was hit."""
    return maths.math("ADD", maths.math("MULTIPLY", hit, value),
                      maths.math("MULTIPLY", maths.math("SUBTRACT", 1.0, hit), otherwise))


def _footing(maths, ground):
    """Of every point, by three rays on an object's geometry: its place, whether there is ground, its slopes and height,
    and the mean height under the feet."""
    info = maths.node("GeometryNodeObjectInfo", transform_space="RELATIVE")
    maths.link(ground, info.inputs["Object"])
    target = info.outputs["Geometry"]
    cosine, sine, _ = maths.components("throng_dir")
    place = maths.node("ShaderNodeSeparateXYZ")
    maths.link(maths.node("GeometryNodeInputPosition").outputs[0], place.inputs[0])
    above = _vector(maths, place.outputs[0], place.outputs[1], maths.math("ADD", place.outputs[2], HIGH))
    forward = [maths.math("MULTIPLY", part, REACH) for part in (cosine, sine)]
    hit, height, normal = _ray(maths, target, above)
    ahead_hit, ahead, _ = _ray(maths, target, above, _vector(maths, *forward))
    behind_hit, behind, _ = _ray(maths, target, above,
                                 _vector(maths, *(maths.math("MULTIPLY", part, -1.0) for part in forward)))
    ahead, behind = _either(maths, ahead_hit, ahead, height), _either(maths, behind_hit, behind, height)
    mean = maths.math("MULTIPLY",
                      maths.math("ADD", maths.math("MULTIPLY", height, 2.0), maths.math("ADD", ahead, behind)), 0.25)
    parts = maths.node("ShaderNodeSeparateXYZ")
    maths.link(normal, parts.inputs[0])
    down = maths.math("MAXIMUM", maths.math("ABSOLUTE", parts.outputs[2]), 0.05)
    left = maths.math("SUBTRACT", maths.math("MULTIPLY", parts.outputs[0], sine),
                      maths.math("MULTIPLY", parts.outputs[1], cosine))
    sign = maths.math("SIGN", parts.outputs[2])  # meshes may be inside out
    slopes = [maths.math("DIVIDE", maths.math("SUBTRACT", ahead, behind), 2.0 * REACH),
              maths.math("MULTIPLY", maths.math("DIVIDE", left, down), sign)]
    slopes = [maths.math("MULTIPLY", hit, maths.math("MAXIMUM", maths.math("MINIMUM", slope, STEEPEST), -STEEPEST))
              for slope in slopes]
    return place.outputs, hit, _vector(maths, *slopes, height), mean


def _stand(maths, geometry, ground, over=0.0):
    """Points on an object's geometry, `over` metres above it, with the slopes there; where there is none they stay."""
    place, hit, slopes, mean = _footing(maths, ground)
    stand = maths.node("GeometryNodeSetPosition")
    maths.link(maths.store(geometry, GROUND, slopes, "FLOAT_VECTOR"), stand.inputs["Geometry"])
    maths.link(_vector(maths, place[0], place[1], _either(maths, hit, maths.math("ADD", mean, over), place[2])),
               stand.inputs["Position"])
    return stand.outputs[0]


def stand_anew(maths, geometry, ground, who, over):
    """Lets only those points stand on an object's geometry where the attribute `who` is 1: rays cost time, so the
    others are set apart."""
    apart = maths.node("GeometryNodeSeparateGeometry", domain="POINT")
    maths.link(geometry, apart.inputs["Geometry"])
    maths.link(maths.greater(maths.attribute(who), 0.5), apart.inputs["Selection"])
    join = maths.node("GeometryNodeJoinGeometry")
    maths.link(_stand(maths, apart.outputs["Selection"], ground, over), join.inputs[0])
    maths.link(apart.outputs["Inverted"], join.inputs[0])
    return join.outputs[0]


def conform_tree():
    name = "Throng conform to ground"
    found = own_tree(name)
    if found:
        return found
    tree, inputs, outputs = new_tree(name, _GEOMETRY + [("Ground", "NodeSocketObject")], _GEOMETRY)
    maths = Maths(tree)
    maths.link(_stand(maths, inputs.outputs["Geometry"], inputs.outputs["Ground"]), outputs.inputs[0])
    return tree
