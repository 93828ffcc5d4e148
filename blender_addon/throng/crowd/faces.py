# SPDX-License-Identifier: Apache-2.0
"""Faces of people close to the camera live: they blink, their eyes go from one thing to the next and where the head
turns, those who talk open their mouths, those who cheer smile. Nodes only, and no stream: what a face does follows from
who somebody is, what they do and the scene's time, so that any frame can be shown first. Meshes say how far (close.py,
people/faces.py)."""
import math

from ..blender.nodes import socket
from ..blender.vectors import combined, parts, place, rotated, scaled, vector
from ..cast import gait, sitting
from ..people.faces import BALL, EXPRESSIONS
from .heads import ATTENTION
from .names import NATURE, ROW
from .poses import STANDING_SPEED, has_seat

LIDS, MOUTH, SMILE = (f"throng_{name}" for name in EXPRESSIONS)  # of vertices: how far all of it takes them
EYE = f"throng_{BALL}"
_FACE, _LOOK = "throng_face", "throng_look"  # of people: how much of each; yaw and pitch of eyes, rad
# s: one blink each, 18.75 a minute: people at rest blink 17 times (Bentivoglio et al. 1997)
_BLINKS = 3.2
_CLOSING, _CLOSED, _OPENING = 0.09, 0.05, 0.20  # s
_FIXATION, _SACCADE = 0.85, 0.05                # s
_ASIDE, _UPWARDS = 0.13, 0.06                   # rad, to either side
_FURTHER, _FURTHEST = 0.4, 0.35  # eyes go on from where the head has turned by this share, rad at most
_SPEECH, _SPEAKS = 2.6, 0.55     # s, and the share of these spells that somebody who talks does speak
_SYLLABLES = 4.5                 # a second; mouths move at 2 to 7 Hz in speech (Chandrasekaran et al. 2009)
_WIDE = 0.30                     # of the mouth, the widest of somebody who talks
_TALKS = gait.STANDING_CLIPS.index("talk")
# {clip: (how far mouths are open, how much they smile)}
_OF_CLIPS = {"clap": (0.0, 0.45), "cheer": (0.55, 0.8), "sing": (0.45, 0.1), "applaud": (0.0, 0.45),
             "jubilate": (0.6, 0.9), "sway": (0.40, 0.3), "wave": (0.15, 0.6)}


def _draw(maths, window, salt):
    """From 0 to 1, for everybody and each window of time."""
    noise = maths.node("ShaderNodeTexWhiteNoise", noise_dimensions="3D")
    maths.link(combined(maths, maths.attribute(ROW, "INT"), window, float(salt)), noise.inputs["Vector"])
    return socket(noise.outputs, "Value")


def _windows(maths, seconds, salt):
    """(number of the window that it is now, how long ago it began, s); everybody's begin at other times."""
    seconds_now = socket(maths.node("GeometryNodeInputSceneTime").outputs, "Seconds")
    now = maths.math("ADD", maths.math("DIVIDE", seconds_now, seconds), _draw(maths, 0.0, salt))
    return maths.math("FLOOR", now), maths.math("MULTIPLY", maths.math("FRACT", now), seconds)


def _blink(maths):
    window, since = _windows(maths, _BLINKS, 1)
    whole = _CLOSING + _CLOSED + _OPENING
    begins = maths.math("MULTIPLY", _draw(maths, window, 2), _BLINKS - whole)
    since = maths.math("SUBTRACT", since, begins)
    opens = maths.smooth(since, _CLOSING + _CLOSED, whole)
    return maths.math("SUBTRACT", maths.smooth(since, 0.0, _CLOSING), opens)


def _fixation(maths, most, salt):
    """Where eyes are, which jump from one angle to the next."""
    window, since = _windows(maths, _FIXATION, 3)
    was, is_ = (_draw(maths, maths.math("ADD", window, step), salt) for step in (-1.0, 0.0))
    there = maths.math("MULTIPLY_ADD", maths.smooth(since, 0.0, _SACCADE), maths.math("SUBTRACT", is_, was), was)
    return maths.math("MULTIPLY_ADD", there, 2.0 * most, -most)


def _look(maths, streams):
    yaw, pitch = _fixation(maths, _ASIDE, 4), _fixation(maths, _UPWARDS, 5)
    if "attention" in streams:
        head, _, weight = parts(maths, maths.attribute(ATTENTION, "FLOAT_VECTOR"))
        further = maths.math("MULTIPLY", maths.math("MULTIPLY", head, weight), _FURTHER)
        further = maths.math("MAXIMUM", maths.math("MINIMUM", further, _FURTHEST), -_FURTHEST)
        yaw = maths.math("ADD", yaw, further)
    return combined(maths, yaw, pitch, 0.0)


def _talk(maths, state):
    """How far the mouths of those who talk are open."""
    slow = maths.math("LESS_THAN", maths.components("throng_dir")[2], STANDING_SPEED)
    gathers = maths.math("COMPARE", maths.math("FLOOR", state), 2.0, 0.1)
    clip = maths.math("MODULO", maths.components(NATURE)[0], float(len(gait.STANDING_CLIPS)))
    talks = maths.math("MULTIPLY", maths.math("MULTIPLY", slow, gathers),
                       maths.math("COMPARE", clip, float(_TALKS), 0.5))
    window, since = _windows(maths, _SPEECH, 6)
    speaks = maths.math("LESS_THAN", _draw(maths, window, 7), _SPEAKS)
    begins = maths.math("SUBTRACT", maths.smooth(since, 0.0, 0.15), maths.smooth(since, _SPEECH - 0.4, _SPEECH))
    syllable, within = _windows(maths, 1.0 / _SYLLABLES, 8)
    wave = maths.math("SINE", maths.math("MULTIPLY", within, math.pi * _SYLLABLES))
    wide = maths.math("MULTIPLY_ADD", _draw(maths, syllable, 9), 0.75 * _WIDE, 0.25 * _WIDE)
    spoken = maths.math("MULTIPLY", maths.math("MULTIPLY", wave, wide), maths.math("MULTIPLY", speaks, begins))
    return maths.math("MULTIPLY", spoken, talks), talks


def _clip(maths, state, clips):
    """(how far mouths are open, how much they smile) of those in a seat, or with hands that do something."""
    number = maths.math("SUBTRACT", maths.math("FLOOR", state), float(sitting.FIRST))
    mouth, smile = 0.0, 0.0
    for each, clip in enumerate(sitting.CLIPS[:clips]):
        if clip.name in _OF_CLIPS:
            is_it = maths.math("COMPARE", number, float(each), 0.1)
            mouth, smile = (maths.math("MULTIPLY_ADD", is_it, value, total)
                            for value, total in zip(_OF_CLIPS[clip.name], (mouth, smile)))
    window, within = _windows(maths, 0.8, 10)
    swells = maths.math("MULTIPLY_ADD", maths.math("SINE", maths.math("MULTIPLY", within, math.pi / 0.8)), 0.6, 0.4)
    there = has_seat(maths, state)
    return maths.math("MULTIPLY", maths.math("MULTIPLY", mouth, swells), there), maths.math("MULTIPLY", smile, there)


def told(maths, people, clips, streams):
    """The points of people, with what their faces do. @param clips how many of sitting.CLIPS there are; @param streams
    that points have"""
    state = maths.components("throng_state")[0]
    mouth, talks = _talk(maths, state)
    smile = maths.math("MULTIPLY", talks, 0.25)
    if clips:
        wide, smiles = _clip(maths, state, clips)
        mouth, smile = maths.math("ADD", mouth, wide), maths.math("ADD", smile, smiles)
    people = maths.store(people, _FACE, combined(maths, _blink(maths), mouth, smile), "FLOAT_VECTOR")
    return maths.store(people, _LOOK, _look(maths, streams), "FLOAT_VECTOR")


def moved(maths, mesh):
    """Everybody's mesh at rest, with their faces as told()."""
    total = place(maths)
    for name, share in zip((LIDS, MOUTH, SMILE), maths.components(_FACE)):
        total = vector(maths, "ADD", total, scaled(maths, maths.attribute(name, "FLOAT_VECTOR"), share))
    ball, (yaw, pitch, _) = maths.attribute(EYE, "FLOAT_VECTOR"), maths.components(_LOOK)
    nods = rotated(maths, ball, (0.0, 1.0, 0.0), maths.math("SUBTRACT", 0.0, pitch))
    turned = rotated(maths, nods, (0.0, 0.0, 1.0), yaw)
    put = maths.node("GeometryNodeSetPosition")
    maths.link(mesh, put.inputs["Geometry"])
    maths.link(vector(maths, "ADD", total, vector(maths, "SUBTRACT", turned, ball)), put.inputs["Position"])
    return put.outputs[0]


SPARE = (_FACE, _LOOK, LIDS, MOUTH, SMILE, EYE)  # attributes that nobody needs after moved()
