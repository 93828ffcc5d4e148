# SPDX-License-Identifier: Apache-2.0
"""Who somebody appears as, and in which pose, as nodes that work it out for all at once."""
from ..cast import BEATS, LEVEL_BEATS, LEVEL_POSES, sitting
from ..blender.nodes import socket
from .own import OWN

STANDING_SPEED = 0.1   # m/s: slower people stand
FRAMES_A_ROUND = 80.0  # of a standing clip


def member_of(maths, variation, drawn, count, own=False):
    """Nodes that say which member somebody is.

    The bake draws among so many as it knew of; members that joined later take their share from all alike, by
    numbers that everybody has.
    @param variation the stream's value; @param drawn how many the bake draws among; @param count
    how many members there are; @param own whether most people have a member of their own (crowd/own.py)
    """
    if own:
        member = maths.attribute(OWN, "FLOAT")
        has = maths.math("GREATER_THAN", member, 0.5)
        instead = maths.math("SUBTRACT", maths.math("SUBTRACT", member, 1.0), variation)
        variation = maths.math("MULTIPLY_ADD", has, instead, variation)
    own = maths.math("MODULO", variation, float(count))
    later = count - drawn
    if later <= 0:
        return own
    draws = maths.node("ShaderNodeSeparateXYZ")
    maths.link(maths.attribute("tint", "FLOAT_VECTOR"), draws.inputs[0])
    joins, which = (maths.math("FRACT", maths.math("MULTIPLY", draws.outputs[axis], 97.0)) for axis in (0, 1))
    joined = maths.math("ADD", maths.math("FLOOR", maths.math("MULTIPLY", which, float(later))), float(drawn))
    taken = maths.math("MULTIPLY", maths.math("LESS_THAN", joins, later / count),
                       maths.math("LESS_THAN", variation, drawn - 0.5))
    return maths.math("MULTIPLY_ADD", taken, maths.math("SUBTRACT", joined, own), own)


def member_in(maths, cast, variation):
    """The same for a cast as it is."""
    own = "throng_bodies" in cast
    drawn = cast["throng_shipped"] if own else cast["throng_drawn"]
    return member_of(maths, variation, drawn, cast["throng_variations"], own)


def _walking_pose(maths, state, phase, poses, first):
    """The gait is what `state` adds to the activity, in sixteenths; the pose is the phase's.

    @param first the number of the cast's first gait; nobody walks with those that it has not
    """
    gait = maths.math("ROUND", maths.math("MULTIPLY", maths.math("FRACT", state), 16.0))
    if first:
        gait = maths.math("SUBTRACT", gait, float(first))
    step = maths.math("MINIMUM", maths.math("FLOOR", maths.math("MULTIPLY", maths.math("FRACT", phase), poses)),
                      poses - 1)
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


def has_seat(maths, state):
    """1 for whoever has one, or does something with its hands."""
    return maths.math("GREATER_THAN", state, sitting.FIRST - 0.5)


def _of_clip(maths, clip, values):
    """The value of everybody's clip, by number."""
    total = 0.0
    for number, value in enumerate(values):
        total = maths.math("MULTIPLY_ADD", maths.math("COMPARE", clip, float(number), 0.1), float(value), total)
    return total


def seated_place(maths, state, phase, clips, share=1):
    """(the first pose of everybody's clip behind the standing ones, how far in it somebody is, how many it has, whether
    it goes there and back); one pose in `share` is kept."""
    clip = maths.math("SUBTRACT", maths.math("FLOOR", state), float(sitting.FIRST))
    known = sitting.CLIPS[:clips]
    count = _of_clip(maths, clip, [each.poses // share for each in known])
    first = _of_clip(maths, clip, [sitting.poses_in(number) // share for number in range(clips)])
    returns = _of_clip(maths, clip, [each.there_and_back for each in known])
    place = maths.math("FRACT", phase)
    there = maths.math("SUBTRACT", 1.0, maths.math("ABSOLUTE", maths.math("MULTIPLY_ADD", place, 2.0, -1.0)))
    cycle, way = maths.math("MULTIPLY", place, count), maths.math("MULTIPLY", there, maths.math("SUBTRACT", count, 1.0))
    along = maths.math("MULTIPLY_ADD", returns, maths.math("SUBTRACT", way, cycle), cycle)
    return first, along, count, returns


def _seated_pose(maths, state, phase, share, upright, clips):
    first, along, count, returns = seated_place(maths, state, phase, clips, share)
    nearest = maths.math("FLOOR", maths.math("MULTIPLY_ADD", returns, 0.5, along))
    pose = maths.math("MINIMUM", nearest, maths.math("SUBTRACT", count, 1.0))
    return maths.math("ADD", maths.math("ADD", first, pose), float(upright))


def pose_index(maths, speed, state, phase, nature, repertoire, level):
    upright = _upright_pose(maths, speed, state, phase, nature, repertoire, level)
    if not repertoire.clips:
        return upright
    seated = _seated_pose(maths, state, phase, BEATS // LEVEL_BEATS[level], repertoire.upright(level),
                          repertoire.clips)
    return maths.math("MULTIPLY_ADD", has_seat(maths, state), maths.math("SUBTRACT", seated, upright), upright)


def _upright_pose(maths, speed, state, phase, nature, repertoire, level):
    walks = maths.math("GREATER_THAN", speed, STANDING_SPEED)
    walking = _walking_pose(maths, state, phase, LEVEL_POSES[level], repertoire.first)
    standing = _standing_pose(maths, state, nature, LEVEL_BEATS[level], repertoire.walking(level))
    return maths.math("ADD", maths.math("MULTIPLY", walking, walks),
                      maths.math("MULTIPLY", standing, maths.math("SUBTRACT", 1.0, walks)))
