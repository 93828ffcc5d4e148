# SPDX-License-Identifier: Apache-2.0
"""Vectors, as nodes."""


def vector(maths, operation, *values):
    node = maths.node("ShaderNodeVectorMath", operation=operation)
    for slot, value in zip(node.inputs, values):
        maths.feed(value, slot)
    return node.outputs["Value" if operation in ("DISTANCE", "DOT_PRODUCT", "LENGTH") else 0]


def scaled(maths, value, factor):
    node = maths.node("ShaderNodeVectorMath", operation="SCALE")
    maths.link(value, node.inputs[0])
    maths.feed(factor, node.inputs["Scale"])
    return node.outputs[0]


def combined(maths, *values):
    node = maths.node("ShaderNodeCombineXYZ")
    for slot, value in zip(node.inputs, values):
        maths.feed(value, slot)
    return node.outputs[0]


def between(maths, one, other, share):
    return vector(maths, "ADD", one, scaled(maths, vector(maths, "SUBTRACT", other, one), share))


def parts(maths, value):
    node = maths.node("ShaderNodeSeparateXYZ")
    maths.link(value, node.inputs[0])
    return node.outputs


def rotated(maths, value, axis, angle, centre=None):
    node = maths.node("ShaderNodeVectorRotate", rotation_type="AXIS_ANGLE")
    for name, given in (("Vector", value), ("Axis", axis), ("Angle", angle), ("Center", centre)):
        if given is not None:
            maths.feed(given, node.inputs[name])
    return node.outputs[0]


def index(maths):
    return maths.node("GeometryNodeInputIndex").outputs[0]


def place(maths):
    return maths.node("GeometryNodeInputPosition").outputs[0]
