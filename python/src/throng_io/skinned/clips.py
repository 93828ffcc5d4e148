# SPDX-License-Identifier: Apache-2.0
"""What members can do, as clips that go on from their last key to their first: a cycle of each gait from the right
heel's strike on, a round of each standing clip, and, in crowds where somebody has a seat, what is done there. Walks
stay on the spot."""
from __future__ import annotations

import dataclasses

import numpy

from ..cast import POSES, Repertoire, gait, sitting
from .motions import FRAMES_A_ROUND, GATHERS, Track, matrices_of

STANDING_KEYS = 40   # of a round
# s, of what is done in seats: bakes tell phases, so these are for who plays clips without them.
SEATED = {"sit": 6.5, "ready": 1.2, "clap": 0.25, "rise": 1.6, "cheer": 0.65, "sing": 2.4, "settle": 1.6,
          "raise": 0.8, "applaud": 0.25, "jubilate": 0.65, "sway": 2.4, "wave": 1.5}


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
    """Walks in the order of the repertoire, then who stands, in that of the standing clips, then who has a seat."""
    walks = [Clip(f"walk{repertoire.first + number}", gait.gait_of(stride).seconds, stride,
                  _walk(repertoire.first + number)) for number, stride in enumerate(repertoire.strides)]
    stands = [Clip(name, FRAMES_A_ROUND / fps, 0.0, _stand(number)) for number, name in enumerate(gait.STANDING_CLIPS)]
    seats = [Clip(clip.name, SEATED[clip.name], 0.0, _sits(number))
             for number, clip in enumerate(sitting.CLIPS[:repertoire.clips])]
    return walks + stands + seats


def _carried(keys: int, walking: float) -> numpy.ndarray:
    """A share of the walk, and trunks as poses have them."""
    return numpy.tile([walking, 0.0, 0.0], (keys, 1))


def _walk(number: int) -> Track:
    phases = numpy.arange(POSES) / POSES
    state = numpy.column_stack([numpy.full(POSES, 1.0 + number / 16.0), numpy.zeros(POSES), phases])
    return Track(0, phases, state, numpy.ones(POSES), _carried(POSES, 1.0))


def _stand(number: int) -> Track:
    """As somebody in that row does who gathers."""
    places = numpy.arange(STANDING_KEYS) / STANDING_KEYS
    state = numpy.tile([float(GATHERS), 0.0, 0.0], (STANDING_KEYS, 1))
    return Track(number, (places - number * 0.618034) * FRAMES_A_ROUND, state, numpy.zeros(STANDING_KEYS),
                 _carried(STANDING_KEYS, 0.0))


def _sits(number: int) -> Track:
    """A cycle, or a way there and back."""
    clip = sitting.CLIPS[number]
    keys = 2 * (clip.poses - 1) if clip.there_and_back else clip.poses
    state = numpy.column_stack([numpy.full(keys, float(sitting.FIRST + number)), numpy.zeros(keys),
                                numpy.arange(keys) / keys])
    return Track(0, numpy.zeros(keys), state, numpy.zeros(keys), _carried(keys, 0.0))


def poses_of_clip(clip: Clip, poses: numpy.ndarray, repertoire: Repertoire) -> numpy.ndarray:
    """K x J x 3 x 4. @param poses of a member"""
    return matrices_of(poses, repertoire, clip.track)
