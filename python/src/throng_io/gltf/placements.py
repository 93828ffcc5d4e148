# SPDX-License-Identifier: Apache-2.0
"""Who does what, where and when, for programs that drive crowds themselves: a record for each person and frame, which
tells the clips that are blended and where in them somebody is. Places are those of glTF files: y is up."""
from __future__ import annotations

import numpy

from ..cast import gait, sitting
from ..skinned.clips import Clip
from ..skinned.motions import stands_of, track_of, walking_of, walks_of
from ..skinned.shot import Shot
from . import axes

RECORD = numpy.dtype([("place", "<f4", 3), ("heading", "<u2"), ("phase", "<u2"), ("stand_phase", "<u2"),
                      ("walk", "u1"), ("before", "u1"), ("left", "u1"), ("walking", "u1"), ("stand", "u1"),
                      ("there", "u1")])
MEANINGS = {
    "place": "m, x, y (up), z, without the origin",
    "heading": "turns / 65536 about +y, of somebody who looks along +z",
    "phase": "cycles / 65536, in both walks",
    "stand_phase": "rounds / 65536, in that clip",
    "walk": "number of a clip",
    "before": "number of the clip that the walk comes from",
    "left": "share / 255 of that one in the walk",
    "walking": "share / 255 of the walk beside the clip of who stands or sits",
    "stand": "number of a clip, of who stands or has a seat",
    "there": "1: is there, 0: is not, and the record is 0",
}
SOME = 64  # people at a time


def records_of(shot: Shot, rows: list[int]) -> numpy.ndarray:
    """Frames x people."""
    found = numpy.zeros((len(shot.frames), len(rows)), dtype=RECORD)
    for first in range(0, len(rows), SOME):
        some = rows[first:first + SOME]
        streams = shot.streams(some)
        for place, row in enumerate(some):
            there = shot.there[:, row]
            found[there, first + place] = _person(shot, row, {name: each[there, place]
                                                              for name, each in streams.items()})
    return found


def _person(shot: Shot, row: int, streams: dict[str, numpy.ndarray]) -> numpy.ndarray:
    """Of the frames in which one is there."""
    track = track_of(row, shot.frames[shot.there[:, row]] + 1, streams)
    walks = walks_of(shot.repertoire, track.state)
    stand, stand_phase = stands_of(row, track.times, track.state)
    heading = numpy.arctan2(streams["dir"][:, 1], streams["dir"][:, 0]) + axes.QUARTER
    found = numpy.zeros(len(track.times), dtype=RECORD)
    found["place"] = axes.world(streams["pos"])
    for name, share in (("heading", heading / (2.0 * numpy.pi)), ("phase", track.state[:, 2]),
                        ("stand_phase", stand_phase)):
        found[name] = numpy.rint(share % 1.0 * 65536.0).astype(int) % 65536
    for name, share in (("left", walks.left), ("walking", walking_of(track))):
        found[name] = numpy.rint(numpy.clip(share, 0.0, 1.0) * 255.0)
    found["walk"], found["before"] = walks.gait, walks.before
    found["stand"] = len(shot.repertoire.strides) + stand
    if shot.repertoire.clips:
        sits = track.state[:, 0] > sitting.FIRST - 0.5
        clip = numpy.floor(track.state[:, 0] + 1e-4) - sitting.FIRST
        found["stand"][sits] += (len(gait.STANDING_CLIPS) - stand + clip)[sits].astype(numpy.uint8)
        found["stand_phase"][sits] = found["phase"][sits]
    found["there"] = 1
    return found


def told(shot: Shot, rows: list[int], clips: list[Clip]) -> dict:
    """What a program needs to read the records: `crowd.json`."""
    bake = shot.bake
    fields = [{"name": name, "offset": RECORD.fields[name][1], "type": RECORD.fields[name][0].base.name,
               "count": 3 if name == "place" else 1, "is": MEANINGS[name]} for name in RECORD.names]
    return {"format": "throng crowd", "version": 1, "bake": bake.name, "origin": bake.origin.tolist(),
            "fps": bake.fps / shot.every, "frames": len(shot.frames), "first_frame": int(shot.frames[0]),
            "records": {"file": "crowd.bin", "order": "frames, then people", "bytes": RECORD.itemsize,
                        "fields": fields},
            "clips": [{"name": clip.name} | clip.told() for clip in clips],
            "people": [{"row": row, "member": shot.member_of[row], "size": round(float(shot.sizes[row]), 6),
                        "top": [round(float(each), 6) for each in shot.tint(row)],
                        "group": str(bake.people["group"][row])} for row in rows]}
