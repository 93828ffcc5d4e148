# SPDX-License-Identifier: Apache-2.0
"""Keys for what is there at some times and not at others."""
import numpy


def key_hidden(thing, hidden, frame):
    for path in ("hide_viewport", "hide_render"):
        setattr(thing, path, hidden)
        thing.keyframe_insert(path, frame=frame)


def hide_but(thing, there, frame_start):
    """@param there in which of the bake's frames it is seen"""
    for frame in numpy.flatnonzero(numpy.diff(there.astype(int), prepend=-1)):
        key_hidden(thing, not there[frame], frame_start + int(frame))
