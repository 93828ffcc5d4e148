# SPDX-License-Identifier: Apache-2.0
"""What a bake tells of things that move, as curves with a key a frame: nothing runs while Blender renders."""
import os

import numpy

from ..blender.actions import curves_of
from ..formats import BakeError

_LINEAR = 1  # of the interpolations of keys


def read_track(folder, manifest, what):
    """(frames, things, columns) of a bake's vehicles or lifts, or None. Raises formats.BakeError."""
    things = manifest.get(what)
    if not things:
        return None
    path = os.path.join(folder, os.path.basename(things["file"]))
    try:
        track = numpy.load(path, allow_pickle=False)
    except (OSError, ValueError) as error:
        raise BakeError(f"{path}: cannot be read ({error})") from error
    wanted = (int(manifest["frames"]), len(things["list"]), len(things["columns"]))
    if track.shape != wanted:
        raise BakeError(f"{path}: holds {track.shape} values, expected {wanted}")
    return track


def fill(thing, path, frames, values):
    """A key a frame on each of the three curves of a path, straight lines between them."""
    thing.keyframe_insert(path, frame=int(frames[0]))
    for curve in curves_of(thing.animation_data.action):
        if curve.data_path != path:
            continue
        points = curve.keyframe_points
        points.add(len(frames) - len(points))
        places = numpy.stack([frames, values[:, curve.array_index]], axis=1).astype(numpy.float32)
        points.foreach_set("co", places.ravel())
        points.foreach_set("interpolation", numpy.full(len(frames), _LINEAR, dtype=numpy.int32))
        curve.update()
