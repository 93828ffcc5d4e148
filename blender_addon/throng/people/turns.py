# SPDX-License-Identifier: Apache-2.0
"""Turns and vectors of many poses at once."""
import numpy

# Vectors are (..., 3) and turns (..., 3, 3): of one pose, or of many at once.


def vector(*parts):
    return numpy.stack(numpy.broadcast_arrays(*parts), axis=-1)


def cross(one, other):
    """As numpy.cross, in a tenth of the time."""
    (a, b, c), (x, y, z) = numpy.moveaxis(one, -1, 0), numpy.moveaxis(other, -1, 0)
    return vector(b * z - c * y, c * x - a * z, a * y - b * x)


def length(value):
    return numpy.sqrt((value * value).sum(axis=-1))


def turned(turns, value):
    """Vectors, turned."""
    return (turns @ value[..., None])[..., 0]


def turn(axis, angle):
    """What turns by an angle about an axis."""
    x, y, z = numpy.moveaxis(numpy.asarray(axis) / numpy.maximum(length(axis), 1e-12)[..., None], -1, 0)
    s, c = numpy.sin(angle), numpy.cos(angle)
    d = 1.0 - c
    return numpy.stack([vector(c + d * x * x, d * x * y - s * z, d * x * z + s * y),
                        vector(d * x * y + s * z, c + d * y * y, d * y * z - s * x),
                        vector(d * x * z - s * y, d * y * z + s * x, c + d * z * z)], axis=-2)


def frame(along, hinge):
    """Axes: along a bone, about its hinge, and across both."""
    along = along / length(along)[..., None]
    hinge = hinge - along * (hinge * along).sum(axis=-1)[..., None]
    hinge = hinge / length(hinge)[..., None]
    return numpy.stack([along, hinge, cross(along, hinge)], axis=-1)
