# SPDX-License-Identifier: Apache-2.0
"""Feet of people near the camera are held where they came down.

Where a clip has the feet is right for who walks straight on; who turns, drifts aside, sets off or stops would slide. A
bake that was asked for it (`--feet`) says of each foot how far it has to be moved, turned and lifted (docs/bake.md).
Here legs follow: the foot goes where it has to, and the knee bends the way it did, as much as is needed (two-bone
inverse kinematics). Where a leg is too short for that, the whole body sinks, as people's do in long steps.
"""
from ..blender.vectors import combined, index, parts, rotated, scaled, vector
from ..cast import bones
from ..formats import FEET
from .names import BONE

FOOT_MOVES = tuple(f"throng_{foot}" for foot in FEET)  # of points: as the streams have them
TURN_STEPS = 512.0   # of a radian, in the streams
STRETCHED = 0.9995   # of its length is as long as a leg gets
SINKS = 0.15         # m, at most
BENDS = 0.01         # m: how far knees are ahead of straight legs, for the direction in which these bend
_SIDE, _PART = "throng_side", "throng_part"  # of a leg: 0 left, 1 right; and _PARTS of a leg
_PARTS = 4  # thigh, calf, foot, and what does not belong to legs
_SINKS = "throng_sinks"
_CENTRE, _TURNS, _SHIFT = "throng_centre", "throng_turns", "throng_shift"
_HIP, _KNEE, _ANKLE, _KNEE_TO, _ANKLE_TO = (f"throng_{name}" for name in ("hip", "knee", "ankle", "knee_to",
                                                                          "ankle_to"))


def _copies(maths, points, count, name):
    node = maths.node("GeometryNodeDuplicateElements", domain="POINT")
    maths.link(points, node.inputs["Geometry"])
    node.inputs["Amount"].default_value = count
    return maths.store(node.outputs["Geometry"], name, node.outputs["Duplicate Index"], "INT")


def _joint(maths, all_, number):
    """Where a joint of everybody's leg is: 0 hip, 1 knee, 2 ankle. At points of legs."""
    side = maths.attribute(_SIDE, "INT")
    left, right = all_.limbs[number], all_.limbs[4 + number]
    person = maths.math("FLOOR", maths.math("DIVIDE", maths.math("ADD", index(maths), 0.5), 2.0))
    bone = maths.math("MULTIPLY_ADD", side, float(right - left), float(left))
    return all_.joint(maths, person, bone, maths.math("MULTIPLY_ADD", side, 3.0, float(number)))


def _from_to(maths, one, other):
    """What turns one vector into the direction of another: about that axis, by as many radians as it is long."""
    axis = vector(maths, "CROSS_PRODUCT", one, other)
    sine = vector(maths, "LENGTH", axis)
    angle = maths.math("ARCTAN2", sine, vector(maths, "DOT_PRODUCT", one, other))
    return scaled(maths, axis, maths.math("DIVIDE", angle, maths.math("MAXIMUM", sine, 1e-9)))


def _across(maths, value, direction):
    """What of a vector is at right angles to a direction."""
    return vector(maths, "SUBTRACT", value,
                  scaled(maths, direction, vector(maths, "DOT_PRODUCT", value, direction)))


def _legs(maths, people, all_, placed):
    """A point for each leg: the left one of the first person, the right one, the left one of the second ...; with
    where its joints are, and where knee and ankle have to be."""
    legs = _copies(maths, people, 2, _SIDE)
    for number, name in enumerate((_HIP, _KNEE, _ANKLE)):
        legs = maths.store(legs, name, _joint(maths, all_, number), "FLOAT_VECTOR")
    hip, knee, ankle = (maths.attribute(name, "FLOAT_VECTOR") for name in (_HIP, _KNEE, _ANKLE))

    forward, aside, both = parts(maths, _move(maths))
    goes = placed(maths, combined(maths, forward, aside, maths.math("FRACT", both)))
    legs = maths.store(legs, _ANKLE_TO, vector(maths, "ADD", ankle, goes), "FLOAT_VECTOR")
    lengths = [vector(maths, "LENGTH", vector(maths, "SUBTRACT", *ends)) for ends in ((knee, hip), (ankle, knee))]
    # a leg that the clip stretches further than that stays as it is
    longest = maths.math("MAXIMUM", maths.math("MULTIPLY", maths.math("ADD", *lengths), STRETCHED),
                         vector(maths, "LENGTH", vector(maths, "SUBTRACT", ankle, hip)))
    legs = _sunk(maths, legs, hip, longest)
    hip_to = vector(maths, "ADD", hip, _down(maths))
    wanted = vector(maths, "SUBTRACT", maths.attribute(_ANKLE_TO, "FLOAT_VECTOR"), hip_to)
    far, direction = maths.math("MINIMUM", vector(maths, "LENGTH", wanted), longest), vector(maths, "NORMALIZE", wanted)
    legs = maths.store(legs, _ANKLE_TO, vector(maths, "ADD", hip_to, scaled(maths, direction, far)), "FLOAT_VECTOR")
    ahead = vector(maths, "ADD", placed(maths, combined(maths, BENDS, 0.0, 0.0)), _across(
        maths, vector(maths, "SUBTRACT", knee, hip), vector(maths, "NORMALIZE", vector(maths, "SUBTRACT", ankle, hip))))
    bent = _thigh(maths, lengths, far, direction, vector(maths, "NORMALIZE", _across(maths, ahead, direction)))
    return maths.store(legs, _KNEE_TO, vector(maths, "ADD", hip_to, bent), "FLOAT_VECTOR")


def _sunk(maths, legs, hip, longest):
    """The points of legs, with how far down the body has to go for the longer way of its two feet."""
    x, y, z = parts(maths, vector(maths, "SUBTRACT", maths.attribute(_ANKLE_TO, "FLOAT_VECTOR"), hip))
    aside = maths.math("MULTIPLY_ADD", x, x, maths.math("MULTIPLY", y, y))
    down = maths.math("SQRT", maths.math("MAXIMUM", maths.math(
        "SUBTRACT", maths.math("MULTIPLY", longest, longest), aside), 0.0))
    sinks = maths.math("MAXIMUM", maths.math("SUBTRACT", 0.0, maths.math("ADD", z, down)), 0.0)
    legs = maths.store(legs, _SINKS, maths.math("MINIMUM", sinks, SINKS))
    other = maths.math("SUBTRACT", maths.math("ADD", index(maths), 1.0),
                       maths.math("MULTIPLY", maths.attribute(_SIDE, "INT"), 2.0))
    own = maths.attribute(_SINKS)
    return maths.store(legs, _SINKS, maths.math("MAXIMUM", own, bones.sample(maths, legs, own, other, "FLOAT")))


def _thigh(maths, lengths, far, direction, bends):
    """From the hip to the knee. @param lengths of thigh and calf; @param far how far the ankle is from the hip"""
    squares = [maths.math("MULTIPLY", each, each) for each in (*lengths, far)]
    along = maths.math("DIVIDE", maths.math("ADD", maths.math("SUBTRACT", squares[0], squares[1]), squares[2]),
                       maths.math("MAXIMUM", maths.math("MULTIPLY", far, 2.0), 1e-6))
    out = maths.math("SQRT", maths.math("MAXIMUM", maths.math(
        "SUBTRACT", squares[0], maths.math("MULTIPLY", along, along)), 0.0))
    return vector(maths, "ADD", scaled(maths, direction, along), scaled(maths, bends, out))


def _down(maths):
    return combined(maths, 0.0, 0.0, maths.math("SUBTRACT", 0.0, maths.attribute(_SINKS)))


def _move(maths):
    """Of the point's leg, as the stream has it."""
    right = maths.attribute(_SIDE, "INT")
    # to the last bit: a turn and a lift share a number
    shares = (maths.math("SUBTRACT", 1.0, right), right)
    return vector(maths, "ADD", *(scaled(maths, maths.attribute(name, "FLOAT_VECTOR"), share)
                                  for name, share in zip(FOOT_MOVES, shares)))


def _parts_of_legs(maths, legs):
    """A point for each of the _PARTS of each leg. What it does is about _CENTRE, a turn as _from_to has it, and then a
    shift."""
    found = _copies(maths, legs, _PARTS, _PART)
    hip, knee, ankle, knee_to, ankle_to = (maths.attribute(name, "FLOAT_VECTOR")
                                           for name in (_HIP, _KNEE, _ANKLE, _KNEE_TO, _ANKLE_TO))
    turn = maths.math("DIVIDE", maths.math("FLOOR", parts(maths, _move(maths))[2]), TURN_STEPS)
    span = lambda one, other: vector(maths, "SUBTRACT", other, one)
    of_part = [maths.math("COMPARE", maths.attribute(_PART, "INT"), float(part), 0.5) for part in range(_PARTS)]

    def by_part(*values):
        total = None
        for value, share in zip(values, of_part):
            if value is not None:
                own = scaled(maths, value, share)
                total = own if total is None else vector(maths, "ADD", total, own)
        return total

    for name, value in ((_CENTRE, by_part(hip, knee, ankle)),
                        (_TURNS, by_part(_from_to(maths, span(hip, knee), span(hip, knee_to)),
                                         _from_to(maths, span(knee, ankle), span(knee_to, ankle_to)),
                                         combined(maths, 0.0, 0.0, turn))),
                        (_SHIFT, by_part(_down(maths), span(knee, knee_to), span(ankle, ankle_to), _down(maths)))):
        found = maths.store(found, name, value, "FLOAT_VECTOR")
    return found


def with_feet_held(maths, people, all_, placed):
    """The points of bones, moved as the legs have to.

    @param placed (maths, vector of somebody's own frame) is that vector in the scene
    """
    table = _parts_of_legs(maths, _legs(maths, people, all_, placed))
    bone = maths.attribute(BONE, "INT")
    person = all_.person(maths)
    row = maths.math("MULTIPLY_ADD", person, 2.0 * _PARTS, _PARTS - 1.0)
    for number, leg_bone in enumerate(all_.limbs[:8]):
        own = number // 4 * _PARTS + min(number % 4, 2)
        row = maths.math("MULTIPLY_ADD", maths.math("COMPARE", bone, float(leg_bone), 0.5), own - (_PARTS - 1.0), row)
    points = all_.points
    for name in (_CENTRE, _TURNS, _SHIFT):
        value = bones.sample(maths, table, maths.attribute(name, "FLOAT_VECTOR"), row)
        points = maths.store(points, name, value, "FLOAT_VECTOR")
    centre, axis, shift = (maths.attribute(name, "FLOAT_VECTOR") for name in (_CENTRE, _TURNS, _SHIFT))
    angle = vector(maths, "LENGTH", axis)
    turn = lambda value, about: rotated(maths, value, axis, angle, about)
    return all_.turned(maths, points, turn, centre, shift)
