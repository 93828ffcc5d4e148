# SPDX-License-Identifier: Apache-2.0
"""What members can do, as clips that go on from their last key to their first: a cycle of each gait from the right
heel's strike on, and a round of each standing clip. Walks stay on the spot."""
from __future__ import annotations

import dataclasses

import numpy

from ..cast import POSES, Repertoire, gait
from .motions import FRAMES_A_ROUND, GATHERS, Track, matrices_of

STANDING_KEYS = 40   # of a round


@dataclasses.dataclass(frozen=True)
class Clip:
    name: str
    seconds: float             # of a cycle, as fast as it looks right
    stride: float              # m that a cycle takes somebody on; 0 for those who stand
    track: Track               # its keys: of K frames, at equal distances; the first one follows the last one

    @property
    def keys(self) -> int:
        return len(self.track.times)

    def told(self) -> dict:
        """What a program needs to play it."""
        return {"loop": True, "seconds": round(self.seconds, 6), "keys": self.keys, "stride": round(self.stride, 6),
                "speed": round(self.stride / self.seconds, 6)}


def clips_of(repertoire: Repertoire, fps: float) -> list[Clip]:
    """Walks in the order of the repertoire, then who stands, in that of the standing clips."""
    walks = [Clip(f"walk{repertoire.first + number}", gait.gait_of(stride).seconds, stride,
                  _walk(repertoire.first + number)) for number, stride in enumerate(repertoire.strides)]
    return walks + [Clip(name, FRAMES_A_ROUND / fps, 0.0, _stand(number))
                    for number, name in enumerate(gait.STANDING_CLIPS)]


def _walk(number: int) -> Track:
    phases = numpy.arange(POSES) / POSES
    state = numpy.column_stack([numpy.full(POSES, 1.0 + number / 16.0), numpy.zeros(POSES), phases])
    return Track(0, phases, state, numpy.ones(POSES), numpy.ones(POSES))


def _stand(number: int) -> Track:
    """As somebody in that row does who gathers."""
    places = numpy.arange(STANDING_KEYS) / STANDING_KEYS
    state = numpy.tile([float(GATHERS), 0.0, 0.0], (STANDING_KEYS, 1))
    return Track(number, (places - number * 0.618034) * FRAMES_A_ROUND, state, numpy.zeros(STANDING_KEYS),
                 numpy.zeros(STANDING_KEYS))


def poses_of_clip(clip: Clip, poses: numpy.ndarray, repertoire: Repertoire) -> numpy.ndarray:
    """K x J x 3 x 4. @param poses of a member"""
    return matrices_of(poses, repertoire, clip.track)
