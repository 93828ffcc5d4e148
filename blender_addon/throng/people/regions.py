# SPDX-License-Identifier: Apache-2.0
"""Places on the base mesh, and fields over them that are positive inside of something: a sleeve, a neckline, the
scalp. One rule cuts everybody alike, whatever their shape. Metres on the base mesh, which stands with its hips at about
z = 0.05: the crown is at 0.85, the soles at -0.82."""
from functools import lru_cache

import numpy

X, Y, Z, ARM, HEAD = range(5)  # columns of places
ARM_LENGTH = 0.48              # m, from shoulder to wrist
_ARMS = ("upperarm", "lowerarm", "hand", "index", "middle", "ring", "pinky", "thumb")
# Height of the hairline by the angle from straight ahead.
_ANGLES = (0, 25, 42, 58, 75, 95, 112, 128, 150, 180)
# Heights, and how far from the middle a rucksack's strap is there.
_STRAP_UP = (0.235, 0.255, 0.280, 0.310, 0.345, 0.385, 0.43, 0.60)
_STRAP_ASIDE = (0.250, 0.185, 0.150, 0.128, 0.112, 0.102, 0.098, 0.092)
_LINE = (0.806, 0.803, 0.788, 0.760, 0.712, 0.745, 0.752, 0.695, 0.668, 0.655)


@lru_cache(maxsize=2)
def places_of(bodies):
    """(V, 5) of all vertices of the base mesh."""
    base = bodies.vertices
    arms = bodies.weights[:, [number for bone, number in bodies.bone.items() if bone.startswith(_ARMS)]].sum(axis=1)
    shoulder, elbow, hand = (bodies.joint(base, f"l-{name}") for name in ("shoulder", "elbow", "hand"))
    even = base * (1.0, 0.0, 1.0) + numpy.abs(base) * (0.0, 1.0, 0.0)
    upper, lower = elbow - shoulder, hand - elbow
    first, second = numpy.linalg.norm(upper), numpy.linalg.norm(lower)
    upper, lower = upper / first, lower / second
    along = numpy.where((even - elbow) @ (upper + lower) < 0.0, (even - shoulder) @ upper,
                        first + (even - elbow) @ lower) / (first + second)
    arm = numpy.where(arms > 0.5, numpy.maximum(along, 0.0), -1.0)
    return numpy.concatenate([base, arm[:, None], bodies.weights[:, [bodies.bone["head"]]]], axis=1)


def box(low, high, side=0.0):
    """The planes of a box, one field each, for cuts that are exact however large triangles are; on one side (1 left, -1
    right) y is the distance from the middle. None is infinite."""
    fields = [lambda places: but_arms(places, 1.0)]
    for axis in (X, Y, Z):
        sign = side if axis == Y and side else 1.0
        if low[axis] is not None:
            fields.append(lambda places, a=axis, s=sign: places[:, a] * s - low[a])
        if high[axis] is not None:
            fields.append(lambda places, a=axis, s=sign: high[a] - places[:, a] * s)
    return fields


def line(first, second):
    """Zero along a straight line through two places (y, z)."""
    (y, z), (dy, dz) = first, numpy.subtract(second, first) / numpy.hypot(*numpy.subtract(second, first))
    return lambda places: (places[:, Y] - y) * dz - (places[:, Z] - z) * dy


def strap(side):
    """Zero along the middle of a rucksack's strap: over the shoulder, down beside the breast, and under the arm to the
    back."""
    return lambda places: places[:, Y] * side - numpy.interp(places[:, Z], _STRAP_UP, _STRAP_ASIDE)


def on_trunk(places, value):
    """A field of the trunk, that arms are inside of."""
    return numpy.where(places[:, ARM] > 0.0, 1.0, value)


def but_arms(places, value):
    """A field of the trunk, that arms are outside of."""
    return numpy.where(places[:, ARM] > 0.0, -1.0, value)


def sleeve(places, until):
    return numpy.where(places[:, ARM] > 0.0, (until - places[:, ARM]) * ARM_LENGTH, 1.0)


def above(places, height):
    return on_trunk(places, places[:, Z] - height)


def below(places, height):
    return numpy.where(places[:, ARM] > 0.0, -1.0, height - places[:, Z])


def neckline(places, wide=1.0, deep=1.0):
    """Outside of an egg round the neck: a level cut would slice the shoulders, too."""
    egg = ((places[:, Y] / (0.074 * wide)) ** 2 + ((places[:, X] - 0.036) / (0.080 * wide)) ** 2
           + ((places[:, Z] - 0.615) / (0.062 * deep)) ** 2)
    return (numpy.sqrt(egg) - 1.0) * 0.065


def vee(places, bottom, slope=0.42):
    """Outside of a wedge before the chest that is widest at the neck."""
    inside = numpy.minimum(0.004 + slope * (places[:, Z] - bottom) - numpy.abs(places[:, Y]), places[:, X] - 0.03)
    return -numpy.where(places[:, ARM] > 0.0, -1.0, numpy.where(places[:, Z] > 0.66, -1.0, inside))


def gap(places, low, high, bottom):
    """Outside of an open front, so wide at the waist and at the neck."""
    share = numpy.clip((places[:, Z] - bottom) / (0.50 - bottom), 0.0, 1.2)
    inside = numpy.minimum(low + (high - low) * share - numpy.abs(places[:, Y]), places[:, X] - 0.02)
    return -numpy.where(places[:, ARM] > 0.0, -1.0, inside)


def angle_of(places):
    """Degrees from straight ahead, round the head."""
    return numpy.degrees(numpy.arctan2(numpy.abs(places[:, Y]), places[:, X] - 0.055))


def scalp(places, raised=0.0):
    """How far above the hairline."""
    field = places[:, Z] - numpy.interp(angle_of(places), _ANGLES, _LINE) - raised
    return numpy.minimum(field, (places[:, HEAD] - 0.5) * 0.2)


def ear(places):
    """Inside of an ear."""
    return numpy.minimum(numpy.minimum(numpy.abs(places[:, Y]) - 0.0705, 0.782 - places[:, Z]),
                         numpy.minimum(places[:, X] - 0.008, 0.086 - places[:, X]))


def brow(places):
    """Inside of the brows."""
    along = (numpy.abs(places[:, Y]) - 0.011) / 0.045
    middle = 0.7505 + 0.0062 * numpy.sin(numpy.clip(along, 0.0, 1.0) * 2.3) - 0.0035 * along
    half = numpy.interp(along, [-0.06, 0.08, 0.35, 0.75, 1.03], [0.0008, 0.0036, 0.0040, 0.0028, 0.0004])
    field = half - numpy.abs(places[:, Z] - middle)
    outside = numpy.minimum(along + 0.06, 1.03 - along) * 0.045
    return numpy.minimum(numpy.minimum(field, outside), places[:, X] - 0.08)


def beard(places, full=True):
    """Inside of a beard; else of a moustache and what is round the chin."""
    y = numpy.abs(places[:, Y])
    top = numpy.interp(y, [0.0, 0.022, 0.030, 0.055, 0.072, 0.085], [0.6840, 0.6825, 0.664, 0.668, 0.715, 0.740])
    mouth = 0.0080 - numpy.hypot((places[:, Z] - 0.6670) * 1.05, numpy.maximum(y - 0.017, 0.0))
    field = numpy.minimum(top - places[:, Z], places[:, Z] - 0.606)
    field = numpy.minimum(numpy.minimum(field, places[:, X] - 0.035), (places[:, HEAD] - 0.4) * 0.2)
    field = numpy.minimum(field, -ear(places))
    if not full:
        field = numpy.minimum(field, 0.034 - y)
    return numpy.minimum(field, -mouth)
