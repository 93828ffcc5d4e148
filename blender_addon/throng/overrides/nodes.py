# SPDX-License-Identifier: Apache-2.0
"""Nodes that read from attributes of the crowd's points what is changed about people, and play them so."""
from ..blender.nodes import Maths, new_tree, own_tree
from ..crowd.footing import stand_anew

STANDS = "throng_stands"  # 1 for whoever the bake has no ground for: moved, or at another time
_GEOMETRY = [("Geometry", "NodeSocketGeometry")]


def _state_nodes(maths, geometry):
    """Who hides is not there; who is swapped has another variation (-1: its own)."""
    state = maths.components("throng_state")
    swap = maths.attribute("throng_swap", "FLOAT")
    swapped = maths.math("GREATER_THAN", swap, -0.5)
    kept = maths.math("MULTIPLY", state[1], maths.math("SUBTRACT", 1.0, swapped))
    combine = maths.node("ShaderNodeCombineXYZ")
    maths.link(maths.math("MULTIPLY", state[0], maths.math("SUBTRACT", 1.0, maths.attribute("throng_hide", "FLOAT"))),
               combine.inputs[0])
    maths.link(maths.math("MULTIPLY_ADD", swap, swapped, kept), combine.inputs[1])
    maths.link(state[2], combine.inputs[2])
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
    maths.link(turned(maths.node("GeometryNodeInputPosition").outputs[0],
                      maths.attribute("throng_pivot", "FLOAT_VECTOR")), place.inputs["Position"])
    return maths.store(place.outputs[0], "throng_dir", turned(maths.attribute("throng_dir", "FLOAT_VECTOR")),
                       "FLOAT_VECTOR", only="throng_moved")


def overrides_tree(parts):
    """The nodes for those of the parts state, turn, move, retimed and ground that somebody needs."""
    name = "Throng overrides: " + ", ".join(sorted(parts))
    found = own_tree(name)
    if found:
        return found
    objects = [(socket_name, "NodeSocketObject") for part, socket_name in (("retimed", "Retimed"), ("ground", "Ground"))
               if part in parts]
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
        height = maths.components("throng_move")[2]
        geometry = stand_anew(maths, geometry, inputs.outputs["Ground"], STANDS, height)
    maths.link(geometry, outputs.inputs[0])
    return tree
